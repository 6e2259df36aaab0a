"""Rays that are not a camera's see what a camera's do, where they are the same."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.rendering import trace
from reference_tracer.scene import SceneError
from reference_tracer.tracer import nearest
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.hits import Statistics
from reference_tracer.tracer.settings import Settings

from ..tracer.pictures import mess

CHOICES = [Settings(m) for m in Method] + [Settings("moller_trumbore", "float32")]


def each_for_itself(camera) -> Rays:
    """Return the camera's rays, in another order, as rays that share nothing."""
    px, py = film_positions(camera.region, 0.0, 0.0)
    rays = camera_rays(camera, px, py)
    o, d = (np.broadcast_to(v, (3, len(px))) for v in (rays.origins, rays.directions))
    return Rays(o[:, ::-1].copy(), d[:, ::-1].copy())


@pytest.mark.slow
@pytest.mark.parametrize("settings", CHOICES, ids=lambda s: f"{s.method.value} {s.precision.value}")
@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("pairs", [1 << 15, 7])
def test_as_the_camera_has_it(make, rng, settings, orthographic, pairs, monkeypatch):
    monkeypatch.setattr(nearest, "PAIRS", pairs)
    scene = mess(make, rng, orthographic, True)
    statistics = Statistics()
    given = trace(scene, settings, statistics, each_for_itself(scene.camera))
    wanted = trace(scene, settings)
    assert np.array_equal(given.instance[::-1], wanted.instance)
    assert np.array_equal(given.triangle[::-1], wanted.triangle)
    assert statistics.pairs_tested >= scene.triangle_count * len(wanted.t)
    if settings.precision == "float64":
        assert np.array_equal(given.t[::-1], wanted.t)
    assert {len(wanted.t) - 1 - ray: names for ray, names in given.ties.items()} == wanted.ties


def test_none_of_nothing(make):
    rays = Rays(np.zeros((3, 5)), np.ones((3, 5)))
    assert (trace(make.scene(make.camera()), Settings(), rays=rays).instance == -1).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("which", [0, 1])
def test_rays_that_are_not_finite_are_refused(make, which, value):
    """Else they would be certified to see nothing."""
    both = np.ones((2, 3, 4))
    both[which, 1, 2] = value
    with pytest.raises(SceneError, match="finite numbers"):
        trace(make.room(), Settings(), rays=Rays(*both))
