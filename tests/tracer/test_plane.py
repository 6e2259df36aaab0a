"""Ray and plane against points that were chosen on the plane."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.plane import intersect

COUNT = 2000


@pytest.fixture
def case(rng):
    """Return rays that meet random planes at chosen t, and the planes, a column each."""
    normal, point = rng.normal(size=(3, COUNT)), rng.normal(size=(3, COUNT))
    within = np.cross(normal.T, rng.normal(size=(COUNT, 3))).T
    direction, t = rng.normal(size=(3, COUNT)), rng.uniform(-5, 5, COUNT)
    facing = np.abs((direction * normal).sum(axis=0)) > 0.05
    hit = point + within
    return (
        Rays((hit - t * direction)[:, facing], direction[:, facing]),
        point[:, facing],
        normal[:, facing],
        t[facing],
    )


@pytest.mark.parametrize("dtype, tolerance", [(np.float64, 1e-12), (np.float32, 1e-3)])
def test_t_is_the_one_chosen(case, dtype, tolerance):
    rays, point, normal, t = case
    found = intersect(
        Rays(rays.origins.astype(dtype), rays.directions.astype(dtype)),
        point.astype(dtype),
        normal.astype(dtype),
    )
    assert found.dtype == dtype and len(t) > 1000
    assert np.allclose(found, t, rtol=0, atol=tolerance)


def test_parallel_rays_do_not_hit():
    normal = np.array([[0.0], [0], [1]])
    point = np.array([[5.0], [6], [7]])
    directions = np.array([[1.0, 0, 0], [3, -4, 0], [1, 1, 1e-300]]).T
    above, within = np.array([[0.0], [0], [9]]), np.array([[0.0], [0], [7]])
    for origin, third in ((above, -np.inf), (within, 0)):
        t = intersect(Rays(origin, directions), point, normal)
        assert np.isnan(t[:2]).all()
        assert t[2] == third or t[2] < -1e299
