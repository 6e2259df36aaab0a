"""VK-GL-CTS: ray tracing watertightness, a square split at random, and closed fans.

The Vulkan specification says that implementations *should* neither miss nor double-hit on the
shared edges and the vertices of closed fans, within one instance. The suite only warns of misses
in a fan. Here both are failures; and as the meshes keep their winding, a ray has to cross each
exactly once more to the front than to the back, folded by rounding or not.
"""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.any_rays import decide
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh, ViewWindow
from reference_tracer.tracer.camera import Rays, camera_rays
from reference_tracer.tracer.settings import Settings

from ..rays import nearest_hits
from .meshes import closed_fan, corners_of, split_square
from .shooting import crossings

torture = pytest.mark.torture
SIZES = (4, 16, 64, 256, 1024, 4096, 16384, 65536)
CASES = [(size, (5 * k + 11 * size)) for size in SIZES for k in range(10)]  # the original's seeds
QUICK = CASES[:-10:11]  # of 16,384 triangles at the most
ALL = [pytest.param(*case, marks=() if case in QUICK else torture) for case in CASES]


def looking_down(make, side=256):
    """A camera whose rays go along -Z through the middles of side x side pixels of [0, 1]^2."""
    return make.camera(side, side, orthographic=True, clip_start=0.0, window=ViewWindow(0, 1, 0, 1))


@pytest.mark.parametrize("size, seed", ALL)
def test_split_square(make, size, seed):
    """256 x 256 rays, no miss. All 80 cases are run by `make torture`, seven of them always."""
    vertices, triangles = split_square(seed, size)
    assert len(triangles) >= size
    scene = make.scene(looking_down(make), Mesh(vertices, triangles))
    frame = render(scene, Settings("certified"))
    assert (frame.triangle_index >= 0).all()
    assert (frame.t > 0).all() and (frame.t <= 1).all()
    plain = render(scene, Settings("watertight"))
    assert (plain.triangle_index >= 0).all()


@pytest.mark.parametrize("size, seed", [(64, 704), (1024, 11269)])
def test_split_square_is_crossed_once(make, size, seed):
    """Rays through pixels, and at the vertices themselves: one crossing, counted with its sign."""
    vertices, triangles = split_square(seed, size)
    corners = corners_of(vertices, triangles)
    rays = camera_rays(looking_down(make, 24), *middles())
    inner = vertices[4:].astype(np.float64).T[:, :400]
    at_vertices = np.stack((inner[0], inner[1], np.zeros(inner.shape[1])))
    for o in (np.broadcast_to(rays.origins, (3, rays.origins.shape[1])), at_vertices):
        found = crossings(o, np.broadcast_to(rays.directions, o.shape), corners)
        assert (found.winding() == -1).all()  # a surface that faces the rays
        assert (found.counts % 2 == 1).all()
    # True ties, but where storing the vertices in float32 has folded the surface beside them.
    assert (np.bincount(found.ray, found.edge) >= 1).mean() > 0.98


def middles(side=24):
    x, y = np.meshgrid(np.arange(side) + 0.5, np.arange(side) + 0.5)
    return x.ravel(), y.ravel()


def fan_rays(vertices, how, rng):
    """Rays at the centre, and at the middles of the edges around it, and where they come from."""
    targets = np.concatenate((vertices[:1], (vertices[:1] + vertices[1:]) / 2)).T
    d = np.tile([[0.0], [0], [-1]], targets.shape[1])
    if how == "slanted":
        d[:2] = rng.integers(-64, 65, (2, 1)) / 128
    elif how == "any":
        d[:2] = rng.uniform(-1, 1, d[:2].shape)
    return targets - d, d


@pytest.mark.parametrize(
    "count", [4, 8, 16, 32, 64, 128, *(pytest.param(n, marks=torture) for n in (256, 512, 1024))]
)
@pytest.mark.parametrize("how", ["straight", "slanted", "any"])
@pytest.mark.parametrize("snap", [None, 24], ids=["rounded", "true ties"])
def test_closed_fan(rng, count, how, snap):
    """Each ray at the centre and at the middle of a shared edge meets one triangle, not two."""
    vertices, triangles = closed_fan(count, snap)
    corners = corners_of(vertices, triangles)
    o, d = fan_rays(vertices, how, rng)
    found = crossings(o, d, corners)
    assert (found.counts == 1).all()
    seen = nearest_hits(Rays(o, d), corners)
    assert np.array_equal(seen.triangle[found.ray], found.triangle)
    if snap is not None and how != "any":
        decision = decide(
            Rays(o[:, :1].repeat(count, axis=1), d[:, :1].repeat(count, axis=1)), corners
        )
        assert decision.edge.all() and decision.exact.all()  # the centre is a corner of them all
        assert seen.t[0] == 1
    watertight = crossings(o, d, corners, Method.WATERTIGHT).counts
    assert (watertight >= 1).all()
    if how == "straight":
        assert (watertight >= 2).mean() > 0.9


FANS = pytest.mark.parametrize("count", [256, pytest.param(1024, marks=torture)])


@FANS
def test_who_may_be_seen_through_the_centre_of_a_fan(make, count):
    """All of the fan: every one of its triangles has a side from which it alone is met."""
    vertices, triangles = closed_fan(count, 24)
    camera = make.camera(1, 1, orthographic=True)
    scene = make.scene(camera, Mesh(vertices, triangles), make.quad(-9, 9, -9, 9, -2))
    frame = render(scene, Settings("certified"))
    assert frame.ties == {0: frozenset((0, k) for k in range(count))}
    assert frame.triangle_index.item() in range(count)


@FANS
def test_who_may_be_seen_through_a_gap_of_a_fan(make, count):
    """Without one of the triangles, what lies behind it may be seen too, though only just."""
    vertices, triangles = closed_fan(count, 24)
    camera = make.camera(1, 1, orthographic=True)
    for gap in (count // 10, 2 * count // 3):
        mesh = Mesh(vertices, np.delete(triangles, gap, axis=0))
        frame = render(make.scene(camera, mesh), Settings("certified"))
        assert (-1, -1) in frame.ties[0]
        assert len(frame.ties[0]) == count
