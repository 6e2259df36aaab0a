"""The watertight test: no ray slips between triangles, and in float32 no zero is a wrong one."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.triangle import watertight

from ..oracle import OUTSIDE, intersect_pairs

pytestmark = pytest.mark.filterwarnings("error")
TYPES = pytest.mark.parametrize("dtype", [np.float32, np.float64])


def shapes(rng):
    """Closed meshes: round, sharp with needles, and with whole corners."""
    turn = trimesh.transformations.random_rotation_matrix(rng.random(3))
    yield trimesh.creation.icosphere(2).apply_transform(turn)
    yield trimesh.creation.cylinder(1, 2, sections=40).apply_transform(turn)
    yield trimesh.creation.box((2, 2, 2))


def rays_within(mesh, rng, dtype):
    """Return rays from inside at every vertex, at points of every edge, and beside them."""
    vertices = np.asarray(mesh.vertices, dtype)
    edges = mesh.edges_unique
    share = rng.choice([0.5, rng.random(), rng.random()], (len(edges), 1)).astype(dtype)
    on_edges = vertices[edges[:, 0]] + share * (vertices[edges[:, 1]] - vertices[edges[:, 0]])
    targets = np.concatenate((vertices, on_edges))
    origins = rng.uniform(-0.3, 0.3, targets.shape).astype(dtype)
    origins[::4] = rng.integers(-1, 2, origins[::4].shape) * 0.25
    return origins, targets - origins, vertices[mesh.faces].transpose(1, 2, 0)


@pytest.mark.slow
@TYPES
@pytest.mark.parametrize("place", [0.0, 1e3, 1e5])
def test_no_ray_leaves_a_closed_mesh_unseen(rng, dtype, place):
    """Of rays at vertices and edges; some are met twice, which is allowed."""
    met_twice = rays = 0
    for mesh in shapes(rng):
        mesh = mesh.apply_translation((place, -place / 3, 0))
        for _ in range(4):
            origins, directions, corners = rays_within(mesh, rng, dtype)
            origins += np.array((place, -place / 3, 0), dtype)
            directions -= np.array((place, -place / 3, 0), dtype)
            some = Rays(origins.T[:, :, None], directions.T[:, :, None])
            hit, t, _ = watertight(some, *corners[:, :, None, :])
            seen = (hit & (t > 0)).sum(axis=1)
            assert (seen > 0).all()
            met_twice, rays = met_twice + (seen > 1).sum(), rays + len(seen)
    assert 0 < met_twice < rays


@pytest.mark.slow
@TYPES
@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("way", [1, -1])
def test_along_an_axis_it_is_exact(rng, dtype, axis, way):
    """No shear and no origin: nothing is rounded but products, and rounding keeps their order.

    What float32 finds to be zero is looked at in float64, where the products are exact. In float64
    itself a ray beside an edge by less than a rounding is taken for one on it.
    """
    count = 1200
    corners = rng.normal(size=(3, 3, count)).astype(dtype)
    share = rng.random(count).astype(dtype)
    part = np.arange(count) < 800
    corners[1][:, part] = -(share * corners[0])[:, part]  # an edge passes the ray within rounding
    corners[1][axis] = rng.normal(size=count)
    corners[:, :, 1000:] = rng.integers(-2, 3, (3, 3, 200))  # true edges, corners, no area
    direction = np.zeros((3, 1), dtype)
    direction[axis] = way
    hit, _, s = watertight(Rays(np.zeros((3, 1), dtype), direction), *corners)
    every = np.zeros((3, count)), np.tile(direction, count), corners.astype(float)
    closed = intersect_pairs(*every).side != OUTSIDE
    assert not (closed & ~hit).any()
    extra = hit & ~closed
    assert extra[:800].any() == (dtype == np.float64) and not extra[800:].any()
    assert (s[:, hit] >= 0).all() and np.allclose(s[:, hit].sum(axis=0), 1, rtol=0, atol=1e-6)
