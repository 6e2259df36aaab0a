"""Rows that are turned over, and a camera that is mirrored: each is told where it alone can be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.diagnosis.faults import FAULTS
from reference_tracer.rendering import render
from reference_tracer_data.faults import faults_of_data

from .conftest import BESIDE

LOOKED_FOR = [f for f in faults_of_data(FAULTS) if f.name in (*BESIDE, "mirrored_x", "mirrored_y")]
IN_CAMERA_SPACE = {"positions": {"space": "camera"}}


def _shown(kind, scene):
    """What the camera sees; where a kind has a space, it is that of the camera's own axes."""
    frame = render(scene)
    away = frame.position - scene.camera.origin
    hit = (frame.object_index >= 0)[..., None]
    positions = np.where(hit, away @ scene.camera.world_from_camera[:3, :3], 0)
    return {"depth": frame.t, "positions": positions, "ids": frame.object_index}[kind]


@pytest.mark.parametrize(
    ("kind", "shift", "rows", "mirrored"),
    [
        # Without a shift both are the same file: arrays are turned over the more often.
        ("depth", 0.0, ["rows", "mirrored_y"], ["rows", "mirrored_y"]),
        ("depth", 0.1, ["rows"], ["mirrored_y"]),
        ("positions", 0.0, ["rows"], ["mirrored_y"]),
        # Which id is whose is told of the rows as they are or turned over, and of no other camera.
        ("ids", 0.1, ["rows"], []),
    ],
)
def test_what_only_rows_explain_is_rows_and_what_only_a_mirrored_camera_does_is_not(
    kind, shift, rows, mirrored, told, solids
):
    own = solids.camera
    scene = solids.seen_by(replace(own, window=own.window.moved(0, shift)))
    matrix = own.world_from_camera @ np.diag((1, -1, 1, 1))
    other = scene.seen_by(replace(scene.camera, world_from_camera=matrix))
    known = IN_CAMERA_SPACE.get(kind, {})
    assert told(kind, _shown(kind, scene)[::-1], scene, faults=LOOKED_FOR, **known) == rows
    assert told(kind, _shown(kind, other), scene, faults=LOOKED_FOR, **known) == mirrored
