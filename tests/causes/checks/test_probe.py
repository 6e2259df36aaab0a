"""Rays beside the centres, and what lies behind: as the tracer itself would see it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.checks import probe as probing
from reference_tracer.causes.checks.probe import Probe
from reference_tracer.scene import Instance, Mesh, Plane, Region, Scene
from reference_tracer.tracer import candidates
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.nearest import plan, trace_tile
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.triangle import TESTS

TILE = Region(2, 3, 18, 13)
PLAIN = Settings("watertight")  # a probe has no certified ray
SETTINGS = [
    Settings(m, p)
    for m in ("textbook", "moller_trumbore", "watertight")
    for p in ("float64", "float32")
]
EVERY_SETTING = pytest.mark.parametrize("settings", SETTINGS, ids=str)


@pytest.fixture
def scene(make, rng):
    """Return layers of random triangles, some twice over, and a plane among them."""
    corners = rng.uniform(-2, 2, (60, 3)) * (1, 1, 0) - (0, 0, 1) * rng.uniform(2, 6, (60, 1))
    faces = np.arange(60).reshape(20, 3)
    mesh = Mesh(corners, np.concatenate((faces, faces[:5])))
    instances = [Instance(0, 0, np.eye(4)), Instance(0, 1, np.eye(4))]
    plane = Plane(2, (0, 0, -4), (0.1, 0.1, 1))
    return Scene(make.camera(20, 16), (mesh,), instances, (plane,), objects=("A", "B", "P"))


def probe_of(scene, settings, wanted, reach=0.5):
    return result_of(Probe.of(result_of(plan(scene, settings, reach)), TILE, wanted, settings))


@pytest.fixture
def wanted(rng):
    return rng.random(TILE.width * TILE.height) < 0.4


@EVERY_SETTING
@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.5, -0.5), (-0.3, 0.004)])
def test_a_probe_sees_what_a_picture_shifted_as_much_does(scene, settings, wanted, offset):
    expected = result_of(trace_tile(result_of(plan(scene, settings, 0.5)), TILE, *offset))
    found = result_of(probe_of(scene, settings, wanted).trace(*offset))
    for name in ("t", "instance", "triangle", "s"):
        assert np.array_equal(getattr(found, name), getattr(expected, name)[..., wanted]), name
    assert len(np.unique(found.triangle)) > 10


def test_an_offset_for_each_pixel(scene, wanted, rng):
    probe = probe_of(scene, PLAIN, wanted)
    dx, dy = rng.choice([-0.5, 0.0, 0.25], (2, int(wanted.sum())))
    found = result_of(probe.trace(dx, dy))
    for x in np.unique(dx):
        for y in np.unique(dy):
            same = (dx == x) & (dy == y)
            expected = result_of(probe.trace(x, y))
            assert same.any() and np.array_equal(found.t[same], expected.t[same])


@EVERY_SETTING
def test_layers_come_in_order_each_once(scene, settings, wanted):
    """Asked again and again for what is behind, the probe names every hit of a ray, in order."""
    probe = probe_of(scene, settings, wanted)
    count, dtype = int(wanted.sum()), settings.precision.dtype
    rays = camera_rays(
        scene.camera, *(v[wanted] for v in film_positions(TILE, 0.0, 0.0)), dtype=dtype
    )
    mesh = scene.meshes[0]
    expected = [[] for _ in range(count)]
    for k, triangle in enumerate(mesh.triangles):
        corners = (mesh.vertices[c].astype(dtype)[:, None] for c in triangle)
        hit, t, _ = TESTS[settings.method](rays, *corners)
        for pixel in np.flatnonzero(hit):
            expected[pixel] += [(float(t[pixel]), i, k) for i in (0, 1)]
    hits, found = None, [[] for _ in range(count)]
    for _ in range(60):
        hits = result_of(probe.trace(after=hits))
        if not (hits.instance != NOTHING).any():
            break
        for pixel in np.flatnonzero(hits.instance != NOTHING):
            name = (hits.t[pixel], int(hits.instance[pixel]), int(hits.triangle[pixel]))
            found[pixel].append(name)
    else:
        pytest.fail("the layers never end")
    planes = [[h for h in some if h[1] == 2] for some in found]
    assert all(len(some) == 1 for some in planes)  # every ray meets the plane once
    assert all(some == sorted(some) for some in found)
    assert [[h for h in some if h[1] != 2] for some in found] == [sorted(s) for s in expected]
    assert max(map(len, expected)) > 6


def test_nothing_wanted_and_nothing_there(scene, make, wanted):
    none = result_of(probe_of(scene, PLAIN, np.zeros_like(wanted)).trace())
    assert len(none.t) == 0
    empty = replace(scene, meshes=(), instances=(), planes=())
    assert np.isinf(result_of(probe_of(empty, PLAIN, wanted).trace(0.1, 0.1)).t).all()


def test_steps_are_small(scene, wanted, monkeypatch):
    for module in (candidates, probing):
        monkeypatch.setattr(module, "PAIRS", 100)
    shares = []
    made = result_of(plan(scene, PLAIN, 0.5))
    probe = result_of(Probe.of(made, TILE, wanted, PLAIN), shares.append)
    assert len(probe.chunks) > 5
    assert max(len(some.pixel) for some in probe.chunks) <= 100
    assert (np.diff(shares) >= 0).all() and 0 <= shares[0] and shares[-1] <= 1
