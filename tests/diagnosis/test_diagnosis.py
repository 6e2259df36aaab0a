"""The diagnosis: a fault gets its name and its numbers, and no other fault, or noise, gets it."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.case import MOST_VARIANTS, WHOLE, Variant
from reference_tracer.comparison.comparing import diagnosed, trace_and_compare
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.diagnosis.faults.changes import SCALED
from reference_tracer.diagnosis.faults.fault import Guess, Numbers, Option
from reference_tracer.diagnosis.faults.painted import Painted
from reference_tracer.diagnosis.faults.pose import Posed
from reference_tracer.diagnosis.faults.triangles import Triangles
from reference_tracer.diagnosis.variants import ASKING
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.report.lines import describe
from reference_tracer.tracer.progress import Progress, result_of

from ..cases import case_of
from .diagnosing import BY_NAME, diagnosis_of, names, pictured, within

SEED = 27


MADE = [
    ("pixel_offset", Numbers((0.5, 0.5))),
    ("pixel_offset", Numbers((-3.25, 7.5))),
    ("focal_length", Numbers((2.0,))),
    ("focal_length", Numbers((-30.0,))),
    ("roll", Numbers((1.5,))),
    ("mirrored_x", Option(1)),
    ("mirrored_y", Option(0)),
    ("sensor_fit", Option(0)),
    ("matrix_transposed", Option(0)),
    ("matrix_inverted", Option(0)),
    ("y_up", Option(0)),
    ("forward", Option(0)),
    ("shift_left_out", Option(0)),
    ("shift_sign", Option(1)),
    ("shift_unit", Option(0)),
    ("resolution_percentage", Option(2)),
    ("clip_end", Numbers((8.0,))),
    ("clip_start", Numbers((7.5,))),
    ("object_missing", Guess(object="Ball")),
    ("rotation_left_out", Guess(object="Box")),
    ("place_left_out", Guess(object="Ring")),
    ("object_scaled", Posed((1.15,), object="Ball", change=SCALED[0])),
    ("object_scaled", Posed((0.1,), object="Drum", change=SCALED[0])),
    ("scene_scaled", Numbers((0.1,))),
    ("object_moved", Posed((0.2, -0.1, 0.15), object="Box")),
    ("object_twice", Posed((0.9, 0.3, 0.8), object="Ball")),
    ("recolored", Numbers((0.1, 0.8, 0.9), object="Drum")),
    ("rows", Guess()),
    ("row_off", Option(0)),
    ("row_off", Option(3)),
]


QUICK = "pixel_offset", "sensor_fit", "object_missing", "rows"


FIRST = [next(g for n, g in MADE if n == name) for name in QUICK]  # the others take minutes


SOME = [
    pytest.param(n, g, id=f"{n}{number}", marks=() if g in FIRST else pytest.mark.torture)
    for number, (n, g) in enumerate(MADE)
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
    assert any(line.startswith("diagnosis: ") for line in describe(found))


@pytest.mark.torture
def test_two_faults_are_found_one_after_the_other(solids):
    frame = render(solids)
    wrong = BY_NAME["sensor_fit"].assume(case_of(solids, frame.color), Option(0))
    both = BY_NAME["pixel_offset"].assume(wrong, Numbers((0.5, 0.5)))
    found = diagnosis_of(solids, render(both.scene).color)
    # A crop about another point is both at once, in three numbers.
    assert names(found) in (["sensor_fit", "pixel_offset"], ["cropped"])
    assert found.diagnosis.left <= 1 and found.verdict == "differences"


@pytest.mark.torture
def test_two_objects_are_found_one_after_the_other(solids):
    frame = render(solids)
    wrong = BY_NAME["object_missing"].assume(case_of(solids, frame.color), Guess(object="Box"))
    color = (0.1, 0.9, 0.9)
    both = BY_NAME["recolored"].assume(wrong, Numbers(color, object="Ring"))
    found = diagnosis_of(solids, render(both.scene).color)
    # The missing box may as well have the floor's colour: that is said, too.
    assert {*names(found)} == {"object_missing", "recolored"}
    assert found.diagnosis.told[0].fault.name == "object_missing" and found.diagnosis.left == 0


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
    ("pixel_offset", Numbers((0.3, 0.0)), {"focal_length", "roll", "object_moved"}),
    ("focal_length", Numbers((0.5,)), {"pixel_offset", "roll"}),
    ("object_missing", Guess(object="Ball"), {"recolored", "processed", "object_moved"}),
    ("recolored", Numbers((0.3, 0.9, 0.1), object="Box"), {"object_missing", "processed"}),
    ("object_moved", Posed((0.3, 0.0, 0.0), object="Ball"), {"object_scaled", "object_twice"}),
    ("rows", Guess(), {"mirrored_x"}),
]


@pytest.mark.torture
@pytest.mark.parametrize(("name", "guess", "others"), ALIKE, ids=[name for name, *_ in ALIKE])
def test_a_fault_that_looks_like_another_does_not_get_its_name(solids, name, guess, others):
    found = diagnosis_of(solids, pictured(solids, name, guess))
    assert name in names(found) and not set(names(found)) & others


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


def test_between_two_variants_it_is_told_how_many_and_can_be_stopped(solids):
    """Each may take Blender long, which hears nothing meanwhile."""
    made = []

    def variants():
        for number in range(5):
            made.append(number)
            yield Variant("other_camera", solids, f"'{number}'")

    shown = np.roll(render(solids).color, 7, axis=1)
    case = case_of(solids, Picture(shown), curves=(), variants=variants)
    before = result_of(trace_and_compare(case))
    told = []
    for event in diagnosed(before):
        told += [event.words] if isinstance(event, Progress) else []
        if len(made) == 3:
            break
    assert told[1:] == [f"{n}/{MOST_VARIANTS}: {ASKING}" for n in (1, 2, 3, 4)]


def test_a_variant_may_number_its_instances_otherwise(solids):
    """Triangles of an instance are missing, and another fault is looked for beside."""
    name = solids.objects[solids.instances[-1].object]
    dropped = Triangles(0, [0], object=name)
    fewer = replace(solids, instances=solids.instances[-1:])
    [fault] = [f for f in FAULTS if f.name == "triangles_missing"]
    for scene in (solids, fewer):
        frame = render(scene)
        case = fault.assume(case_of(scene, Picture(frame.color)), dropped)
        meshes = [case.scene.meshes[i.mesh] for i in case.scene.instances]
        before = [scene.meshes[i.mesh] for i in scene.instances]
        assert [
            len(b.triangles) - len(m.triangles) for b, m in zip(before, meshes, strict=True)
        ] == [
            *([0] * (len(meshes) - 1)),
            1,
        ]


def test_a_variant_may_list_its_objects_otherwise(solids):
    """Two that are exchanged are held by their names: their numbers are others there."""
    last, *rest = range(len(solids.objects))[::-1]
    number = {last: 0} | {n: n + 1 for n in rest}
    listed = tuple(replace(i, object=number[i.object]) for i in solids.instances[::-1])
    names = (solids.objects[last], *solids.objects[:last])
    other = replace(solids, instances=listed, objects=names)
    color = render(solids).color
    guess = Painted(colors={("Ball", 0): np.array([[0.9, 0.1, 0.1, 1.0]], np.float32)})
    first, second = (
        render(BY_NAME["swapped_colors"].assume(case_of(scene, color), guess).scene).color
        for scene in (solids, other)
    )
    assert np.array_equal(first, second) and not np.array_equal(first, color)


def test_colours_put_right_are_those_of_the_picture(solids):
    """Of Blender's own picture, which no transform excuses: the page shows both."""
    frame = render(solids)
    color = frame.color[..., [2, 1, 0, 3]]
    found = result_of(trace_and_compare(case_of(solids, Picture(color))))
    [told] = within(found, np.inf).diagnosis.told
    assert told.fault.name == "channels"
    assert not np.array_equal(frame.color, color)
    np.testing.assert_array_equal(told.frame.color, color)
