"""Ray and triangle: four ways, against points that were chosen by their barycentrics."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.methods import UNPROVEN
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.triangle import (
    SUM_TOLERANCE,
    TESTS,
    moller_trumbore,
    textbook,
    textbook_literal,
    watertight,
)

SOUND = pytest.mark.parametrize("test", [textbook, moller_trumbore, watertight])
TYPES = pytest.mark.parametrize("dtype, near", [(np.float64, 1e-9), (np.float32, 2e-3)])


@pytest.fixture
def chosen(rng):
    """Return rays, corners (3 corners, 3, n), barycentrics (3, n) and t: inside or out."""
    count = 6000
    corners = rng.normal(size=(3, 3, count))
    n = np.cross(corners[1] - corners[0], corners[2] - corners[0], axis=0)
    directions = rng.normal(size=(3, count))
    facing = np.abs((n * directions).sum(axis=0))
    longest = np.max(
        [np.linalg.norm(corners[i] - corners[i - 1], axis=0) for i in range(3)], axis=0
    )
    good = (facing > 0.3) & (np.linalg.norm(n, axis=0) > 0.2 * longest**2)
    s = np.stack((rng.uniform(-0.5, 1.5, count), rng.uniform(-0.5, 1.5, count)))
    s = np.stack((1 - s.sum(axis=0), *s))
    t = rng.uniform(0.5, 4, count)
    origins = (s[:, None] * corners).sum(axis=0) - t * directions
    return Rays(origins[:, good], directions[:, good]), corners[:, :, good], s[:, good], t[good]


def cast(rays, corners, dtype):
    return Rays(rays.origins.astype(dtype), rays.directions.astype(dtype)), corners.astype(dtype)


@SOUND
@TYPES
def test_closed_form(chosen, test, dtype, near):
    rays, corners, s, t = chosen
    near_rays, near_corners = cast(rays, corners, dtype)
    hit, found_t, found_s = test(near_rays, *near_corners)
    assert found_t.dtype == found_s.dtype == dtype
    clear = np.abs(s).min(axis=0) > near  # away from edges
    inside = (s > 0).all(axis=0)
    assert (hit == inside)[clear].all()
    assert 500 < (inside & clear).sum() < clear.sum() - 500
    assert np.allclose(found_t[hit], t[hit], rtol=0, atol=near)
    assert np.allclose(found_s[:, hit], s[:, hit], rtol=0, atol=near)


@TYPES
def test_literal_is_the_textbook_where_the_sum_is_1(chosen, dtype, near):
    rays, corners = cast(*chosen[:2], dtype=dtype)
    hit, t, s = textbook(rays, *corners)
    literal, literal_t, literal_s = textbook_literal(rays, *corners)
    assert np.array_equal(literal, hit & (s[0] + s[1] + s[2] == 1))
    assert np.array_equal(t, literal_t) and np.array_equal(s, literal_s)
    sums = np.abs(s.sum(axis=0) - 1)
    assert (sums[hit] <= 1.01 * SUM_TOLERANCE[np.dtype(dtype)]).all()


def closed(dtype, rng, count=1500):
    """Return hits (rays, triangles) of rays from inside a sphere, for a method."""
    shape = trimesh.creation.icosphere(2)
    turn = trimesh.transformations.random_rotation_matrix(rng.random(3))[:3, :3]
    corners = (shape.triangles @ turn.T).transpose(1, 2, 0).astype(dtype)[:, :, None, :]
    origins = rng.uniform(-0.4, 0.4, (3, count)).astype(dtype)[:, :, None]
    directions = rng.normal(size=(3, count)).astype(dtype)[:, :, None]

    def found(test):
        hit, t, _ = test(Rays(origins, directions), *corners)
        return hit & (t > 0)

    return found


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_literal_loses_about_half_of_a_closed_mesh(dtype, rng):
    found = closed(dtype, rng)
    assert found(textbook).any(axis=1).mean() > 0.999
    lost = 1 - found(textbook_literal).any(axis=1).mean()
    assert 0.35 < lost < 0.65


@pytest.mark.parametrize("method", UNPROVEN)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_parallel_rays_miss(method, dtype):
    p1, p2, p3 = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], dtype)[:, :, None]
    directions = np.array([[1, 0, 0], [0, -3, 0], [1, 2, 0]], dtype).T
    for height in (0, 1):  # in the triangle's plane, and beside it
        origins = np.array([[-1], [1], [height]], dtype)
        assert not TESTS[method](Rays(origins, directions), p1, p2, p3)[0].any()
