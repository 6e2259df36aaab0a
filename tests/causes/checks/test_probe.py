"""Rays beside the centres, and what lies behind: as the tracer itself would see it."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.causes.checks import probe as probing
from reference_tracer.causes.checks.probe import SOUND, Probe
from reference_tracer.scene import Instance, Mesh, Plane, Region, Scene
from reference_tracer.tracer import candidates
from reference_tracer.tracer.nearest import plan
from reference_tracer.tracer.progress import result_of

TILE = Region(2, 3, 18, 13)


@pytest.fixture
def scene(make, rng):
    """Return layers of random triangles, some twice over, and a plane among them."""
    corners = rng.uniform(-2, 2, (60, 3)) * (1, 1, 0) - (0, 0, 1) * rng.uniform(2, 6, (60, 1))
    faces = np.arange(60).reshape(20, 3)
    mesh = Mesh(corners, np.concatenate((faces, faces[:5])))
    instances = [Instance(0, 0, np.eye(4)), Instance(0, 1, np.eye(4))]
    plane = Plane(2, (0, 0, -4), (0.1, 0.1, 1))
    return Scene(make.camera(20, 16), (mesh,), instances, (plane,), objects=("A", "B", "P"))


@pytest.fixture
def wanted(rng):
    return rng.random(TILE.width * TILE.height) < 0.4


def test_steps_are_small(scene, wanted, monkeypatch):
    for module in (candidates, probing):
        monkeypatch.setattr(module, "PAIRS", 100)
    made = result_of(plan(scene, SOUND, 0.5))
    probe = result_of(Probe.of(made, TILE, wanted))
    assert len(probe.chunks) > 5
    assert max(len(some.pixel) for some in probe.chunks) <= 100
