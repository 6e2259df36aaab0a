"""The self-check: every fault that can be seen is caught, and one that cannot is said to be so."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.compare.comparison import trace_and_compare
from reference_tracer.compare.faults import FAULTS, Case, Fault, Wrong
from reference_tracer.compare.known import Known
from reference_tracer.compare.self_check import FaultRow, self_check, table
from reference_tracer.compare.shown import Shown, numbered
from reference_tracer.manifest import Manifest, Unmodelled
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.render import render
from reference_tracer.tracer.settings import Settings

BLENDER = {"version": "5.2.3", "source": "workbench", "sample_radius": 0.0, "settings": {}}
PLAIN = Manifest("a.blend", "Scene", "ViewLayer", 1, "RENDER", "Camera")
# Constant shading has no normals; behind a solid's triangle is another of its colour; no frame.
INVISIBLE = {"flipped_winding", "dropped_triangle", "wrong_frame"}


@pytest.fixture
def case(room):
    room = replace(room, objects=("Ball", "Box", "Wall"))
    frame = render(room)
    owners = numbered(room.objects, room.objects)
    return Case(room, frame, Shown(frame.color, owners[frame.instance_index], owners))


@pytest.mark.parametrize("known", [True, False], ids=["identity", "colours alone"])
def test_every_fault_is_caught_but_those_that_change_nothing(case, known):
    if not known:
        case = replace(case, shown=Shown(case.shown.color))
    rows = {row.name: row for row in result_of(self_check(case))}
    assert set(rows) == {fault.name for fault in FAULTS}
    for name, row in rows.items():
        assert row.result == ("cannot be seen here" if name in INVISIBLE else "caught"), row
        assert row.unexplained <= row.looked_at <= row.differ
        assert (row.changed > 0) == (name not in INVISIBLE)
    assert rows["mirrored_x"].unexplained > 100


def test_a_mirrored_camera_cannot_be_seen_in_a_symmetric_scene(make):
    scene = make.scene(make.camera(40, 30), make.quad(-0.7, 0.7, -0.3, 0.5, -2))
    frame = render(scene)
    faults = [f for f in FAULTS if f.name in ("mirrored_x", "mirrored_y")]
    rows = result_of(self_check(Case(scene, frame, Shown(frame.color)), faults=faults))
    assert rows[0].result in ("cannot be seen here", "within rounding")
    assert rows[1].result == "caught" and not rows[0].missed
    assert "1 of 1 faults that can be seen here are caught" in table(rows)[0]


def test_a_fault_within_rounding_is_none(case):
    """A thousandth of a pixel: what float32 may do itself."""

    def nudge(case):
        right = 1e-3 * np.array((1.0, 0, 0)) * 0.02
        matrix = case.scene.camera.world_from_camera.copy()
        matrix[:3, 3] += right
        return Wrong(
            replace(case.scene, camera=replace(case.scene.camera, world_from_camera=matrix)),
            case.shown,
        )

    [row] = result_of(self_check(case, faults=[Fault("nudge", "hardly anything", nudge)]))
    assert row.result in ("cannot be seen here", "within rounding") and row.unexplained == 0
    assert FaultRow("a", "b", 5, 5, 5, 0).missed and not FaultRow("a", "b", 5, 5, 5, 1).missed


def test_an_open_sheet_shows_a_dropped_triangle(make):
    scene = make.scene(make.camera(40, 30), make.quad(-0.7, 0.6, -0.3, 0.5, -2))
    frame = render(scene)
    faults = [f for f in FAULTS if f.name == "dropped_triangle"]
    [row] = result_of(self_check(Case(scene, frame, Shown(frame.color)), faults=faults))
    assert row.result == "caught"


def test_what_hides_every_fault_is_missed(case):
    """A feature that may change anything, anywhere."""
    everywhere = (Unmodelled("scene 'Scene'", "x-ray", everywhere=True),)
    rows = result_of(self_check(replace(case, unmodelled=everywhere)))
    assert {row.result for row in rows} == {"missed", "cannot be seen here"}


def test_the_scene_a_frame_later(case):
    instances = list(case.scene.instances)
    matrix = instances[1].world_from_object.copy()
    matrix[:3, 3] += 0.2
    instances[1] = replace(instances[1], world_from_object=matrix)
    later = replace(case, next_frame=replace(case.scene, instances=tuple(instances)))
    [row] = result_of(self_check(later, faults=[f for f in FAULTS if f.name == "wrong_frame"]))
    assert row.result == "caught"


def test_nothing_is_changed_of_the_case(case):
    color, window = case.shown.color.copy(), case.scene.camera.window
    result_of(self_check(case))
    np.testing.assert_array_equal(case.shown.color, color)
    np.testing.assert_array_equal(render(case.scene).color, color)
    assert case.scene.camera.window == window


def test_in_a_comparison_on_request(case):
    def compared(known):
        return result_of(
            trace_and_compare(case.scene, PLAIN, Settings(), case.shown, BLENDER, known=known)
        )

    names = case.scene.objects
    with_check = compared(Known(names=names, self_check=True))
    assert len(with_check.self_check) == len(FAULTS) and with_check.verdict == "agree"
    held = json.loads(json.dumps(with_check.to_dict(), allow_nan=False))["self_check"]
    assert {row["result"] for row in held} == {"caught", "cannot be seen here"}
    assert any("self-check: 14 of 14" in line for line in with_check.lines())
    assert compared(Known(names=names)).self_check == ()
    missed = replace(with_check, self_check=(FaultRow("a", "b", 5, 5, 5, 0),))
    assert missed.verdict == "warnings"


def test_an_empty_scene_has_nothing_to_get_wrong(make):
    scene = make.scene(make.camera(8, 6))
    frame = render(scene)
    rows = result_of(self_check(Case(scene, frame, Shown(frame.color))))
    assert {row.result for row in rows} == {"cannot be seen here"}
