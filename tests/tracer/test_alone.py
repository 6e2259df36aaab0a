"""One pixel, or one ray, sees alone what it sees among many, by every method, to the bit.

Arrays of one ray have the shape of what all rays share.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.projections import PROJECTIONS
from reference_tracer.rendering import render, trace
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.settings import UNPROVEN_SETTINGS, Settings

from ..alone import EACH, SIZES, by_pixel, is_same, rays_of, small

SETTINGS = (Settings("certified"), *UNPROVEN_SETTINGS)


@EACH
def test_a_pixel_and_a_ray(seed, projection, make):
    """Of rays that share something the bounds are for all together, and may decide another way."""
    scene = small(make, seed, projection, SIZES[0])
    seen = 0
    for settings in SETTINGS:
        many = trace(scene, settings)
        seen += int((many.instance >= 0).sum())
        for k, one in enumerate(by_pixel(scene)):
            assert is_same(trace(one, settings), many, k), (settings, k)
        for rays in rays_of(scene):
            exactly = settings.method != "certified" or not (rays.one_origin or rays.one_direction)
            many = trace(scene, settings, rays=rays)
            for k in range(rays.count):
                one = trace(scene, settings, rays=rays.take(np.array([k])))
                assert is_same(one, many, k, exactly), (settings, k)
    assert seen >= len(SETTINGS)


@EACH
@pytest.mark.parametrize(
    "settings",
    [
        Settings("certified", samples=2),
        pytest.param(Settings("certified", samples=3), marks=pytest.mark.torture),
        Settings("watertight", "float32", samples=3),
    ],
    ids=lambda s: f"{s.method.value} {s.samples}",
)
def test_samples_of_a_pixel(seed, settings, projection, make):
    scene = small(make, seed, projection, SIZES[0])
    settings = replace(settings, color=Color.FACING)
    many = render(scene, settings)
    for k, one in enumerate(by_pixel(scene)):
        found = render(one, settings)
        for name, values in many.passes().items():
            own = values if name == "rows_done" else values[:, k]
            assert found.passes()[name].tobytes() == own.tobytes(), (k, name)


def test_one_ray_is_as_many_as_it_is_asked_for():
    """Whether it shares nothing, or is one of a camera's."""
    origin, direction = np.zeros((3, 1)), np.ones((3, 1))
    three, none = np.zeros(3, int), np.zeros(0, int)
    for shared in ({}, {"one_origin": True}, {"one_direction": True}):
        ray = Rays(origin, direction, **shared)
        assert [r.count for r in (ray, ray.take(three), ray.take(none))] == [1, 3, 0]
        again = ray.take(three[:1])
        assert (again.one_origin, again.one_direction) == (ray.one_origin, ray.one_direction)


@pytest.mark.parametrize("projection", PROJECTIONS.values(), ids=PROJECTIONS)
def test_the_shape_says_what_is_shared_but_of_one_ray(projection, make):
    parallel = projection.shares_direction
    for size in SIZES:
        rays, apart = rays_of(small(make, 0, projection, size))
        assert (rays.one_origin, rays.one_direction) == (not parallel, parallel)
        assert not apart.one_origin and not apart.one_direction
        assert rays.count == apart.count == size[0] * size[1]
