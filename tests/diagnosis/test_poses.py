"""Faults of where things are and what is drawn over what: each gets its name alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.case import Variant
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.changes import SCALED
from reference_tracer.diagnosis.faults.changes import TURNED as TURNS
from reference_tracer.diagnosis.faults.fault import Guess, Numbers, Option
from reference_tracer.diagnosis.faults.fitting import traced
from reference_tracer.diagnosis.faults.looked import Looked
from reference_tracer.diagnosis.faults.pose import Posed
from reference_tracer.diagnosis.faults.stand import TURNED
from reference_tracer.pictures.picture import Picture
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.rendering import render
from reference_tracer.scene import ViewWindow
from reference_tracer.tracer.camera import film_of, pixel_size
from reference_tracer.tracer.progress import result_of

from ..cases import case_of
from .diagnosing import pictured, said_of, told


def test_an_orthographic_camera_that_turns_leaves_what_was_near_its_rays(few):
    """What is far away moves by many pixels: triangles are looked for anew."""
    scene, turn = few(parallel=True), (0.4, 0.25, 0.0)
    matrix = scene.camera.world_from_camera.copy()
    matrix[:3, 3] -= 60 * scene.camera.forward
    scene = scene.seen_by(replace(scene.camera, world_from_camera=matrix))
    color = pictured(scene, "camera_turned", Numbers(turn))
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    right = traced(Evidence(found.case, found.frame, found.causes), TURNED.camera)
    assert not result_of(right((0.0, 0.0, 0.0))).all()
    assert result_of(right(turn)).all()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "values", "rivals"),
    [
        ("camera_moved", (0.15, -0.1, 0.2), ("pixel_offset", "object_moved")),
        pytest.param(
            "camera_turned",
            (1.0, 0.6, 0.8),
            ("pixel_offset", "roll", "object_moved"),
            marks=pytest.mark.torture,
        ),
        ("focal_lengths", (6.0, -4.0), ("focal_length", "object_scaled")),
    ],
)
def test_a_camera_is_told_and_no_object(few, name, values, rivals):
    scene = few(48, 30)
    found = told(scene, pictured(scene, name, Numbers(values)), name, *rivals)
    assert list(found) == [name]


def test_a_unit_of_a_move_is_a_pixel_across_and_up(few):
    """Also where pixels are higher than wide: a search begins in these units."""
    scene = few()
    camera = replace(scene.camera, window=scene.camera.window.scaled(1, 2))
    scene = scene.seen_by(camera)
    color = pictured(scene, "object_moved", Posed((0.1, 0, 0.1), object="Box"))
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    looked = result_of(Looked.of(Evidence(found.case, found.frame, found.causes), "Box"))
    middle = camera.origin + looked.depth * camera.forward
    places = np.column_stack((middle, middle[:, None] + looked.axes()[:, :2]))
    x, y, _ = film_of(camera, places)
    assert x - x[0] == pytest.approx([0, 1, 0]) and y - y[0] == pytest.approx([0, 0, 1])


@pytest.mark.torture
def test_an_object_that_moves_by_a_fraction_of_a_pixel(few):
    """Fitted roughly, it would break as many pixels at its edges as it settles."""
    scene = few(384, 216)
    color = pictured(scene, "object_moved", Posed((0, 0.004, -0.003), object="Box"))
    found = told(scene, color, "object_moved", "object_missing")
    assert list(found) == ["object_moved"] and found["object_moved"].guess.object == "Box"


@pytest.mark.slow
@pytest.mark.parametrize(
    "values", [(0.15, -0.1, 0.2, 1.2, 0.7, -0.8), (0.4, 0.22, 0.26, -6.8, -4, 0.8)]
)
def test_a_camera_that_stands_elsewhere_and_looks_elsewhere(few, values):
    scene = few(160, 100)
    rivals = "camera_moved", "camera_turned", "pixel_offset", "cropped", "object_moved"
    found = told(scene, pictured(scene, "camera_placed", Numbers(values)), "camera_placed", *rivals)
    assert list(found) == ["camera_placed"]
    np.testing.assert_allclose(found["camera_placed"].guess.values, values, atol=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "values"), [("camera_moved", (0.15, -0.1, 0.2)), ("camera_turned", (1.0, 0.6, 0.8))]
)
def test_a_camera_of_three_numbers_is_not_told_in_six(few, name, values):
    scene = few(96, 60)
    color = pictured(scene, name, Numbers(values))
    assert list(told(scene, color, name, "camera_placed", "cropped")) == [name]


@pytest.mark.slow
def test_a_turn_by_many_degrees_is_not_what_looks_like_it(few):
    """A lens that is shifted by as much, or a scene that is turned about its own middle."""
    scene = few(96, 60)
    rivals = "camera_turned", "camera_moved", "camera_placed", "pixel_offset", "cropped"
    turned = pictured(scene, "camera_turned", Numbers((12.0, 0.0, 0.0)))
    assert list(told(scene, turned, *rivals)) == ["camera_turned"]
    angle = np.radians(12)
    aside = Numbers((np.tan(angle) / pixel_size(scene.camera)[0], 0.0))
    assert list(told(scene, pictured(scene, "pixel_offset", aside), *rivals)) == ["pixel_offset"]
    about = trimesh.transformations.rotation_matrix(angle, (0, 0, 1))
    others = (replace(i, world_from_object=about @ i.world_from_object) for i in scene.instances)
    shown = render(replace(scene, instances=tuple(others))).color
    assert "camera_turned" not in told(scene, shown, *rivals)


OFFSET = np.array((0.5, -0.3, 0.2))
OBJECTS = "Box", "Ball"


def displaced(scene, by, *names):
    """Return a scene with some objects moved."""
    numbers = [scene.objects.index(name) for name in names]
    place = trimesh.transformations.translation_matrix(by)
    moved = (
        replace(i, world_from_object=place @ i.world_from_object) if i.object in numbers else i
        for i in scene.instances
    )
    return replace(scene, instances=tuple(moved))


@pytest.mark.slow
def test_an_offset_that_is_left_out_is_not_what_looks_like_it(few):
    """A collection that is moved the other way, by less, or of which an object is."""
    scene = few(96, 60)
    left_out = displaced(scene, OFFSET, *OBJECTS)
    rivals = "instance_offset", "object_moved", "object_missing", "instances_missing"
    known = {"variants": lambda: [Variant("instance_offset", left_out, "that of 'Kit'")]}
    assert list(told(scene, render(left_out).color, *rivals, **known)) == ["instance_offset"]
    for by, names in ((-OFFSET, OBJECTS), (0.8 * OFFSET, OBJECTS), (OFFSET, OBJECTS[:1])):
        shown = render(displaced(scene, by, *names)).color
        assert "instance_offset" not in said_of(scene, shown, *rivals, **known)


@pytest.mark.slow
def test_a_lens_about_the_pictures_centre_is_a_crop(few):
    """And one about the axis is not."""
    scene = few(96, 60)
    window = scene.camera.window
    about = replace(scene.camera, window=window.about(window.centre, 1 / 1.02, 1 / 1.02))
    names = "cropped", "focal_length", "pixel_offset"
    assert list(told(scene, render(scene.seen_by(about)).color, *names)) == ["cropped"]
    focal = pictured(scene, "focal_length", Numbers((2.0,)))
    assert list(told(scene, focal, *names)) == ["focal_length"]


def test_an_orthographic_camera_has_a_scale_and_no_focal_length(few):
    scene = few(96, 54, parallel=True)
    color = pictured(scene, "focal_length", Numbers((4.0,)))
    [said] = [t.sentence for t in told(scene, color, "focal_length", "pixel_offset").values()]
    assert (
        said.startswith("everything is +4 % off in size: the orthographic scale")
        and "focal" not in said
    )


@pytest.mark.parametrize("way", [0, 1, 2])
def test_a_shift_that_is_left_out_is_no_offset(few, way):
    scene = few(64, 40)
    color = pictured(scene, "shift_left_out", Option(way))
    assert list(told(scene, color, "shift_left_out", "pixel_offset")) == ["shift_left_out"]
    offset = pictured(scene, "pixel_offset", Numbers((3.3, 1.2)))
    assert list(told(scene, offset, "shift_left_out", "pixel_offset")) == ["pixel_offset"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["", "Box"])
def test_rotations_that_are_transposed(few, name):
    scene = few(96, 54)
    color = pictured(scene, "rotation_transposed", Numbers(object=name))
    rivals = "rotation_left_out", "object_turned", "matrix_transposed"
    found = told(scene, color, "rotation_transposed", *rivals)
    assert list(found) == ["rotation_transposed"]
    assert found["rotation_transposed"].guess.object == name
    left_out = pictured(scene, "rotation_left_out", Guess(object="Box"))
    assert "rotation_transposed" not in told(scene, left_out, "rotation_transposed", *rivals)


FAMILY = "object_scaled", "object_moved", "object_turned", "rotation_left_out", "object_missing"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "values", "said"),
    [
        (SCALED[0], (1.2,), "1.2 times as large"),
        (SCALED[1], (1.2,), "1.2 times as large, about the middle of its base"),
        (SCALED[3], (1.3,), "1.3 times as long along its own X"),
        (SCALED[5], (0.5,), "0.5 times as long along its own Z"),
        (SCALED[6], (1.3, 0.8, 1.1), "times as long along its own Y"),
        (TURNS[2], (23.0,), "turned by 23 degrees about its own Z"),
        (TURNS[0], (-50.0,), "degrees about its own X"),
        (TURNS[6], (20.0, -7.0, 30.0), "degrees about (0.54"),
    ],
)
def test_a_changed_object_is_told_in_the_fewest_numbers(few, change, values, said):
    """Not as what has as many, or more: a move."""
    scene = few(160, 100)
    name = f"object_{change.kind}"
    guess = Posed(values, object="Box", change=change)
    found = told(scene, pictured(scene, name, guess), *FAMILY)
    assert list(found) == [name] and said in found[name].sentence
    of = found[name].guess
    assert len(of.values) == len(values) and of.object == "Box"
    assert np.allclose(of.values, values, rtol=0.02)


@pytest.mark.slow
def test_what_cannot_be_told_apart_is_told_together(few):
    """A box that is turned by a quarter is a longer one; the fewest numbers come first."""
    scene = few(160, 100)
    color = pictured(scene, "object_turned", Posed((90.0,), object="Box", change=TURNS[0]))
    found = told(scene, color, *FAMILY)
    assert list(found) == ["object_turned", "object_scaled"]
    assert "90 degrees about its own X" in found["object_turned"].sentence


@pytest.mark.slow
@pytest.mark.parametrize("by", [(0.2, 0.1, 0.3), (0.3, -0.36, 0.24)])
def test_an_object_that_is_moved_is_not_turned_nor_larger(few, by):
    """The second comes nearer to the camera."""
    scene = few(160, 100)
    color = pictured(scene, "object_moved", Posed(by, object="Ball"))
    assert next(iter(told(scene, color, *FAMILY))) == "object_moved"


@pytest.mark.slow
def test_an_object_that_is_left_unturned_is_not_turned_by_some_degrees(few):
    scene = few(96, 54)
    left_out = pictured(scene, "rotation_left_out", Guess(object="Box"))
    assert list(told(scene, left_out, *FAMILY)) == ["rotation_left_out"]


def test_a_focal_length_is_not_taken_for_the_last_pixel(few):
    scene = few(96, 54)
    color = pictured(scene, "focal_length", Numbers((-100 / 96,)))
    assert list(told(scene, color, "last_pixel", "focal_length")) == ["focal_length"]


def test_rows_of_what_is_symmetric_may_be_a_turned_picture(make):
    same = "rows", "mirrored_y", "picture_turned"
    scene = make.scene(make.camera(32, 24, half=0.3), make.quad(-0.4, 0.4, 0.3, 0.9, -4))
    assert set(told(scene, render(scene).color[::-1], *same)) == {*same}


@pytest.mark.slow
def test_a_square_picture_may_be_turned_by_a_quarter(few):
    """Also a roll turns what is shown, about the shifted window's axis."""
    scene = few(48, 48)
    color = np.rot90(render(scene).color, -1)  # its lowest row is the first
    found = told(scene, np.ascontiguousarray(color))
    assert (
        list(found) == ["picture_turned"]
        and "90 degrees anticlockwise" in found["picture_turned"].sentence
    )
    rolled = pictured(scene, "roll", Numbers((90.0,)))
    assert "picture_turned" not in told(scene, rolled, "picture_turned", "roll")


def test_a_shear_that_is_left_out(few):
    """An object that is turned has none."""
    scene = few(96, 54)
    instances = list(scene.instances)
    sheared = instances[1].world_from_object.copy()
    sheared[:3, :3] = np.diag((1.0, 1.6, 0.8)) @ sheared[:3, :3]
    instances[1] = replace(instances[1], world_from_object=sheared)
    scene = replace(scene, instances=tuple(instances))
    color = pictured(scene, "shear_left_out", Option(1, object="Box"))
    assert list(told(scene, color, "shear_left_out", "rotation_left_out", "scale_left_out")) == [
        "shear_left_out"
    ]
    without = pictured(scene, "scale_left_out", Guess(object="Box"))
    assert list(told(scene, without, "shear_left_out", "scale_left_out")) == ["scale_left_out"]


def drawn(scene, ranks):
    """Return the picture with one instance drawn over the other, the lowest rank first."""
    out = None
    for instance in np.argsort(ranks, kind="stable"):
        alone = render(replace(scene, instances=(scene.instances[instance],)))
        own = (alone.instance_index >= 0)[..., None]
        out = np.where(own, alone.color, alone.color if out is None else out)
    return out


def test_objects_drawn_one_over_the_other(few):
    """As they are listed; but not where one is missing."""
    scene = few(96, 54)
    names = "depth_order", "object_missing"
    found = told(scene, drawn(scene, range(5)), *names)
    assert "as they are listed" in found["depth_order"].sentence
    missing = pictured(scene, "object_missing", Guess(object="Ball"))
    assert list(told(scene, missing, *names)) == ["object_missing"]


def test_the_farthest_surface_is_seen(few):
    """A reversed depth test: seen through the other end, as it were."""
    scene = few()
    c, far = scene.camera, 100.0
    planes = replace(scene, camera=replace(c, projection=ORTHOGRAPHIC, window=_wider(c.window)))
    # An orthographic camera on the other side, mirrored, sees the farthest surfaces.
    matrix = c.world_from_camera.copy()
    matrix[:3, 3] += far * c.forward
    matrix[:3, 2] = -matrix[:3, 2]
    behind = replace(planes.camera, world_from_camera=matrix)
    found = told(planes, render(planes.seen_by(behind)).color, "depth_order", "object_missing")
    assert list(found) == ["depth_order"]
    assert "farthest" in found["depth_order"].sentence


def _wider(window):
    return ViewWindow(*(7 * v for v in (window.left, window.right, window.bottom, window.top)))


def test_a_turn_is_said_without_what_it_is_not():

    [fault] = [f for f in FAULTS if f.name == "camera_turned"]
    for values, said in (
        ((-2.0, 0.0, 0.0), "the camera is turned by 2 degrees to the left"),
        (
            (0.5, -0.25, 3e-5),
            "the camera is turned by 0.5 degrees to the right, 0.25 degrees downwards",
        ),
    ):
        guess = Numbers(values, words=TURNED.words(None, *values))
        assert fault.sentence_of(guess) == said
