"""Embree, verify.cpp: watertight_triangles, triangle_hit, SmallTriangleHit, garbage, NaN/Inf.

*ray_masks* (geometries at (+-10, 0, +-10), each with a mask, and rays that ask for some of them)
has no counterpart: a scene holds what is seen, and nothing else is exported. What corresponds is
that, of every one of the 16 choices of the four objects, each ray sees its own object where that
was chosen, and nothing else.

*garbage* asks for a clean commit of meshes whose coordinates and indices are random bits, and
shoots no ray. Here `Mesh` refuses them, saying why; and what is left when they are repaired as the
exporter does it is traced, and every answer judged. *NaN/Inf* asks that rays with such numbers take
no longer. Here no such ray can come to be: `Camera` and `Scene` refuse what would make one.
"""

from __future__ import annotations

import warnings
from itertools import product

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Plane, Scene, SceneError, drop_non_finite
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.settings import Settings

from ..oracle import scene_sights
from ..rays import nearest_hits
from .meshes import EMBREE_CENTRE, corners_of, embree_sphere, grid
from .shooting import crossings

torture = pytest.mark.torture
RAYS = 5 * sum(range(1, 30))  # 2175, as the original's
SIZES = pytest.mark.parametrize("n", [24, pytest.param(200, marks=torture)])


def from_inside(rng, count=RAYS):
    o = EMBREE_CENTRE[:, None] + rng.uniform(-1, 1, (3, count))
    return o, rng.uniform(-1, 1, (3, count))


@SIZES
@pytest.mark.parametrize("target", ["anywhere", "vertex"])
def test_watertight_sphere(rng, n, target):
    """r = 2 at (148376, 1234, -223423); 159,200 triangles under `make torture`."""
    corners = embree_sphere(n)
    o, d = from_inside(rng)
    if target == "vertex":
        d = corners[0, :, rng.integers(corners.shape[2], size=RAYS)].T - o
    found = crossings(o, d, corners)
    assert (found.counts % 2 == 1).all()
    assert (found.winding() == 1).all()
    watertight = crossings(o, d, corners, Method.WATERTIGHT).counts
    assert (watertight >= 1).all()
    assert ((watertight > 1).mean() > 0.5) == (target == "vertex")


@SIZES
def test_watertight_plane(rng, n):
    """x = 148376, y and z within +-6, n x n quads, from three metres before it."""
    vertices, triangles = grid(n)
    flat = np.stack((vertices[:, 2] + EMBREE_CENTRE[0], *(12 * vertices[:, :2].T - 6)), axis=-1)
    corners = corners_of(flat.astype(np.float32), triangles)
    o = np.array([[EMBREE_CENTRE[0] - 3], [0], [0]])
    anywhere = np.stack((np.ones(RAYS), *rng.random((2, RAYS))))
    at_vertices = corners[0, :, rng.integers(corners.shape[2], size=RAYS)].T - o
    for d in (anywhere, at_vertices[:, (np.abs(at_vertices[1:]) < 5.9).all(axis=0)]):
        assert (crossings(o, d, corners).counts == 1).all()
        seen = nearest_hits(Rays(o, d[:, :100]), corners)
        assert (seen.t * d[0, :100] == 3).all()
        assert (crossings(o, d, corners, Method.WATERTIGHT).counts >= 1).all()


def test_triangle_hit(rng):
    """u, v, t, the point and the normal within 16 ulp, of 256 rays at the unit triangle."""
    u, v = rng.random((2, 256))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])[:, :, None]
    rays = Rays(np.array([[0], [0], [-1.0]]), np.stack((u, v, np.ones(256))))
    hits = nearest_hits(rays, corners)
    ulp = 16 * np.finfo(np.float64).eps
    assert (hits.triangle == 0).all() and (hits.t == 1).all()
    assert np.abs(hits.s - np.stack((1 - u - v, u, v))).max() <= ulp
    assert np.abs(rays.at(hits.t) - np.stack((u, v, 0 * u))).max() <= ulp


@pytest.mark.parametrize("distance", [1e6, 1e9, 1e12])
@pytest.mark.parametrize("count", [60, pytest.param(1000, marks=torture)])
def test_small_triangle_hit(rng, make, distance, count):
    """A turned plane of 100 x 100 quads, from far away at the middle of a triangle: its number.

    The ray passes the middle by its rounding, up to the ulp of the distance: at 1e12 (the original:
    1e6) that is a hundredth of a triangle.
    """
    vertices, triangles = grid(100)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    corners = corners_of((vertices - (0.5, 0.5, 0)) @ (2 * turn.T), triangles)
    which = rng.integers(corners.shape[2], size=count)
    middle = corners[:, :, which].mean(axis=0)
    o = distance * rng.uniform(-1, 1, (3, count))
    facing = np.abs(turn[:, 2] @ o) / np.linalg.norm(o, axis=0)
    o = np.where(facing > 0.1, o, distance * turn[:, 2:])  # not along the plane
    seen = nearest_hits(Rays(o, middle - o), corners)
    assert np.array_equal(seen.triangle, which)
    assert np.abs(seen.t - 1).max() < 0.1 / distance + 1e-15 * distance


def garbage(rng, meshes):
    """Coordinates of random 32 bits; each index in range but for 1 in 32, which is random, too."""
    for _ in range(meshes):
        count = int(rng.integers(1, 256))
        bits = rng.integers(0, 1 << 32, (count + 2, 3), np.uint64).astype(np.uint32)
        triangles = rng.integers(0, count + 2, (count, 3))
        random = rng.integers(-(1 << 31), 1 << 31, (count, 3))
        yield (
            bits.view(np.float32),
            np.where(rng.random((count, 3)) < 1 / 32, random, triangles).astype(np.int32),
        )


@pytest.mark.parametrize("scenes, judged", [(10, 2), pytest.param(1000, 1000, marks=torture)])
def test_garbage(rng, make, scenes, judged):
    """20 meshes in each; 1000 scenes, all judged, take some ten minutes in `make torture`."""
    refused = seen = 0
    camera = make.camera(4, 3, eye=(0, 0, 3), clip_start=1e-30, clip_end=1e38)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for number in range(scenes):
            good = []
            for vertices, triangles in garbage(rng, 20):
                try:
                    Mesh(vertices, triangles)
                except SceneError as error:
                    refused += 1
                    assert "not finite" in str(error) or "indices of triangles" in str(error)
                inside = ((triangles >= 0) & (triangles < len(vertices))).all(axis=1)
                vertices, keep = drop_non_finite(vertices, triangles[inside])
                good.append(Mesh(vertices, triangles[inside][keep]))
            scene = make.scene(camera, *good)
            frame = render(scene, Settings("certified"))
            seen += (frame.instance_index >= 0).sum()
            assert not np.isnan(frame.t).any()
            assert ((frame.instance_index >= 0) <= (frame.t <= 1e38)).all()
            if number < judged:
                names = zip(frame.instance_index.ravel(), frame.triangle_index.ravel(), strict=True)
                assert [s.seen for s in scene_sights(scene)] == [tuple(map(int, n)) for n in names]
    assert refused > 15 * scenes
    assert seen > scenes


def test_world_vertices_beyond_all_floats(make):
    """Finite vertices times a finite matrix may overflow: such triangles are counted, not seen."""
    big = np.diag((1e300, 1e300, 1.0, 1.0))
    quad = make.quad(-1e200, 1e200, -1e200, 1e200, -2)
    near = make.quad(-9, 9, -9, 9, -3)
    camera = make.camera(5, 4)
    scene = Scene(
        camera, (quad, near), (Instance(0, 0, big), Instance(1, 1, np.eye(4))), objects=("A", "B")
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        frame = render(scene, Settings("certified"))
    assert frame.statistics.refused == 2
    assert (frame.object_index == 1).all() and (frame.t == 3).all()


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_no_ray_is_made_of_nan_or_infinity(make, bad):
    for row, column in product(range(4), repeat=2):
        matrix = np.eye(4)
        matrix[row, column] = bad
        with pytest.raises(SceneError, match="finite"):
            type(make.camera())(matrix, make.camera().window, 4, 3)
        with pytest.raises(SceneError, match="finite"):
            Instance(0, 0, matrix)
    window = make.camera().window
    for side in ("left", "right", "bottom", "top"):
        with pytest.raises(SceneError, match="window"):
            make.camera(window=type(window)(**{**vars(window), side: bad}))
    for axis in range(3):
        vector = np.zeros(3)
        vector[axis] = bad
        with pytest.raises(SceneError, match="finite"):
            Plane(0, vector, (0, 0, 1))
        with pytest.raises(SceneError, match="finite"):
            Plane(0, (0, 0, 1), vector)
    for start in (True, False):
        limits = {"clip_start": bad} if start else {"clip_end": bad}
        if not start and bad == np.inf:  # as far as one can see
            frame = render(make.scene(make.camera(**limits), make.quad(-9, 9, -9, 9, -2)))
            assert (frame.t == 2).all()
            continue
        with pytest.raises(SceneError, match="clip"):
            make.camera(**limits)


@pytest.mark.parametrize("chosen", range(16))
def test_of_four_objects_those_are_seen_that_are_there(make, chosen):
    """In place of ray masks."""
    quad = make.quad(-1, 1, -1, 1, 0)
    places = [(x, 0, z) for x in (-10, 10) for z in (-10, 10)]
    instances = []
    for k, place in enumerate(places):
        matrix = np.eye(4)
        matrix[:3, 3] = place
        if chosen >> k & 1:
            instances.append(Instance(0, k, matrix))
    names = ("A", "B", "C", "D")
    for k, (x, y, z) in enumerate(places):
        # Each seen from above, where the other one of its column lies behind or before it.
        camera = make.camera(1, 1, half=0.5, eye=(x, y, z + 5), clip_end=8)
        frame = render(Scene(camera, (quad,), tuple(instances), (), objects=names))
        assert frame.object_index.item() == (k if chosen >> k & 1 else -1)
