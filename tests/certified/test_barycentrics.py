"""The barycentrics of certified pixels are within a stated error of the exact ones.

The exact judge is fractions. The cameras' axes lie nearly in a plane, so that all rays do, and meet
triangles nearly edge-on: there the edge functions lose most of their digits.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified import measures
from reference_tracer.rendering import render, trace
from reference_tracer.scene import Mesh, SceneError
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.world import world_corners

from ..oracle import barycentrics, rational

FLATNESS = (1e-3, 1e-6, 1e-8, 1e-9, 1e-10, 1e-12, 1.0)


def flat_scene(make, rng, flatness: float, orthographic: bool):
    """Return a camera whose third axis leaves the plane of the others by so much, and triangles."""
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    axes[:, 2] = axes[:, :2] @ rng.normal(size=2) + flatness * axes[:, 2]
    eye = rng.normal(size=3) * rng.choice((0, 1, 100))
    camera = make.camera(8, 6, half=1.0, eye=eye, axes=axes, orthographic=orthographic)
    depth = rng.uniform(1, 5, (3, 5))
    x, y = rng.normal(size=(2, 3, 5)) * (1 if orthographic else depth)
    away = (camera.right, camera.up, camera.forward)
    points = (
        sum(v[:, None, None] * w for v, w in zip(away, (x, y, depth), strict=True))
        + eye[:, None, None]
    )
    mesh = Mesh(points.transpose(2, 1, 0).reshape(-1, 3), np.arange(15).reshape(5, 3))
    return make.scene(camera, mesh)


def errors(scene, found, rays: Rays, names) -> list[Fraction]:
    """Return how far the barycentrics (3, n) of n rays on their triangles are off."""
    corners = world_corners(scene, *np.array(names).T)
    shape = 3, len(names)
    o, d = (np.broadcast_to(v, shape) for v in (rays.origins, rays.directions))
    return list(np.abs(rational(found) - barycentrics(o, d, corners)[0]).ravel())


def worst(make, seeds, by_rays: bool = False) -> tuple[Fraction, int]:
    """Return the largest error of pictures of flat scenes, and of how many pixels."""
    most, count = Fraction(0), 0
    for seed in seeds:
        rng = np.random.default_rng(seed)
        try:
            scene = flat_scene(make, rng, FLATNESS[seed % len(FLATNESS)], bool(rng.integers(2)))
        except SceneError:  # its axes have no inverse
            continue
        rays = camera_rays(scene.camera, *film_positions(scene.camera.region))
        if by_rays:
            both = rays.origins, rays.directions
            rays = Rays(*(np.broadcast_to(v, (3, 48)).copy() for v in both))
            hits = trace(scene, Settings("certified"), rays=rays)
            instance, triangle, s = hits.instance, hits.triangle, hits.s
        else:
            frame = render(scene, Settings("certified"))
            instance, triangle = frame.instance_index.ravel(), frame.triangle_index.ravel()
            s = frame.barycentrics.reshape(-1, 3).T
        seen = np.flatnonzero(instance >= 0)
        if len(seen):
            names = list(zip(instance[seen].tolist(), triangle[seen].tolist(), strict=True))
            most = max(most, *errors(scene, s[:, seen], rays.take(seen), names))
            count += len(seen)
    return most, count


@pytest.mark.parametrize("by_rays", [False, True])
def test_they_are_as_near_as_is_said(make, by_rays):
    most, count = worst(make, range(49), by_rays)
    assert count > 150
    assert most < measures.WITHIN == 2.0**-24


def test_without_a_bound_on_the_sum_they_would_not_be(make, monkeypatch):
    """The counter-example: the scenes above are hard enough."""
    monkeypatch.setattr(measures, "_SHARE", 0.0)
    assert worst(make, range(49))[0] > 8 * measures.WITHIN


@pytest.mark.torture
def test_they_are_in_many_scenes(make):
    most, count = worst(make, range(100, 8000))
    assert count > 30_000 and most < measures.WITHIN


def test_where_digits_are_lost_each_is_rounded_once(make):
    """Then the error is half of the last place, not 2^-24."""
    scene = flat_scene(make, np.random.default_rng(3), 1e-12, False)
    frame = render(scene, Settings("certified"))
    seen = np.flatnonzero(frame.instance_index.ravel() >= 0)
    assert len(seen) > 5
    rays = camera_rays(scene.camera, *film_positions(scene.camera.region)).take(seen)
    names = [(0, int(k)) for k in frame.triangle_index.ravel()[seen]]
    found = frame.barycentrics.reshape(-1, 3)[seen].T
    assert max(errors(scene, found, rays, names)) <= Fraction(1, 2**54)


@pytest.mark.parametrize("first", [0, 1])
def test_of_one_ray_among_those_that_share_nothing(make, first):
    """It alone meets something."""
    scene = make.scene(make.camera(), Mesh([(0, 0, -2), (4, 0, -2), (0, 4, -2)], [[0, 1, 2]]))
    origins, directions = np.array([[(1, 0, 0), (5, 5, 0)], [(0, 0.5, -1), (0, 0, -1)]])
    rays = Rays(np.roll(origins, first, axis=0).T, np.roll(directions, first, axis=0).T)
    hits = trace(scene, Settings("certified"), rays=rays)
    assert hits.triangle[first] == 0 and hits.s[:, first].tolist() == [0.5, 0.25, 0.25]
