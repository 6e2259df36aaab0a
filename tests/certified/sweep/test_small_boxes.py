"""Small triangles: no pixel that is hit is missed, and what is said of the others is true.

What is expected has fractions of the stored rays and the world vertices (`exact_film.py`).
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.sweep import small_boxes
from reference_tracer.certified.sweep.chunks import Expanded, Names
from reference_tracer.certified.sweep.depth_buffer import DepthBuffer
from reference_tracer.certified.sweep.film import Film
from reference_tracer.certified.sweep.rasterise import Boxes
from reference_tracer.certified.sweep.small_boxes import SIDE, are_small, small_pairs
from reference_tracer.scene import Region
from reference_tracer.tracer.camera import camera_rays

from ...tracer.exact_film import ExactFilm
from ...tracer.hostile_scenes import offsets
from .test_film import project

WIDTH, HEIGHT, COUNT = 70, 50, 60


def triangles(camera, rng):
    """Return triangles of some pixels at any depth, (3, 3, COUNT): some thin, some edge-on."""
    size = rng.choice([0.1, 1, 4, 20], COUNT)
    middle = rng.uniform(0, 1, (2, COUNT)) * [[WIDTH], [HEIGHT]]
    at = middle + size * rng.uniform(-0.5, 0.5, (3, 2, COUNT))
    thin = rng.random(COUNT) < 0.3
    at[2] = np.where(thin, at[0] + rng.uniform(0, 1, COUNT) * (at[1] - at[0]) + 1e-5, at[2])
    rounded = rng.random(COUNT) < 0.3  # through pixels' centres
    at = np.where(rounded, np.round(at) + 0.5, at)
    depth = camera.clip_start + 5 * rng.uniform(0.1, 1, (3, 1, COUNT))
    rays = [camera_rays(camera, *corner) for corner in at]
    return np.stack([r.origins + d * r.directions for r, d in zip(rays, depth, strict=True)])


def prepared(film, corners):
    """Return triangles as a chunk, with their boxes in the picture, and which are small."""
    vertices = project(film, np.concatenate(list(corners), axis=1))
    names = Names(np.zeros(1, np.int32), np.array([0, COUNT]), 0)
    expanded = Expanded(vertices, np.arange(3 * COUNT, dtype=np.int32).reshape(3, COUNT), names)
    box = vertices.box.reshape(3, COUNT, 4).min(axis=0).T
    low, high = np.maximum(box[:2], 0), np.minimum(-box[2:], [[WIDTH - 1], [HEIGHT - 1]])
    some = np.flatnonzero((low <= high).all(axis=0))
    return expanded, low, high, some[are_small(film, expanded, low, high, some)]


@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("claim", [0.0, 0.9])
def test_what_is_said_is_true(make, monkeypatch, orthographic, claim):
    """Also where corners are truly off by nearly DELTA."""
    count = Counter()
    for seed in range(4):
        rng = np.random.default_rng(seed)
        camera = make.camera(WIDTH, HEIGHT, half=2.0, orthographic=orthographic)
        film = Film(camera, *offsets(rng))
        corners = triangles(camera, rng)
        expanded, low, high, small = prepared(film, corners)
        off = claim * small_boxes.DELTA * rng.choice([-1, 1], (2, 3 * COUNT))
        expanded.vertices.x[:] += off[0]
        expanded.vertices.y[:] += off[1]
        left: list = []
        region = Region(3, 2, WIDTH - 5, HEIGHT - 1)
        depths = DepthBuffer(region)
        some = Boxes(small, low[:, small], high[:, small])
        parts = list(small_pairs(film, expanded, some, depths, Counter(), left))
        found = {}
        for part in parts:
            for pixel, owner, *said in zip(
                depths.pixels(part.pixel), part.owner, part.least, part.most, part.sure, strict=True
            ):
                key = int(owner), int(pixel)
                assert key not in found
                found[key] = said
        edge_on = set(np.concatenate([*left, small[:0]]).tolist())
        count["edge-on"] += len(edge_on)
        exact = ExactFilm(camera, film.dx, film.dy)
        for k in set(small.tolist()) - edge_on:
            (x0, y0), (x1, y1) = low[:, k], high[:, k] + 1
            x, y = (v.ravel() for v in np.meshgrid(np.arange(x0, x1), np.arange(y0, y1)))
            edges, volume, t = exact.functions(x, y, corners[..., np.full(len(x), k)])
            for n in range(len(x)):
                side = 1 if volume[n] > 0 else -1
                hit = volume[n] != 0 and min(e * side for e in edges[:, n]) >= 0
                inside = region.x0 <= x[n] < region.x1 and region.y0 <= y[n] < region.y1
                pixel = (int(y[n]) - region.y0) * region.width + int(x[n]) - region.x0
                said = found.pop((k, pixel), None) if inside else None
                if hit and inside:
                    least, most, _ = said  # none is missed
                    near = -t[n] if orthographic else 1 / t[n]
                    assert Fraction(least) <= near <= Fraction(most), seed
                    count["narrow"] += most - least < 1e-3 * abs(most)
                count["hit" if hit else "missed"] += 1
                if said and said[2]:
                    assert hit and min(e * side for e in edges[:, n]) > 0, seed
                    count["sure"] += 1
        assert not any(sure for *_, sure in found.values())  # beside the boxes
    assert count["hit"] > 200 and count["missed"] > 200 and count["edge-on"] > 0, count
    assert count["sure"] > 0.5 * count["hit"] and count["narrow"] > 0.5 * count["hit"], count


def test_who_is_small(make):
    camera = make.camera(WIDTH, HEIGHT, half=2.0)
    film, rng = Film(camera), np.random.default_rng(0)
    for _ in range(5):
        expanded, low, high, small = prepared(film, triangles(camera, rng))
        assert 0 < len(small) < COUNT and (high - low)[:, small].max() < SIDE
        assert (low[:, small] > 0).all()
        expanded.vertices.certain[expanded.corners[1, small[0]]] = False
        assert are_small(film, expanded, low, high, small).tolist() == [False] + [True] * (
            len(small) - 1
        )
