"""Mitsuba 3: the robust flag of test_mesh.py, and the kd-tree's depths against a naive search.

Mitsuba's `ray_test`, which asks whether anything at all is hit, has no counterpart: no shadow is
traced. In its place stands `decide` over all pairs. The bunny is replaced by a knotted torus.
"""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.scene import Mesh, ViewWindow
from reference_tracer.study.oracle import intersect_pairs
from reference_tracer.tracer.camera import Rays, camera_rays
from reference_tracer.tracer.settings import Settings

from ..rays import nearest_hits
from .meshes import corners_of, stairs
from .shooting import crossings

torture = pytest.mark.torture


def cosine_hemisphere(u, v):
    """Concentric discs, raised: Mitsuba's square_to_cosine_hemisphere."""
    x, y = 2 * u - 1, 2 * v - 1
    wide = np.abs(x) > np.abs(y)
    radius = np.where(wide, x, y)
    with np.errstate(divide="ignore", invalid="ignore"):
        angle = np.where(wide, np.pi / 4 * y / x, np.pi / 2 - np.pi / 4 * x / y)
    p, q = radius * np.cos(angle), radius * np.sin(angle)
    return np.stack((p, q, np.sqrt(np.maximum(1 - p * p - q * q, 0))))


@pytest.mark.parametrize("side", [32, pytest.param(150, marks=torture)])
@pytest.mark.parametrize("turned", [False, True], ids=["true ties", "rounded"])
def test_robust_flag(side, turned):
    """Rays at a point of the diagonal of a square, turned by 90 degrees about (1, 1, 1): all hit.

    Without its robust flag, Embree loses some; watertight loses none, but meets both triangles.
    """
    turn = np.eye(3)
    if turned:
        x, y, z = np.full(3, 3**-0.5)
        skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        turn = skew + np.full((3, 3), 1 / 3)  # cos 90 = 0, sin 90 = 1
    vertices = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], float)
    corners = corners_of(vertices @ turn.T, np.array([(0, 1, 2), (1, 3, 2)]))
    u, v = np.meshgrid(np.linspace(0.05, 0.95, side), np.linspace(0.05, 0.95, side))
    way = cosine_hemisphere(u.ravel(), v.ravel())
    way = np.round(way * 2**30) / 2**30  # so that (.5, .5, 0) + way is exact
    o, d = turn @ (np.array([[0.5], [0.5], [0]]) + way), -turn @ way
    found = crossings(o, d, corners, all_pairs=True)
    assert (found.counts == 1).all()
    assert found.edge.all() == (not turned)
    assert np.array_equal(nearest_hits(Rays(o, d), corners).triangle[found.ray], found.triangle)
    plain = crossings(o, d, corners, Method.WATERTIGHT, all_pairs=True)
    assert (plain.counts >= 1).all() and (plain.counts == 2).any()


def of_pixels(camera):
    """The rays that the camera stores, through the middles of its pixels."""
    x, y = np.meshgrid(np.arange(camera.width) + 0.5, np.arange(camera.height) + 0.5)
    return camera_rays(camera, x.ravel(), y.ravel())


@pytest.mark.parametrize("n", [41, pytest.param(127, marks=torture)])
def test_stairs(make, n):
    """20 stairs, n x n rays straight down: the depth in closed form; some meet a step's edge.

    The picture, its candidates culled, is that of all rays with all triangles, bit for bit.
    """
    vertices, triangles = stairs(20)
    # A picture of n rows; and one of 20 with a ray on each edge of a stair.
    for rows, bottom in ((n, 0.0), (20, -0.5 / 20)):
        window = ViewWindow(0, 1, bottom, bottom + 1)
        camera = make.camera(
            n, rows, orthographic=True, eye=(0, 0, 2), window=window, clip_start=0, clip_end=100
        )
        scene = make.scene(camera, Mesh(vertices, triangles))
        frame = render(scene, Settings("certified"))
        rays = of_pixels(camera)
        o = rays.origins
        x, y = o[:2].reshape(2, rows, n)
        naive = nearest_hits(rays, corners_of(vertices, triangles))
        any_hit = crossings(
            o, rays.directions.repeat(x.size, axis=1), corners_of(vertices, triangles)
        )
        assert np.array_equal(naive.triangle.reshape(x.shape), frame.triangle_index)
        assert np.array_equal(naive.t.reshape(x.shape), frame.t)
        assert np.array_equal(any_hit.counts > 0, naive.triangle >= 0)
        inside = (y > 1e-9) & (x > 0)
        assert (frame.triangle_index[inside] >= 0).all()
        if rows == n:
            assert np.allclose(frame.t, 2 - np.floor(y * 20) / 20, rtol=0, atol=1e-9)
        else:  # on the edges: of the tread below, or of the one above
            below, above = (2 - np.floor(y * 20 + way) / 20 for way in (-0.5, 0.5))
            near = np.minimum(abs(frame.t - below), abs(frame.t - above))
            assert (near[inside] < 1e-9).all()


@pytest.mark.parametrize("n", [50, pytest.param(100, marks=torture)])
def test_a_mesh_in_any_pose(make, rng, n):
    """n x n rays through the mesh's box: the picture is that of a naive search, bit for bit."""
    shape = trimesh.creation.torus(1.0, 0.45, major_sections=40, minor_sections=24)
    vertices = shape.vertices + 0.2 * np.sin(5 * shape.vertices[:, [1, 2, 0]])
    mesh = Mesh(vertices.astype(np.float32), shape.faces)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    window = ViewWindow(low[0], high[0], low[1], high[1])
    camera = make.camera(
        n, n, orthographic=True, eye=(0, 0, high[2] + 1), window=window, clip_end=100
    )
    frame = render(make.scene(camera, mesh), Settings("certified"))
    rays = of_pixels(camera)
    o, d = rays.origins, rays.directions.repeat(n * n, axis=1)
    corners = corners_of(mesh.vertices, mesh.triangles)
    found = crossings(o, d, corners)
    assert (found.counts % 2 == 0).all() and (found.counts > 0).mean() > 0.3
    assert np.array_equal(found.nearest().reshape(n, n), frame.triangle_index)
    hit = np.flatnonzero(frame.triangle_index.ravel() >= 0)
    result = intersect_pairs(
        o[:, hit],
        d[:, hit],
        corners[:, :, frame.triangle_index.ravel()[hit]],
    )
    assert frame.t.ravel()[hit].tolist() == [float(result.t(k)) for k in range(len(hit))]
