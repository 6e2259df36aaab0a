"""A file of data that is the same in every pixel: it says nothing, and no fault is named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.rendering import render
from reference_tracer.report.lines import describe
from reference_tracer.tracer.progress import result_of

from .conftest import SOME

SAYS_NOTHING = "are the same in every pixel: a constant says nothing of what is wrong"
CONSTANTS = [
    ("ids", 3),
    ("depth", 0.0),
    ("depth", 5.0),
    ("distance", 1.0),  # a depth buffer has 1 where nothing is
    ("normals", (0.0, 0.0, 1.0)),
    ("positions", (1.0, 2.0, 3.0)),
]


@pytest.mark.parametrize("kind, value", CONSTANTS)
def test_a_constant_gets_no_name(judged, traced, kind, value):
    """Neither that nothing is rendered, nor that the camera looks away, as all would agree."""
    found = judged(kind, np.broadcast_to(value, (*traced.shape, *np.shape(value))))
    said = result_of(diagnose(found.case, found.frame, found.causes))
    assert not said.told and said.left == found.counts.unexplained > 10
    assert said.lines()[0] == f"diagnosis: {found.case.picture.data.kind.words} {SAYS_NOTHING}"
    found = replace(found, diagnosis=said)
    assert found.verdict is Verdict.DIFFERENCES
    assert not any("colours" in line for line in describe(found))


def test_what_is_nearly_constant_has_its_fault_named(told, solids, traced):
    camera = solids.camera
    near, far = 1e-4, camera.clip_end
    scene = replace(solids, camera=replace(camera, clip_start=near))
    level = far / (far - near) * (1 - near / traced.t)
    assert np.ptp(level[np.isfinite(traced.t)]) < 1e-4
    assert told("depth", np.where(np.isfinite(traced.t), level, 1), scene, faults=SOME) == [
        "depth_buffer"
    ]
    ids = np.where(traced.object_index >= 0, 3, 0)
    assert told("ids", ids, faults=SOME) == ["id_shared"]


def test_a_constant_is_judged_where_the_scene_is_constant(told, solids, make):
    """A wall before the camera has one depth."""
    camera = make.camera(16, 12, half=0.1, eye=(0, 0, 5), target=(0, 0, 0))
    wall = replace(solids, camera=camera, instances=solids.instances[2:], objects=("Floor",) * 3)
    depths = render(wall).t
    assert np.ptp(depths) < 1e-12
    assert told("depth", np.full(depths.shape, 1000 * 5.85), wall, faults=SOME) == ["data_unit"]
