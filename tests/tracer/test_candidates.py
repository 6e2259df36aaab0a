"""Culling never leaves out a hit, and pairs are spelled out exactly."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.scene import Instance, Mesh, Region, Scene
from reference_tracer.tracer import candidates, world
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.candidates import pixel_bounds, vertex_bounds, within
from reference_tracer.tracer.nearest import within_clip
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.triangle import TESTS
from reference_tracer.tracer.world import batches, world_triangles, world_vertices

from ..oracle import OUTSIDE, intersect_pairs
from .hostile import hostile_camera, hostile_triangles

CASES = 1500  # of TRIANGLES triangles each


def exact_depth(o, d, corners):
    """Return t, decided in integers, where the ray meets the triangle; else None."""
    found = intersect_pairs(o[:, None], d[:, None], corners[..., None])
    return None if found.side[0] == OUTSIDE else found.t(0)


def hits_outside(camera, corners, bounds, dx, dy):
    """Brute force: yield the (ray, triangle) that floats call a hit outside the triangle's box.

    Some are none: a triangle seen edge on can seem to be hit anywhere along its plane. With them
    come the numbers of hits inside the boxes, of pairs inside them, and of all pairs.
    """
    r, count = camera.region, corners.shape[2]
    rays = camera_rays(camera, *film_positions(r, dx, dy), corners.dtype)
    pixels = r.width * r.height
    o, d = (np.broadcast_to(v, (3, pixels)) for v in (rays.origins, rays.directions))
    px, py = (np.floor(v)[:, None] for v in film_positions(r, 0, 0))
    inside = (px >= bounds[0]) & (px < bounds[1]) & (py >= bounds[2]) & (py < bounds[3])
    every = Rays(*(np.repeat(v, count, axis=1) for v in (o, d)))
    for method in (Method.TEXTBOOK, Method.MOLLER_TRUMBORE):
        hit, t, _ = TESTS[method](every, *np.tile(corners, (1, 1, pixels)))
        hit = (hit & within_clip(camera, t)).reshape(pixels, count)
        yield (
            [
                (o[:, p], d[:, p], corners[:, :, k])
                for p, k in zip(*np.nonzero(hit & ~inside), strict=True)
            ],
            (int((hit & inside).sum()), int(inside.sum()), inside.size),
        )


@pytest.mark.slow
@pytest.mark.parametrize(
    "part", [0, 1, *(pytest.param(n, marks=pytest.mark.torture) for n in (2, 3, 4))]
)
def test_no_hit_is_culled(part, make):
    lost, counts = [], np.zeros(3)
    for seed in range(part * CASES // 5, (part + 1) * CASES // 5):
        rng = np.random.default_rng(seed)
        scale, camera = hostile_camera(make, rng)
        corners = hostile_triangles(camera, scale, rng)
        reach = float(rng.choice([0, 0.25, 0.5]))
        bounds = pixel_bounds(camera, corners, reach)
        r = camera.region
        assert (bounds[[0, 2]].T >= (r.x0, r.y0)).all() and (bounds[[1, 3]].T <= (r.x1, r.y1)).all()
        for dx, dy in {(0, 0), (reach, reach), (-reach, reach), (reach, -reach), (-reach, -reach)}:
            for outside, count in hits_outside(camera, corners, bounds, dx, dy):
                counts += count
                for o, d, triangle in outside:
                    t = exact_depth(o, d, triangle)
                    if t is not None and camera.clip_start <= t <= camera.clip_end:
                        lost.append((seed, reach, float(t)))
    assert not lost
    hits, proposed, possible = counts
    assert hits > 50_000
    assert proposed < 0.5 * possible  # a box that holds everything would be conservative, too


def test_boxes_of_ordinary_triangles_are_tight(make):
    camera = make.camera(40, 40, half=1)
    corners = make.quad(-0.5, 0.25, -0.25, 0.75, -1).vertices[:3, :, None]
    box = pixel_bounds(camera, corners)
    assert box[:, 0].tolist() == [10, 25, 15, 35]
    wider = pixel_bounds(camera, corners, reach=0.5)
    assert (np.abs(wider - box) <= 1).all() and (wider[[1, 3]] > box[[1, 3]]).all()


@pytest.mark.parametrize("orthographic", [False, True])
def test_what_the_clip_range_leaves_out_has_no_box(orthographic, make):
    camera = make.camera(8, 8, orthographic=orthographic, clip_start=1, clip_end=10)
    depths = np.array([-5, 0, 0.99, 1, 5, 10, 10.01, 1e9])
    corners = np.stack(
        [
            np.stack(
                (x * np.maximum(np.abs(depths), 1), y * np.maximum(np.abs(depths), 1), -depths)
            )
            for x, y in ((-9, -9), (9, -9), (0, 9))
        ]
    )
    x0, x1, y0, y1 = pixel_bounds(camera, corners)
    assert ((x0 < x1) & (y0 < y1)).tolist() == [False, False, False, True, True, True, False, False]


TILE = Region(4, 6, 15, 13)


@pytest.mark.parametrize("limit", [1, 7, 64, 10**9])
def test_pairs_spell_boxes_out(limit, rng):
    bounds = rng.integers(0, 20, (4, 200)).astype(np.int32)
    expected = [
        ((y - TILE.y0) * TILE.width + x - TILE.x0, k)
        for k, (x0, x1, y0, y1) in enumerate(bounds.T)
        for y in range(max(y0, TILE.y0), min(y1, TILE.y1))
        for x in range(max(x0, TILE.x0), min(x1, TILE.x1))
    ]
    found, longest = [], 0
    for pixel, triangle in candidates.pairs(within(bounds, TILE), TILE, limit):
        assert len(pixel) == len(triangle) > 0
        longest = max(longest, len(pixel))
        found += zip(pixel.tolist(), triangle.tolist(), strict=True)
    assert len(expected) > 200
    assert sorted(found) == sorted(expected)
    assert longest <= max(limit, TILE.width)


def test_nothing_in_the_tile_gives_no_pairs():
    empty = np.array([[5, 5, 7, 9], [20, 30, 7, 9]], np.int32).T.copy()
    for none in (empty, empty[:, :0]):
        assert not list(candidates.pairs(within(none, TILE), TILE, 10))


@pytest.fixture
def forest(make, rng):
    """Return three meshes (one empty), with instances in a mixed order."""
    meshes = tuple(
        Mesh(rng.normal(size=(12, 3)).astype(np.float32), rng.integers(0, 12, (n, 3)), name=str(n))
        for n in (7, 0, 30)
    )
    instances = [
        Instance(k % 3, 0, np.vstack((rng.normal(size=(3, 4)), (0, 0, 0, 1)))) for k in range(20)
    ]
    return Scene(make.camera(), meshes, instances, objects=("Forest",))


@pytest.mark.parametrize("size", [1, 8, 50, 1 << 14])
def test_batches_hold_every_triangle_once(size, forest, monkeypatch):
    monkeypatch.setattr(world, "BATCH", size)
    names = []
    for batch in batches(forest):
        some = world_triangles(forest, batch, np.float64)
        assert some.corners.shape == (3, 3, len(some.instance)) and len(some.instance) <= size
        names += zip(some.instance.tolist(), some.triangle.tolist(), strict=True)
    assert sorted(names) == [
        (i, k)
        for i, instance in enumerate(forest.instances)
        for k in range(len(forest.meshes[instance.mesh].triangles))
    ]


def test_vertices_are_bit_identical_whatever_the_batch(forest, monkeypatch):
    """A vertex that two triangles share is one point, and stays it in any batch."""
    known = {}
    for size in (1, 3, 10, 64, 1 << 14):
        monkeypatch.setattr(world, "BATCH", size)
        for batch in batches(forest):
            some = world_triangles(forest, batch, np.float64)
            triangles = forest.meshes[batch.mesh].triangles
            for k, (i, triangle) in enumerate(
                zip(some.instance.tolist(), some.triangle.tolist(), strict=True)
            ):
                for corner, vertex in enumerate(triangles[triangle].tolist()):
                    point = some.corners[corner, :, k].tobytes()
                    assert known.setdefault((i, vertex), point) == point
    assert len(known) > 100


@pytest.mark.parametrize("size", [1, 50])  # of few triangles, the vertices lie far apart
def test_boxes_are_those_of_the_corners(size, forest, monkeypatch):
    """Whether vertices that triangles share are projected once, or every corner by itself."""
    monkeypatch.setattr(world, "BATCH", size)
    boxes = set()
    for batch in batches(forest):
        for dtype in (np.float32, np.float64):
            corners = world_triangles(forest, batch, dtype).corners
            shared = vertex_bounds(forest.camera, world_vertices(forest, batch, dtype), 0.5)
            assert np.array_equal(shared, pixel_bounds(forest.camera, corners, 0.5))
            boxes.update(map(tuple, shared.T.tolist()))
    assert len(boxes) > 20


@pytest.mark.parametrize("kept", [0, 200, candidates.SAMPLED])
def test_candidates_are_the_same_for_each_sample(kept, forest, monkeypatch):
    monkeypatch.setattr(candidates, "SAMPLED", kept)
    monkeypatch.setattr(candidates, "PAIRS", 64)
    made = result_of(candidates.cull(forest, np.dtype(float), 1 << 28, 0.5))
    r = forest.camera.region
    low, high = Region(r.x0, r.y0, r.x1, r.y1 // 2), Region(r.x0, r.y1 // 2, r.x1, r.y1)
    sampled, gathered = candidates.Sampled(made), 0
    for tile in (low, low, high, low, low):
        pairs = zip(sampled.of(tile), candidates.candidates(made, tile), strict=True)
        for (share, some), (own_share, own) in pairs:
            assert share == own_share and (some is None) == (own is None)
            if some is not None:
                assert "corners" not in vars(some)  # nobody keeps them from sample to sample
                assert (some.pixel == own.pixel).all() and (some.corners == own.corners).all()
                gathered += len(some.pixel)
    assert gathered > 1000
