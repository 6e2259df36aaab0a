"""Faults of where things are and what is drawn over what: their names, and what encloses them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.fault import Guess
from reference_tracer.diagnosis.faults.fitting import Traced
from reference_tracer.diagnosis.faults.stand import TURNED
from reference_tracer.diagnosis.guessing import ALL_EDGES
from reference_tracer.pictures.picture import Picture
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Scene, ViewWindow
from reference_tracer.tracer.progress import result_of

from .cases import case_of

BY_NAME = {fault.name: fault for fault in FAULTS}
OBJECTS = "Box", "Ball", "Ring", "Drum"


@pytest.fixture
def few(make):
    """Return what makes some solids over a floor, seen through a shifted window."""

    def made(width=64, height=40, parallel=False, seed=27) -> Scene:
        rng = np.random.default_rng(seed)
        camera = make.camera(width, height, eye=(5, -6, 4), target=(0, 0, 0))
        x = 2.3 if parallel else 0.32
        y = x * height / width
        window = ViewWindow(0.03 - x, 0.03 + x, 0.02 - y, 0.02 + y)
        if parallel:
            camera = replace(camera, projection=ORTHOGRAPHIC)
        camera = replace(camera, window=window)
        shapes = (
            trimesh.creation.box((9, 9, 0.2)).apply_translation((0, 0, -1.2)),
            trimesh.creation.box((1.1, 0.7, 1.3)),
            trimesh.creation.icosphere(2, radius=0.6),
            trimesh.creation.torus(0.6, 0.22, 16, 12),
            trimesh.creation.cylinder(0.45, 1.0, 16),
        )
        places = (0, 0, 0), (-1.2, -0.6, -0.3), (1.1, 0.6, 0.2), (0.2, 1.6, -0.2), (0.6, -1.4, -0.4)
        instances = []
        for n, place in enumerate(places):
            angles = rng.uniform(-0.4, 0.4, 3) if n else (0, 0, 0)
            matrix = trimesh.transformations.euler_matrix(*angles)
            matrix[:3, 3] = place
            instances.append(Instance(n, n, matrix, [[*rng.uniform(0.1, 0.9, 3), 1.0]]))
        meshes = tuple(Mesh(s.vertices, s.faces) for s in shapes)
        return Scene(camera, meshes, tuple(instances), objects=("Floor", *OBJECTS))

    return made


def pictured(scene, name, guess):
    """Return the picture that a fault makes of a scene."""
    frame = render(scene)
    wrong = BY_NAME[name].make(case_of(scene, Picture(frame.color)), frame, guess)
    return wrong.picture.color if wrong.scene is scene else render(wrong.scene).color


def told(scene, color, *names):
    """Return what is told of a picture, if only some faults are looked for."""
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    assert found.counts.unexplained > 10
    faults = [BY_NAME[name] for name in names] or FAULTS
    said = result_of(diagnose(found.case, found.frame, found.causes, faults, np.inf)).told
    assert all(t.settled >= 0.97 * t.unexplained for t in said[:1])
    return {t.fault.name: t for t in said}


def fitted(scene, color, name):
    """Return the numbers of a fault that fit a picture, with what encloses them."""
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    evidence = Evidence(found.case, found.frame, found.causes)
    if evidence.open.sum() < 25:
        return None
    fault = BY_NAME[name]
    guesses = [g for g in result_of(fault.find(evidence)) if g.low]
    gains = [
        result_of(evidence.score(fault.tried(found.case, found.frame, g))).gain for g in guesses
    ]
    best = guesses[int(np.argmax(gains))]
    return result_of(fault.refine(replace(evidence, size=ALL_EDGES), best))


# ---- numbers are enclosed

KINDS = {
    "object_moved": lambda rng: rng.uniform(-0.25, 0.25, 3) * (rng.random(3) < 0.7),
    "camera_moved": lambda rng: rng.uniform(-0.3, 0.3, 3),
    "camera_turned": lambda rng: rng.uniform(-2, 2, 3),
    "pixel_offset": lambda rng: rng.uniform(-4, 4, 2),
    "focal_length": lambda rng: rng.uniform(-10, 10, 1),
    "focal_lengths": lambda rng: rng.uniform(-8, 8, 2),
    "object_scaled": lambda rng: rng.uniform(0.8, 1.3, 1),
}


def enclosed(few, seed, size):
    """Return whether a random fault's numbers lie between what is told; None if hardly seen."""
    rng = np.random.default_rng(seed)
    name = list(KINDS)[seed % len(KINDS)]
    scene = few(*size, parallel=rng.random() < 0.25, seed=seed)
    values = tuple(float(v) for v in KINDS[name](rng))
    guess = Guess(values, object=str(rng.choice(OBJECTS)) if "object" in name else "")
    found = fitted(scene, pictured(scene, name, guess), name)
    if found is None:
        return None
    assert all(a <= v <= b for a, v, b in zip(found.low, found.values, found.high, strict=True))
    return all(a <= v <= b for a, v, b in zip(found.low, values, found.high, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [*(pytest.param(n, marks=pytest.mark.torture) for n in range(3)), 3, 4, 5, 6]
)
def test_the_numbers_that_are_told_enclose_the_right_ones(few, seed):
    assert enclosed(few, seed, (48, 30)) is not False


@pytest.mark.torture
@pytest.mark.parametrize("part", range(10))
def test_the_right_numbers_are_enclosed_nearly_always(few, part):
    """A fit may stop beside the best place: at most one in eleven."""
    results = [enclosed(few, 100 + 11 * part + n, (112, 64)) for n in range(11)]
    assert results.count(False) <= 1


@pytest.mark.torture
def test_an_object_that_sinks_is_told_as_it_is(few):
    """Its distance is hardly seen: of all moves that fit, that with zeros is the right one."""
    scene = few(96, 54)
    color = pictured(scene, "object_moved", Guess((0, 0, -0.06), object="Box"))
    found = fitted(scene, color, "object_moved")
    assert found.values[:2] == (0, 0) and found.values[2] == pytest.approx(-0.06, abs=0.01)


@pytest.mark.slow
def test_what_an_orthographic_camera_cannot_see_is_left_open(few):
    scene = few(parallel=True)
    move = (0.2, 0.1, 0)
    found = fitted(
        scene, pictured(scene, "object_moved", Guess(move, object="Box")), "object_moved"
    )
    away = scene.camera.forward
    assert np.all(np.subtract(found.high, found.low) > np.abs(away))  # metres
    beside = np.subtract(found.values, move)
    assert np.linalg.norm(beside - (beside @ away) * away) < 0.05


def test_an_orthographic_camera_that_turns_leaves_what_was_near_its_rays(few):
    """What is far away moves by many pixels: triangles are looked for anew."""
    scene, turn = few(parallel=True), (0.4, 0.25, 0.0)
    matrix = scene.camera.world_from_camera.copy()
    matrix[:3, 3] -= 60 * scene.camera.forward
    scene = scene.seen_by(replace(scene.camera, world_from_camera=matrix))
    color = pictured(scene, "camera_turned", Guess(turn))
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    traced = Traced(Evidence(found.case, found.frame, found.causes), TURNED.camera)
    assert not result_of(traced.right((0.0, 0.0, 0.0))).all()
    assert result_of(traced.right(turn)).all()


# ---- names


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
    scene = few()
    found = told(scene, pictured(scene, name, Guess(values)), name, *rivals)
    assert list(found) == [name]


@pytest.mark.slow
def test_an_object_that_moves_by_a_fraction_of_a_pixel(few):
    """Fitted roughly, it would break as many pixels at its edges as it settles."""
    scene = few(384, 216)
    color = pictured(scene, "object_moved", Guess((0, 0.004, -0.003), object="Box"))
    found = told(scene, color, "object_moved", "object_missing")
    assert list(found) == ["object_moved"] and found["object_moved"].guess.object == "Box"


@pytest.mark.torture
def test_an_object_is_told_and_no_camera(few):
    scene = few()
    color = pictured(scene, "object_moved", Guess((0.3, -0.2, 0.1), object="Ball"))
    assert list(told(scene, color, "object_moved", "camera_moved", "camera_turned")) == [
        "object_moved"
    ]


@pytest.mark.torture
@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("camera_moved", (0.05, -0.02, 0.04)),
        ("camera_turned", (3.0, -2.0, 1.0)),
        ("focal_lengths", (2.0, -1.0)),
    ],
)
def test_of_all_faults_that_of_the_camera_is_told(few, name, values):
    scene = few(112, 64)
    found = told(scene, pictured(scene, name, Guess(values)))
    assert list(found) == [name]
    np.testing.assert_allclose(found[name].guess.values, values, atol=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "values"),
    [("last_pixel", (0.0,)), ("swapped_transforms", (1.0, 2.0)), ("picture_turned", (2.0,))],
)
def test_a_fault_without_numbers_is_told_alone(few, name, values):
    scene = few(96, 54)
    assert list(told(scene, pictured(scene, name, Guess(values)))) == [name]


def test_a_focal_length_is_not_taken_for_the_last_pixel(few):
    scene = few(96, 54)
    color = pictured(scene, "focal_length", Guess((-100 / 96,)))
    assert list(told(scene, color, "last_pixel", "focal_length")) == ["focal_length"]


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
    rolled = pictured(scene, "roll", Guess((90.0,)))
    assert "picture_turned" not in told(scene, rolled, "picture_turned", "roll")


def test_a_shear_that_is_left_out(few):
    """An object that is turned has none."""
    scene = few(96, 54)
    instances = list(scene.instances)
    sheared = instances[1].world_from_object.copy()
    sheared[:3, :3] = np.diag((1.0, 1.6, 0.8)) @ sheared[:3, :3]
    instances[1] = replace(instances[1], world_from_object=sheared)
    scene = replace(scene, instances=tuple(instances))
    color = pictured(scene, "shear_left_out", Guess((1.0,), object="Box"))
    assert list(told(scene, color, "shear_left_out", "rotation_left_out", "scale_left_out")) == [
        "shear_left_out"
    ]
    without = pictured(scene, "scale_left_out", Guess(object="Box"))
    assert list(told(scene, without, "shear_left_out", "scale_left_out")) == ["scale_left_out"]


SHIFTS = "shift_length", "shift_left_out", "shift_sign", "shift_unit"


@pytest.mark.slow
@pytest.mark.parametrize("factor", [1 / 36, 64.0])
def test_a_shift_in_another_length(few, factor):
    scene = few()
    w = scene.camera.window
    small = 0.2 if factor > 1 else 2.0  # so that something is seen with either
    x, y = small * (w.left + w.right) / 2, small * (w.bottom + w.top) / 2
    right = replace(scene.camera, window=_about(w, x, y))
    wrong = replace(scene.camera, window=_about(w, factor * x, factor * y))
    scene = scene.seen_by(right)
    color = render(scene.seen_by(wrong)).color
    assert "shift_length" in told(scene, color, *SHIFTS)


def test_a_shift_of_another_sign_is_in_no_other_length(few):
    color = pictured(few(), "shift_sign", Guess((0.0,)))
    assert "shift_length" not in told(few(), color, *SHIFTS)


def _about(window, x, y):
    half_x, half_y = (window.right - window.left) / 2, (window.top - window.bottom) / 2
    return ViewWindow(x - half_x, x + half_x, y - half_y, y + half_y)


def test_pixels_taken_for_squares_about_the_windows_own_centre(few):
    scene = few()
    w = scene.camera.window
    tall = replace(w, bottom=0.02 + 1.4 * (w.bottom - 0.02), top=0.02 + 1.4 * (w.top - 0.02))
    tall = scene.seen_by(replace(scene.camera, window=tall))
    color = render(scene).color
    assert list(told(tall, color, "pixel_aspect_left_out", "focal_lengths")) == [
        "pixel_aspect_left_out"
    ]


# ---- what is drawn over what


def drawn(scene, ranks):
    """Return the picture with one instance drawn over the other, the lowest rank first."""
    out = None
    for instance in np.argsort(ranks, kind="stable"):
        alone = render(replace(scene, instances=(scene.instances[instance],)))
        own = (alone.instance_index >= 0)[..., None]
        out = np.where(own, alone.color, alone.color if out is None else out)
    return out


def test_objects_drawn_one_over_the_other(few):
    """By their origins' distances, or as they are listed; but not where one is missing."""
    scene = few(96, 54)
    away = [
        np.linalg.norm(i.world_from_object[:3, 3] - scene.camera.origin) for i in scene.instances
    ]
    names = "depth_order", "object_missing"
    for ranks, words in ((np.negative(away), "origins"), (range(5), "as they are listed")):
        found = told(scene, drawn(scene, ranks), *names)
        assert "depth_order" in found and words in found["depth_order"].sentence
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
        guess = Guess(values, words=TURNED.words(None, Guess(values)))
        assert fault.told(guess) == said
