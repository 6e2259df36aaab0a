"""Closed meshes are closed for every ray: parity and winding, at vertices, edges, along edges.

Inside, a ray leaves once more than it enters; outside, as often. Closed means by bit-identical
positions. Where the rays' origins and the vertices have few digits, a ray at a vertex passes it
exactly, and goes on to meet what is behind it.
"""

from __future__ import annotations

import numpy as np
import pytest

from .meshes import box, bumpy_sphere, corners_of, snapped
from .shooting import crossings

torture = pytest.mark.torture


def rays_at_all_of(rng, corners, count):
    """From origins off the surface, at vertices, at points of edges, along edges, and anywhere."""
    m = corners.shape[2]
    some = corners[:, :, rng.integers(m, size=count)]
    a, b, c = some
    along = rng.integers(0, 5, count) / 4
    target = np.where(rng.random(count) < 0.5, a, a + along * (b - a))
    target = np.where(rng.random(count) < 0.2, (a + b + 2 * c) / 4, target)
    beside = np.where(rng.random(count) < 0.5, b - a, target)  # parallel to an edge
    return target, beside


@pytest.mark.parametrize("count", [1200, pytest.param(300_000, marks=torture)])
def test_parity_and_winding_of_whole_numbers(rng, count):
    """A cube [0, 4]^3 with split sides, its vertices, edges and planes met exactly: true ties."""
    corners = corners_of(*box(0, 4))
    o = rng.integers(-3, 8, (3, count)).astype(float)
    inside = ((o > 0) & (o < 4)).all(axis=0)
    on_surface = ((o >= 0) & (o <= 4)).all(axis=0) & ~inside
    o[0, on_surface] = 9
    target, beside = rays_at_all_of(rng, corners, count)
    for d in (target - o, beside):
        d[0, ~d.any(axis=0)] = 1
        found = crossings(o, d, corners)
        assert np.array_equal(found.winding(), inside.astype(int))
        assert np.array_equal(found.counts % 2 == 1, inside)
        assert found.edge.mean() > 0.2


@pytest.mark.parametrize("snap", [False, True], ids=["rounded", "true ties"])
@pytest.mark.parametrize("count", [1200, pytest.param(300_000, marks=torture)])
def test_parity_and_winding_of_a_bumpy_sphere(rng, snap, count):
    """From inside and from far outside, at vertices and edges, and along edges."""
    corners = corners_of(*bumpy_sphere(rng, snap))
    o = rng.uniform(-0.4, 0.4, (3, count))
    inside = rng.random(count) < 0.5
    o = snapped(np.where(inside, o, o + 16 * np.sign(o)))
    target, beside = rays_at_all_of(rng, corners, count)
    for d in (target - o, beside):
        found = crossings(o, d, corners)
        assert np.array_equal(found.winding(), inside.astype(int))
        assert np.array_equal(found.counts % 2 == 1, inside)
