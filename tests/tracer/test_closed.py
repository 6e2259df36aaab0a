"""Closed surfaces: no ray gets out unseen, not through their corners and edges either."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.certified.any_rays import decide
from reference_tracer.tracer.camera import Rays

from ..rays import nearest_hits

pytestmark = pytest.mark.filterwarnings("error")


def cube(half):
    """Return a closed cube of 12 triangles with whole corners, (3, 3, 12)."""
    axes = np.eye(3)
    out = []
    for k in range(3):
        u, v, w = axes[k], axes[(k + 1) % 3], axes[(k + 2) % 3]
        for sign in (1, -1):
            a, b, c, d = (u * sign + x * v + y * w for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
            out += [(a, b, c), (a, c, d)][::sign]
    return half * np.array(out).transpose(1, 2, 0)


@pytest.mark.slow
def test_a_closed_mesh_has_no_holes():
    """From each whole point inside, through all corners, edges and diagonals: one hit, always."""
    inside = np.stack(np.meshgrid(*[np.arange(-3, 4)] * 3), axis=-1).reshape(-1, 3).T * 1.0
    targets = np.stack(np.meshgrid(*[np.arange(-4, 5, 2)] * 3), axis=-1).reshape(-1, 3)
    targets = targets[np.abs(targets).max(axis=1) == 4].T * 1.0
    corners = cube(4)
    ambiguous = 0
    for o in inside.T[::5]:
        rays = Rays(o[:, None], targets - o[:, None])
        hits = nearest_hits(rays, corners)
        assert (hits.t == 1).all()
        ray, row = np.divmod(np.arange(targets.shape[1] * 12), 12)
        crossed = decide(rays.take(ray), corners[..., row]).crossed
        assert (np.bincount(ray, crossed) == 1).all()
        ambiguous += (hits.certainty == Certainty.AMBIGUOUS).sum()
        assert all((-1, -1) not in names for names in hits.ties.values())
    assert ambiguous > 1000


def test_from_outside_a_closed_mesh_is_entered_as_often_as_left():
    grid = np.stack(np.meshgrid(np.arange(-6, 7), np.arange(-6, 7)), axis=-1).reshape(-1, 2).T
    origins = np.stack((*grid, np.full(grid.shape[1], 9)))
    corners = cube(4)
    for direction in ((0, 0, -1), (1, 0, -2), (1, 1, -1), (-1, 2, -3)):
        ray, row = np.divmod(np.arange(origins.shape[1] * 12), 12)
        rays = Rays(origins[:, ray] * 1.0, np.array(direction, float)[:, None])
        crossed = np.bincount(ray, decide(rays, corners[..., row]).crossed)
        assert set(crossed.tolist()) == {0, 2}
