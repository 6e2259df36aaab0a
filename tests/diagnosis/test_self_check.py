"""The self-check: every fault that can be seen is caught, and one that cannot is said to be so."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes import explain as causes
from reference_tracer.causes.case import Alternative
from reference_tracer.causes.cause import Causes, Hidden
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.diagnosis import self_check as self_checking
from reference_tracer.diagnosis.fault_rows import FaultRow, table
from reference_tracer.diagnosis.faults import EXAMPLES
from reference_tracer.diagnosis.faults.fault import Example, Fault
from reference_tracer.diagnosis.self_check import self_check
from reference_tracer.diagnosis.trial import same_shapes, traced_anew
from reference_tracer.manifest import Effect, ObjectEntry, Unmodelled
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.report.lines import describe
from reference_tracer.scene import without
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..cases import case_of, owners_of

# Constant shading has no normals; behind a solid's triangle is another of its colour; no frame.
INVISIBLE = {"flipped_winding", "dropped_triangle", "wrong_frame"}


def checked(case, names=None, examples=EXAMPLES):
    """Return the rows of a case's self-check, by the names of some faults."""
    frame = render(case.scene, case.settings)
    examples = [(f, e) for f, e in examples if names is None or e.name in names]
    found = self_check(case, frame, Causes.none(frame.t.shape), examples)
    return {row.name: row for row in result_of(found)}


@pytest.fixture
def case(room):
    room = replace(room, objects=("Ball", "Box", "Wall"))
    frame = render(room)
    picture = Picture(frame.color, owners=owners_of(room.objects, frame))
    return case_of(room, picture)


def test_objects_of_one_name_are_told_apart(make):
    """Two nodes of a file may share a name; the first of them is out of view."""
    quads = make.quad(50, 51, 0, 1, -2), make.quad(-0.7, 0.6, -0.3, 0.5, -2)
    scene = replace(make.scene(make.camera(40, 30), *quads), objects=("Chair", "Chair"))
    names = ("dropped_instance", "dropped_triangle", "moved_object")
    rows = checked(case_of(scene, render(scene).color), names)
    assert [rows[name].result for name in names] == ["caught"] * 3


def test_what_has_other_colors_alone_is_painted_anew(case):
    """Nothing else is; and the picture is the one that would be traced."""
    frame = render(case.scene)
    painted = set()
    for fault, example in EXAMPLES:
        guess = example.pick(case, frame)
        wrong = guess and (example.make or fault.assume)(case, guess)
        if not wrong or wrong.scene is case.scene:
            continue
        if same_shapes(wrong.scene, case.scene):
            painted.add(example.name)
            found = result_of(traced_anew(wrong, case, frame)).passes()
            for name, values in render(wrong.scene).passes().items():
                assert np.array_equal(found[name], values), (example.name, name)
    assert painted == {"swapped_colors", "one_shade", "one_channels"}


@pytest.mark.slow
@pytest.mark.parametrize("known", [True, False], ids=["identity", "colours alone"])
def test_every_fault_is_caught_but_those_that_change_nothing(case, known):
    if not known:
        case = replace(case, picture=Picture(case.picture.color))
    color, window = case.picture.color.copy(), case.scene.camera.window
    rows = checked(case)
    assert set(rows) == {example.name for _, example in EXAMPLES}
    for name, row in rows.items():
        assert row.result == ("cannot be seen here" if name in INVISIBLE else "caught"), row
        assert row.unexplained <= row.looked_at <= row.differ
        assert (row.changed > 0) == (name not in INVISIBLE)
    assert rows["mirrored_x"].unexplained > 100
    # Nothing is changed of the case.
    np.testing.assert_array_equal(case.picture.color, color)
    np.testing.assert_array_equal(render(case.scene).color, color)
    assert case.scene.camera.window == window


@pytest.mark.parametrize(
    ("half", "result"), [(0.71, "cannot be seen here"), (0.7, "within rounding")]
)
def test_a_mirrored_camera_cannot_be_seen_in_a_symmetric_scene(make, half, result):
    """Or only in the pixels whose centres lie on an edge of it."""
    scene = make.scene(make.camera(40, 30), make.quad(-half, half, -0.3, 0.5, -2))
    rows = checked(case_of(scene, render(scene).color), ("mirrored_x", "mirrored_y"))
    assert rows["mirrored_x"].result == result
    assert rows["mirrored_y"].result == "caught"
    assert "1 of 1 faults that can be seen here are caught" in table(list(rows.values()))[0]


@pytest.mark.parametrize(
    ("pixels", "result"),
    [(0.0, "cannot be seen here"), (1 / 400, "within rounding"), (1 / 4, "caught")],
)
def test_a_fault_within_rounding_is_none(stripes, pixels, result):
    """Of the camera: what float32 may do itself."""

    def nudge(case, guess):
        w = case.scene.camera.window
        x = pixels * (w.right - w.left) / case.scene.camera.width
        window = replace(w, left=w.left + x, right=w.right + x)
        camera = replace(case.scene.camera, window=window)
        return replace(case, scene=replace(case.scene, camera=camera))

    case = case_of(stripes, render(stripes).color)
    fault = Fault("nudge", "hardly anything", "Nobody knows.", "nothing", nudge)
    row = checked(case, examples=[(fault, Example("nudge", "hardly anything"))])["nudge"]
    assert row.result == result and (row.unexplained > 0) == (result == "caught")
    assert FaultRow("a", "b", 5, 5, 5, 0).missed and not FaultRow("a", "b", 5, 5, 5, 1).missed


@pytest.mark.parametrize(
    ("samples", "result"), [((1,), "within rounding"), ((1, 4096), "caught"), ((4096,), "caught")]
)
def test_more_pixels_are_looked_at_where_few_show_nothing(stripes, monkeypatch, samples, result):
    """Of a picture that is too tall, the lowest pixel that differs is hardly moved."""

    def stretch(case, guess):
        w = case.scene.camera.window
        window = replace(w, top=w.top + 2 * (w.top - w.bottom) / case.scene.camera.height)
        camera = replace(case.scene.camera, window=window)
        return replace(case, scene=replace(case.scene, camera=camera))

    monkeypatch.setattr(self_checking, "SAMPLES", samples)
    case = case_of(stripes, render(stripes).color)
    fault = Fault("stretch", "too tall", "a wrong aspect", "nothing", stretch)
    row = checked(case, examples=[(fault, Example("stretch", "too tall"))])["stretch"]
    assert row.result == result and (row.looked_at == 1) == (samples == (1,))


def test_an_open_sheet_shows_a_dropped_triangle(make):
    scene = make.scene(make.camera(40, 30), make.quad(-0.7, 0.6, -0.3, 0.5, -2))
    rows = checked(case_of(scene, render(scene).color), ("dropped_triangle",))
    assert rows["dropped_triangle"].result == "caught"


@pytest.mark.slow
def test_what_may_change_anything_anywhere_hides_every_fault(case):
    everywhere = (Unmodelled("scene 'Scene'", "x-ray", effect=Effect.PICTURE),)
    rows = checked(replace(case, manifest=replace(case.manifest, unmodelled=everywhere)))
    assert {row.result for row in rows.values()} == {"cannot be judged here", "cannot be seen here"}


def test_the_scene_a_frame_later(case):
    instances = list(case.scene.instances)
    matrix = instances[1].world_from_object.copy()
    matrix[:3, 3] += 0.2
    instances[1] = replace(instances[1], world_from_object=matrix)
    later = replace(case, next_frame=replace(case.scene, instances=tuple(instances)))
    assert checked(later, ("wrong_frame",))["wrong_frame"].result == "caught"


def test_the_scene_a_frame_later_with_other_instances(case):
    """An emitter's come and go: whose the next frame's are is not known, its colours are."""
    later = replace(case, next_frame=replace(case.scene, instances=case.scene.instances[1:]))
    assert checked(later, ("wrong_frame",))["wrong_frame"].result == "caught"


@pytest.mark.slow
def test_in_a_comparison_on_request(case):
    with_check = result_of(trace_and_compare(replace(case, self_check=True)))
    assert len(with_check.self_check) == len(EXAMPLES) and with_check.verdict == "agree"
    held = json.loads(json.dumps(with_check.to_dict(), allow_nan=False))["self_check"]
    assert {row["result"] for row in held} == {"caught", "cannot be seen here"}
    caught = sum(row["result"] == "caught" for row in held)
    assert any(f"self-check: {caught} of {caught}" in line for line in describe(with_check))
    assert result_of(trace_and_compare(case)).self_check == ()
    missed = replace(with_check, self_check=(FaultRow("a", "b", 5, 5, 5, 0),))
    assert missed.verdict == "warnings"


def test_an_empty_scene_has_nothing_to_get_wrong(make):
    scene = make.scene(make.camera(8, 6))
    rows = checked(case_of(scene, render(scene).color))
    assert {row.result for row in rows.values()} == {"cannot be seen here"}


def test_it_explains_as_the_comparison_does(case, monkeypatch):
    """With the alternatives, the curves, the absent objects, and traced by the same method."""
    whole, lacking = case.scene, without(case.scene, ["Box"])
    entry = ObjectEntry("Ghost", "MESH", False, "hidden in renders", hidden=True)
    case = replace(
        case,
        scene=lacking,
        settings=Settings("textbook_literal"),
        picture=replace(case.picture, owners=case.picture.owners.in_scene(lacking, whole)),
        manifest=replace(case.manifest, objects=(entry,)),
        alternatives=(Alternative("Box", "hidden in the viewport", whole),),
        curves=(),
    )
    asked = []

    def find(case, frame, at_most=None):
        asked.append((case, frame.statistics.method))
        return Causes.none(frame.t.shape)
        yield

    monkeypatch.setattr(causes, "find_causes", find)
    checked(case, ("half_pixel", "moved_object", "channels"))
    assert len(asked) == 3
    for wrong, method in asked:
        assert method == "textbook_literal" and wrong.settings is case.settings
        assert wrong.curves == () and wrong.manifest is case.manifest
        [other] = wrong.alternatives
        assert other.object == "Box" and len(other.scene.instances) == 3
    window, moved, same = (wrong.alternatives[0].scene for wrong, _ in asked)
    assert window.camera is asked[0][0].scene.camera is not case.scene.camera
    differ = [a is not b for a, b in zip(moved.instances, whole.instances, strict=True)]
    assert sum(differ) == 1 and same is whole


def test_an_alternative_excuses_no_fault_of_the_camera(case):
    """It would have the same camera: else the right picture of it would explain any wrong one."""
    lacking = without(case.scene, ["Box"])
    shown = replace(case, picture=Picture(render(lacking).color), curves=())
    shown = replace(shown, alternatives=(Alternative("Box", "hidden", lacking),))
    found = result_of(trace_and_compare(shown))
    assert found.causes.hidden == [Hidden("Box", "hidden")] and found.counts.unexplained == 0
    rows = checked(shown, ("half_pixel", "one_pixel", "mirrored_x", "sensor_fit"))
    assert {row.result for row in rows.values()} == {"caught"}


def test_a_fault_of_the_colours_that_is_named_is_caught(case):
    foreign = replace(case, picture=Picture(case.picture.color), curves=())
    rows = checked(foreign, ("channels", "gamma"))
    assert [row.note for row in rows.values()] == [
        "named: red and blue swapped",
        "named: a power of 1/2.2",
    ]
    assert {row.result for row in rows.values()} == {"caught"}
    assert "named: red and blue swapped" in "\n".join(table(list(rows.values())))
