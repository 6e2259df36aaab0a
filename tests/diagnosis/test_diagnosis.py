"""The diagnosis: a fault gets its name and its numbers, and no other fault, or noise, gets it."""

from __future__ import annotations

import json
import time
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.case import WHOLE, Variant
from reference_tracer.comparison.comparing import diagnosed, trace_and_compare
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.fault import Guess
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Region, ViewWindow
from reference_tracer.tracer.progress import result_of

from .cases import case_of

BY_NAME = {fault.name: fault for fault in FAULTS}
SEED = 27


@pytest.fixture
def solids(make):
    """Return solids of different colours over a floor, seen through a shifted window."""
    rng = np.random.default_rng(SEED)
    eye = (5, -6, 4)
    camera = make.camera(160, 90, half=0.3, eye=eye, target=(0, 0, 0))
    w = camera.window
    camera = replace(camera, window=ViewWindow(w.left + 0.03, w.right + 0.03, w.bottom, w.top))
    camera = replace(
        camera, window=replace(camera.window, top=w.top + 0.02, bottom=w.bottom + 0.02)
    )
    shapes = {
        "Floor": trimesh.creation.box((9, 9, 0.2)).apply_translation((0, 0, -1.2)),
        "Box": trimesh.creation.box((1.1, 0.7, 1.3)),
        "Ball": trimesh.creation.icosphere(3, radius=0.6),
        "Ring": trimesh.creation.torus(0.6, 0.22),
        "Drum": trimesh.creation.cylinder(0.45, 1.0),
    }
    places = ((0, 0, 0), (-1.2, -0.6, -0.3), (1.1, 0.6, 0.2), (0.2, 1.6, -0.2), (0.6, -1.4, -0.4))
    instances, meshes = [], []
    for n, (shape, place) in enumerate(zip(shapes.values(), places, strict=True)):
        matrix = trimesh.transformations.euler_matrix(
            *(rng.uniform(-0.4, 0.4, 3) if n else (0, 0, 0))
        )
        matrix[:3, 3] = place
        color = [*rng.uniform(0.1, 0.9, 3), 1.0]
        meshes.append(Mesh(shape.vertices, shape.faces))
        instances.append(Instance(n, n, matrix, [color]))
    scene = make.scene(camera, *meshes)
    return replace(scene, instances=tuple(instances), objects=tuple(shapes))


def diagnosis_of(scene, color, **known):
    """Return the comparison of a scene with a picture of unknown make, diagnosed."""
    case = case_of(scene, Picture(color), curves=(), **known)
    before = result_of(trace_and_compare(case))
    found = result_of(diagnosed(before, np.inf))  # however busy the machine is
    assert found.verdict == before.verdict
    return found


def pictured(scene, name, guess):
    """Return the picture that a fault makes of a scene."""
    frame = render(scene)
    wrong = BY_NAME[name].make(case_of(scene, frame.color), frame, guess)
    if wrong.scene is scene:
        return wrong.picture.color
    return render(wrong.scene).color


def names(found):
    """Return what is told."""
    return [told.fault.name for told in found.diagnosis.told] if found.diagnosis else []


MADE = [
    ("pixel_offset", Guess((0.5, 0.5))),
    ("pixel_offset", Guess((-3.25, 7.5))),
    ("focal_length", Guess((2.0,))),
    ("focal_length", Guess((-30.0,))),
    ("roll", Guess((1.5,))),
    ("mirrored_x", Guess((1.0,))),
    ("mirrored_y", Guess((0.0,))),
    ("sensor_fit", Guess((0.0,))),
    ("matrix_transposed", Guess((0.0,))),
    ("matrix_inverted", Guess((0.0,))),
    ("y_up", Guess((0.0,))),
    ("forward", Guess((0.0,))),
    ("shift_left_out", Guess((0.0,))),
    ("shift_sign", Guess((1.0,))),
    ("shift_unit", Guess((0.0,))),
    ("resolution_percentage", Guess((2.0,))),
    ("clip_end", Guess((8.0,))),
    ("clip_start", Guess((7.5,))),
    ("object_missing", Guess(object="Ball")),
    ("rotation_left_out", Guess(object="Box")),
    ("place_left_out", Guess(object="Ring")),
    ("object_scaled", Guess((1.15,), object="Ball")),
    ("object_scaled", Guess((0.1,), object="Drum")),
    ("scene_scaled", Guess((0.1,))),
    ("object_moved", Guess((0.2, -0.1, 0.15), object="Box")),
    ("object_twice", Guess((0.9, 0.3, 0.8), object="Ball")),
    ("smooth_displaced", Guess((0.05,), object="Ring")),
    ("recolored", Guess((0.1, 0.8, 0.9), object="Drum")),
    ("swapped_colors", Guess((2.0, 3.0))),
    ("rows", Guess()),
    ("row_off", Guess((0.0, 1.0))),
    ("row_off", Guess((-1.0, 0.0))),
]


QUICK = "pixel_offset", "sensor_fit", "object_missing", "rows"
FIRST = [next(g for n, g in MADE if n == name) for name in QUICK]  # the others take minutes
SOME = [
    pytest.param(n, g, id=f"{n}{g.values}", marks=() if g in FIRST else pytest.mark.torture)
    for n, g in MADE
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "guess"), SOME)
def test_a_fault_gets_its_name_and_its_numbers(solids, name, guess):
    color = pictured(solids, name, guess)
    found = diagnosis_of(solids, color)
    assert found.counts.unexplained > 10
    assert name in names(found)
    told = next(t for t in found.diagnosis.told if t.fault.name == name)
    assert told.settled >= 0.97 * told.unexplained
    assert told.broken <= 0.03 * told.settled
    fitted = told.fault.numbers and told.guess.low
    if fitted and name in ("pixel_offset", "focal_length", "roll"):
        np.testing.assert_allclose(told.guess.values, guess.values, atol=0.02)
    if fitted and name.startswith("clip"):
        [low], [high] = told.guess.low, told.guess.high
        assert low <= guess.values[0] <= high
    assert json.loads(json.dumps(found.to_dict(), allow_nan=False))["diagnosis"]["told"]
    assert any(line.startswith("diagnosis: ") for line in found.lines())


@pytest.mark.torture
def test_two_faults_are_found_one_after_the_other(solids):
    frame = render(solids)
    wrong = BY_NAME["sensor_fit"].make(case_of(solids, frame.color), frame, Guess((0.0,)))
    both = BY_NAME["pixel_offset"].make(wrong, frame, Guess((0.5, 0.5)))
    found = diagnosis_of(solids, render(both.scene).color)
    assert names(found) == ["sensor_fit", "pixel_offset"]
    assert found.diagnosis.left == 0 and found.verdict == "differences"


@pytest.mark.torture
def test_two_objects_are_found_one_after_the_other(solids):
    frame = render(solids)
    wrong = BY_NAME["object_missing"].make(case_of(solids, frame.color), frame, Guess(object="Box"))
    color = (0.1, 0.9, 0.9)
    both = BY_NAME["recolored"].make(wrong, frame, Guess(color, object="Ring"))
    found = diagnosis_of(solids, render(both.scene).color)
    assert sorted(names(found)) == ["object_missing", "recolored"]
    assert found.diagnosis.left == 0


def _noise(color, rng):
    where = rng.random(color.shape[:2]) < 0.05
    color[where, :3] = rng.random((int(where.sum()), 3))
    return color


def _distorted(color, rng):
    """Distort it as a lens does: the corners move by 9 pixels, the middle by none."""
    h, w = color.shape[:2]
    y, x = np.mgrid[:h, :w] + 0.5
    u, v = x - w / 2, y - h / 2
    far = 1 + 9 / np.hypot(w / 2, h / 2) ** 3 * (u * u + v * v)
    column = np.clip(u * far + w / 2, 0, w - 1).astype(int)
    row = np.clip(v * far + h / 2, 0, h - 1).astype(int)
    return color[row, column]


def _rolling(color, rng):
    """Move every row a little more than the one below it."""
    rows = [np.roll(row, round(6 * n / len(color)), axis=0) for n, row in enumerate(color)]
    return np.array(rows)


def _blurred(color, rng):
    """Mix the pixels of a part of the picture."""
    part = color[20:60, 40:110]
    mixed = sum(np.roll(part, (i, j), (0, 1)) for i in (-2, 0, 2) for j in (-2, 0, 2)) / 9
    color[20:60, 40:110] = mixed
    return color


def _shuffled(color, rng):
    """Exchange blocks of the picture."""
    for _ in range(12):
        (a, b), (c, d) = (rng.integers(0, (80, 150)) for _ in range(2))
        one, other = color[a : a + 8, b : b + 8].copy(), color[c : c + 8, d : d + 8].copy()
        color[a : a + 8, b : b + 8], color[c : c + 8, d : d + 8] = other, one
    return color


def _salt(color, rng):
    """Make single pixels white."""
    color[rng.random(color.shape[:2]) < 0.02] = 1
    return color


TORTURE = _salt, _distorted, _rolling, _blurred, _shuffled
LONG = [pytest.param(d, marks=pytest.mark.torture) for d in TORTURE]


@pytest.mark.slow
@pytest.mark.parametrize("damage", [_noise, *LONG])
def test_damage_gets_no_name(solids, damage):
    color = damage(render(solids).color.copy(), np.random.default_rng(SEED))
    found = diagnosis_of(solids, color)
    assert found.counts.unexplained > 50
    assert names(found) == []
    told = found.diagnosis
    assert told.left >= found.counts.unexplained and told.regions
    assert sum(region.pixels for region in told.regions) == told.left


@pytest.mark.torture
def test_an_object_that_is_turned_is_not_said_to_be_moved(solids):
    box = solids.instances[1]
    turned = trimesh.transformations.rotation_matrix(0.5, (1, 0.3, 0.2))
    instances = list(solids.instances)
    instances[1] = replace(box, world_from_object=box.world_from_object @ turned)
    found = diagnosis_of(solids, render(replace(solids, instances=tuple(instances))).color)
    assert found.counts.unexplained > 50 and names(found) == []
    assert "Box" in found.diagnosis.regions[0].objects


ALIKE = [
    ("pixel_offset", Guess((0.3, 0.0)), {"focal_length", "roll", "object_moved"}),
    ("focal_length", Guess((0.5,)), {"pixel_offset", "roll"}),
    ("object_missing", Guess(object="Ball"), {"recolored", "overlay", "object_moved"}),
    ("recolored", Guess((0.3, 0.9, 0.1), object="Box"), {"object_missing", "overlay"}),
    ("object_moved", Guess((0.3, 0.0, 0.0), object="Ball"), {"object_scaled", "object_twice"}),
    ("rows", Guess(), {"mirrored_x"}),
]


@pytest.mark.torture
@pytest.mark.parametrize(("name", "guess", "others"), ALIKE, ids=[name for name, *_ in ALIKE])
def test_a_fault_that_looks_like_another_does_not_get_its_name(solids, name, guess, others):
    found = diagnosis_of(solids, pictured(solids, name, guess))
    assert name in names(found) and not set(names(found)) & others


@pytest.mark.torture
@pytest.mark.parametrize("opacity", [0.4, 1.0])
def test_something_laid_over_the_picture(solids, opacity):
    """But a part of it that has the colour of an object may be that object."""
    color = render(solids).color.copy()
    part = color[30:60, 60:130]
    part[:] = (1 - opacity) * part + opacity * np.array((0.02, 0.97, 0.95, 1))
    found = diagnosis_of(solids, color)
    assert names(found) == ["overlay"]
    assert found.diagnosis.told[0].guess.values[0] == pytest.approx(opacity, abs=0.01)
    like = render(solids).color.copy()
    like[30:60, 60:130] = solids.instances[2].colors[0]
    assert "overlay" not in names(diagnosis_of(solids, like))


@pytest.mark.slow
@pytest.mark.parametrize("size", [0.5, 0.75])
def test_what_a_border_shows_may_be_resampled(solids, size):
    """Its pixels at another size are those of a picture with just its window."""
    camera = replace(solids.camera, region=Region(24, 10, 144, 82))
    scene = replace(solids, camera=camera)
    c, w = camera, camera.window
    x, y = (w.right - w.left) / c.width, (w.top - w.bottom) / c.height
    part = ViewWindow(w.left + 24 * x, w.left + 144 * x, w.bottom + 10 * y, w.bottom + 82 * y)
    wide, high = round(size * 120), round(size * 72)
    small = replace(c, window=part, width=wide, height=high, region=Region(0, 0, wide, high))
    rows = ((np.arange(72) + 0.5) * size).astype(int)
    columns = ((np.arange(120) + 0.5) * size).astype(int)
    found = diagnosis_of(scene, render(replace(scene, camera=small)).color[rows][:, columns])
    assert names(found) == ["resampled"]
    assert found.diagnosis.told[0].guess.values[0] == size


INK = np.where(np.arange(40)[:, None] % 6 < 3, 0.95, 0.02)


@pytest.mark.slow
def test_stripes_in_a_box_over_one_surface_are_laid_over_it(solids):
    """Their opacity lies between two."""
    right = render(solids)
    floor = right.object_index == right.object_index[5, 24]
    assert floor[2:14, 4:44].all()
    striped = right.color.copy()
    striped[2:14, 4:44, :3] = 0.4 * striped[2:14, 4:44, :3] + 0.6 * INK
    found = diagnosis_of(solids, striped)
    assert names(found) == ["overlay"] and overlaid(solids, striped)
    guess = found.diagnosis.told[0].guess
    assert guess.low[0] <= 0.6 <= guess.high[0] == 1


@pytest.mark.torture
def test_one_colour_or_a_round_shape_may_be_an_unknown_object(solids):
    striped, plain, round_ = (render(solids).color.copy() for _ in range(3))
    striped[2:14, 4:44, :3] = 0.4 * striped[2:14, 4:44, :3] + 0.6 * INK
    plain[2:14, 4:44, :3] = (0.02, 0.97, 0.95)
    assert not overlaid(solids, plain)
    y, x = np.mgrid[2:14, 4:44]
    disc = np.hypot(y - 8, (x - 24) / 3) < 6
    round_[2:14, 4:44][disc] = striped[2:14, 4:44][disc]
    assert not overlaid(solids, round_)


def overlaid(scene, color):
    """Return what is told of a picture if nothing but an overlay is looked for."""
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    assert found.counts.unexplained > 50
    faults = [BY_NAME["overlay"]]
    return result_of(diagnose(found.case, found.frame, found.causes, faults, np.inf)).told


def test_nothing_is_done_where_nothing_is_unexplained(solids):
    def never():
        raise AssertionError("no variant is asked for")

    case = case_of(solids, Picture(render(solids).color), variants=never)
    found = result_of(trace_and_compare(case))
    assert result_of(diagnosed(found)) is found and found.diagnosis is None
    assert found.to_dict()["diagnosis"] is None


@pytest.mark.slow
def test_a_variant_is_told_by_its_fault_and_words(solids):
    """Also where the scene that is compared lacks what its own camera does not see."""
    eye = solids.camera.world_from_camera.copy()
    eye[:3, 3] += (0.5, 1.0, 0.2)
    other = replace(solids.camera, world_from_camera=eye)
    near = replace(solids.camera, clip_start=0.2)
    lacking = replace(solids, instances=solids.instances[:-1])  # as if the drum were out of view
    lacking = replace(lacking, objects=solids.objects)
    asked = (
        Variant(WHOLE, solids),
        Variant("other_camera", solids.seen_by(other), "'Side'", "Side"),
        Variant("other_camera", solids.seen_by(near), "'Near'", "Near"),
    )
    shown = render(solids.seen_by(other)).color
    found = diagnosis_of(lacking, shown, variants=lambda: asked)
    assert names(found) == ["other_camera"]
    assert "'Side'" in found.diagnosis.told[0].sentence


def test_a_variant_may_number_its_instances_otherwise(solids):
    """Triangles of an instance are missing, and another fault is looked for beside."""
    name = solids.objects[solids.instances[-1].object]
    dropped = Guess((1.0, 0.0, 0.0), object=name)
    fewer = replace(solids, instances=solids.instances[-1:])
    [fault] = [f for f in FAULTS if f.name == "triangles_missing"]
    for scene in (solids, fewer):
        frame = render(scene)
        case = fault.make(case_of(scene, Picture(frame.color)), frame, dropped)
        meshes = [case.scene.meshes[i.mesh] for i in case.scene.instances]
        before = [scene.meshes[i.mesh] for i in scene.instances]
        assert [
            len(b.triangles) - len(m.triangles) for b, m in zip(before, meshes, strict=True)
        ] == [
            *([0] * (len(meshes) - 1)),
            1,
        ]


def test_colours_put_right_are_those_of_the_picture(solids):
    """Of Blender's own picture, which no transform excuses: the page shows both."""
    frame = render(solids)
    color = frame.color[..., [2, 1, 0, 3]]
    found = result_of(trace_and_compare(case_of(solids, Picture(color))))
    [told] = result_of(diagnosed(found, np.inf)).diagnosis.told
    assert told.fault.name == "channels"
    assert not np.array_equal(frame.color, color)
    np.testing.assert_array_equal(told.frame.color, color)


def _known_by(found):
    """Return a diagnosis as JSON has it, but for the seconds, which are a measurement."""
    out = found.diagnosis.to_dict()
    assert out.pop("seconds") >= 0
    return out


@pytest.fixture
def pair(make):
    """Return two boxes, few pixels: a diagnosis of them takes a second."""
    camera = make.camera(48, 27, half=0.3, eye=(5, -6, 4), target=(0, 0, 0))
    shape = trimesh.creation.box((1.2, 0.8, 1.0))
    scene = make.scene(camera, *(Mesh(shape.vertices, shape.faces) for _ in range(2)))
    matrices = [trimesh.transformations.translation_matrix(v) for v in ((-0.8, 0, 0), (0.8, 0, 0))]
    colors = ((0.9, 0.1, 0.1, 1.0), (0.1, 0.2, 0.9, 1.0))
    instances = [
        Instance(n, n, m, [c]) for n, (m, c) in enumerate(zip(matrices, colors, strict=True))
    ]
    return replace(scene, instances=tuple(instances), objects=("Left", "Right"))


@pytest.mark.slow
def test_the_clock_changes_nothing_but_the_seconds(pair, monkeypatch):
    """It ends by steps of work: a machine a thousand times as slow gives the same answer."""
    before = result_of(trace_and_compare(case_of(pair, Picture(_salted(pair)), curves=())))
    calm = result_of(diagnosed(before, 600))
    clock = time.monotonic
    monkeypatch.setattr(time, "monotonic", lambda: 1000 * clock())
    hurried = result_of(diagnosed(before, 600))
    assert calm.diagnosis.untried and _known_by(calm) == _known_by(hurried)
    whole = result_of(diagnosed(before))
    assert whole.diagnosis.steps > 600 and not whole.diagnosis.untried
    assert not whole.to_dict()["diagnosis"]["ended"]


def _salted(scene):
    color = render(scene).color.copy()
    color[::3, ::5, :3] = (0.3, 0.9, 0.2)
    return color


@pytest.mark.parametrize("steps", [1, 20, 150])
def test_it_ends_inside_a_guess_and_says_what_was_not_looked_for(pair, steps):
    moved = pictured(pair, "pixel_offset", Guess((0.4, 0.2)))
    before = result_of(trace_and_compare(case_of(pair, Picture(moved), curves=())))
    found = result_of(diagnosed(before, steps)).diagnosis
    assert found.steps == steps and "pixel_offset" in found.untried
    said = [line for line in found.lines() if "a limit of work ended" in line]
    assert len(said) == 1 and " more)" in said[0]
    assert found.to_dict()["ended"] and found.to_dict()["untried"] == list(found.untried)


@pytest.mark.slow
def test_a_picture_without_the_scene_is_told_in_few_lines(pair):
    """What makes it so follows in one line: nothing tells one from the other."""
    color = np.broadcast_to(pair.background, (27, 48, 4)).copy()
    found = diagnosis_of(pair, color)
    first, *others = found.diagnosis.told
    assert first.fault.name == "nothing_shown" and not others
    assert len(first.also) >= 2
    lines = found.diagnosis.lines()
    assert lines[0] == "diagnosis: nothing of the scene is in the picture"
    assert len(lines) == 4
    one = replace(pair, instances=pair.instances[:1])
    assert "nothing_shown" not in names(diagnosis_of(pair, render(one).color))


@pytest.mark.torture
def test_each_fault_that_is_told_makes_more_pixels_agree(solids):
    """Two faults that only do together: of the first one, few pixels are lost."""
    frame = render(solids)
    first = BY_NAME["object_missing"].make(
        case_of(solids, frame.color), frame, Guess(object="Ball")
    )
    both = BY_NAME["pixel_offset"].make(first, frame, Guess((0.5, 0.5)))
    found = diagnosis_of(solids, render(both.scene).color).diagnosis
    assert found.told
    for told in found.told:
        assert told.settled > told.broken and told.broken <= 0.1 * told.settled


@pytest.mark.torture
def test_no_resampling_is_told_beside_a_fault_of_an_object(solids):
    """Each object has another colour, as in a picture that is more saturated."""
    color = render(solids).color.copy()
    gray = color[..., :3].mean(axis=-1, keepdims=True)
    color[..., :3] = np.clip(gray + 1.25 * (color[..., :3] - gray), 0, 1)
    assert not {"resampled", "jpeg", "filter_radius"} & set(names(diagnosis_of(solids, color)))
