"""Culling never leaves out a hit, whatever is kept from sample to sample."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.candidates import pixel_bounds
from reference_tracer.tracer.nearest import within_clip
from reference_tracer.tracer.triangle import TESTS

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


def check(cases, shifts) -> tuple[float, float, float]:
    """Hold that no hit is culled; return the numbers of hits, of proposed pairs and of all.

    A case is a camera, corners, and how far beside the centres rays may pass: at the `shifts`.
    """
    counts = np.zeros(3)
    for camera, corners, reach in cases:
        bounds = pixel_bounds(camera, corners, reach)
        r = camera.region
        assert (bounds[[0, 2]].T >= (r.x0, r.y0)).all() and (bounds[[1, 3]].T <= (r.x1, r.y1)).all()
        for dx, dy in {(x * reach, y * reach) for x, y in shifts}:
            for outside, count in hits_outside(camera, corners, bounds, dx, dy):
                counts += count
                for o, d, triangle in outside:
                    t = exact_depth(o, d, triangle)
                    assert t is None or not camera.clip_start <= t <= camera.clip_end
    return tuple(counts)


def hostile(make, seed):
    rng = np.random.default_rng(seed)
    scale, camera = hostile_camera(make, rng)
    corners = hostile_triangles(camera, scale, rng)
    return camera, corners, float(rng.choice([0, 0.25, 0.5]))


@pytest.mark.slow
@pytest.mark.parametrize(
    "part", [0, 1, *(pytest.param(n, marks=pytest.mark.torture) for n in (2, 3, 4))]
)
def test_no_hit_is_culled(part, make):
    seeds = range(part * CASES // 5, (part + 1) * CASES // 5)
    shifts = (0, 0), (1, 1), (-1, 1), (1, -1), (-1, -1)
    hits, proposed, possible = check((hostile(make, seed) for seed in seeds), shifts)
    assert hits > 50_000
    assert proposed < 0.5 * possible  # a box that holds everything would be conservative, too
