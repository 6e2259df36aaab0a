"""The test bed itself: its scenes, what its faults leave, its damage, its names."""

from __future__ import annotations

from itertools import combinations, pairwise

import numpy as np
import pytest
from reference_tracer.comparison.comparing import diagnosed, trace_and_compare
from reference_tracer.rendering import render as trace
from reference_tracer.tracer.progress import result_of

from ..sampled import daily
from . import damage, shapes
from .bridge import case_of, scene_of, window_of
from .faults import FAULTS, of
from .making import Fault, right
from .names import picture_of, right_names, same, says_nothing
from .scenes import scenes
from .setup import FLIP, camera_through
from .table import compared as compared_cell
from .table import made_of
from .variants import variants_of

EVERY = pytest.mark.parametrize("scene", scenes(), ids=lambda s: s.name)


def compared(scene, made):
    case = case_of(scene, made.stored(), made.levels, made.filter_radius)
    return result_of(trace_and_compare(case))


# ---- both sides are built from one description


@pytest.mark.blender
@EVERY
def test_the_view_window_is_blenders(scene):
    import bpy
    from reference_tracer.blender.reading.camera import window_of as blenders

    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    own, lens, film = bpy.context.scene, scene.lens, scene.film
    data = bpy.data.cameras.new("Camera")
    own.camera = bpy.data.objects.new("Camera", data)
    data.type = "ORTHO" if lens.parallel else "PERSP"
    data.lens, data.ortho_scale, data.sensor_fit = lens.focal, lens.ortho_scale, lens.fit
    data.sensor_width, data.sensor_height = lens.sensor_width, lens.sensor_height
    data.shift_x, data.shift_y = lens.shift_x, lens.shift_y
    own.render.resolution_x, own.render.resolution_y = film.resolution_x, film.resolution_y
    own.render.resolution_percentage = film.percentage
    own.render.pixel_aspect_x, own.render.pixel_aspect_y = film.aspect_x, film.aspect_y
    found = [*vars(blenders(own)).values()]
    assert np.allclose(found, [*vars(window_of(lens, film)).values()], rtol=1e-6)


@EVERY
def test_the_right_picture_agrees_everywhere(scene):
    found = compared(scene, right(scene))
    assert found.counts.agree == found.counts.total


@EVERY
def test_colours_tell_objects_apart(scene):
    """By more than ten levels in linear colours of eight bits."""
    colors = np.array([*(i.color for i in scene.items), scene.background])[:, :3]
    assert min(np.abs(a - b).max() for a, b in combinations(colors, 2)) > 1 / 256


def test_subdivision_keeps_a_closed_surface_and_comes_to_rest():
    """Euler's formula holds, and each level moves the corners less than the one before."""
    every = shapes.levels(shapes.box(), 4)
    moved = []
    for coarse, fine in pairwise(every):
        assert len(fine.faces) == 4 * len(coarse.faces)
        assert len(fine.vertices) == len(fine.faces) + 2
        count = len(coarse.vertices)
        moved.append(np.abs(fine.vertices[:count] - coarse.vertices).max())
    assert moved[0] > 2 * moved[1] > 4 * moved[2] > 0
    # Of a cube, (F + 2 E + (3 - 3) P) / 3 with F = P / 3 and E = 2 P / 3 is 5/9 P.
    assert np.allclose(every[1].vertices[:8], 5 / 9 * every[0].vertices, atol=1e-6)


# ---- faults


def where(fault: Fault, number: int):
    """Return a scene in which a fault can be seen, another one for another number."""
    every = [s for s in scenes() if s.number in fault.only]
    for k in range(len(every)):
        scene = every[(number + k) % len(every)]
        picture = fault.make(scene, right(scene)).stored()
        if not (same(picture, right(scene).picture()) or says_nothing(picture)):
            return scene
    raise AssertionError(f"{fault.name} is seen in no scene")


@pytest.mark.torture
@pytest.mark.parametrize("number", range(len(FAULTS)), ids=[f.name for f in FAULTS])
def test_a_fault_is_seen(number):
    """It leaves unexplained pixels, or the comparison names a transform of the colours."""
    fault = FAULTS[number]
    scene = where(fault, number)
    found = compared(scene, fault.make(scene, right(scene)))
    assert found.counts.unexplained or found.causes.transform


def test_each_fault_has_a_name_of_its_own():
    assert len({f.name for f in FAULTS}) == len(FAULTS)


# ---- variants


@pytest.mark.slow
@EVERY
def test_a_variant_is_what_its_fault_makes(scene):
    """Two ways to the same wrong picture: from the description by export, and by formula."""
    variants = variants_of(scene)
    frames = {key: [] for key, *_ in variants}
    for key, _, _, other in variants:
        frames[key].append(trace(other).color[::-1])
    found = [f for f in FAULTS if f.key in frames and scene.number in f.only]
    assert found
    for fault in found:
        own = picture_of(fault, scene)
        if fault.label == "the same length on the other side":  # not what Blender has
            continue
        assert any(same(own, frame) for frame in frames[fault.key]), fault.name


@EVERY
def test_most_variants_are_wrong_for_any_picture(scene):
    base = trace(scene_of(scene)).color[::-1]
    others = [trace(s).color[::-1] for *_, s in variants_of(scene)]
    differ = [o for o in others if o.shape == base.shape and not same(o, base)]
    assert len(differ) >= len(others) / 2


# ---- names that are the same fault


def names(key: str, number: int, label: str = "") -> set[str]:
    return set(right_names(of(key, label), scenes()[number - 1]))


@pytest.mark.torture
def test_names_are_the_same_where_no_picture_tells_them_apart():
    assert names("mirrored_y", 1) == {"mirrored_y", "rows"}
    assert names("sensor_fit", 1) == {"sensor_fit", "focal_length"}
    assert names("principal_point", 1) == {"principal_point", "pixel_offset"}
    assert names("ortho_scale", 2, "the height") == {"ortho_scale", "sensor_fit"}
    assert names("object_scaled", 1, "by 0.01") == {"object_scaled", "object_missing"}


def test_names_are_not_the_same_where_a_picture_does():
    """With a shift, a mirrored camera is no mirrored picture."""
    assert names("mirrored_y", 3) == {"mirrored_y"}


@pytest.mark.torture
@pytest.mark.parametrize(
    "key, number",
    [("sensor_fit", 3), ("roll", 1), ("other_frame", 4), ("object_moved", 1), ("camera_scale", 4)],
)
def test_names_are_not_the_same_in_other_scenes(key, number):
    """Of each scene, every fault's picture is made."""
    assert names(key, number) == {key}


def test_numbers_of_a_fit_are_found():
    scene = scenes()[2]
    reason = right_names(of("shift_left_out"), scene)["pixel_offset"]
    assert "(+33.6, +16)" in reason  # 0.12 and 0.08 of 280 pixel widths, the latter 1.4 high


def test_a_camera_with_a_scale_is_no_other_lens():
    scene = scenes()[3]
    through = camera_through(scene.lens, scene.film, scene.eye.world(scene.frame))
    turned = FLIP @ through.r
    assert np.allclose(turned @ turned.T, np.eye(3))


# ---- damage


@pytest.mark.parametrize("number", daily(range(20)))
def test_a_damaged_picture_differs_and_comes_again(number):
    kind, scene, picture = damage.damaged(number)
    base = right(scene).picture()
    assert picture.shape == base.shape and np.isfinite(picture).all()
    assert (np.abs(picture - base).max(axis=-1) > 0.01).sum() > 100, kind
    assert np.array_equal(picture, damage.damaged(number)[2])
    if number + 20 < damage.COUNT:
        assert damage.damaged(number + 20)[0] == kind


@pytest.mark.torture
def test_damage_leaves_unexplained_pixels():
    for number in range(20):
        kind, scene, picture = damage.damaged(number)
        found = result_of(trace_and_compare(case_of(scene, picture)))
        assert found.counts.unexplained > 20, kind


@pytest.mark.slow
def test_a_moved_object_is_reached_behind_a_suspect_in_its_place():
    """The roller is suspected first: to look for it far away took the whole share of the work."""
    scene, picture, made, _ = made_of("object_moved (first by 0.4, -0.3, 0.2 m) | 4")
    told = result_of(diagnosed(compared_cell(scene, picture, made))).diagnosis.told
    assert len(told) == 1 and told[0].sentence.startswith("'Ball' is moved by")
