"""Rays that are not a camera's: each is tested with each triangle, some at a time.

They share nothing that could say which triangles they come near, so nothing is culled.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..scene import Scene
from .camera import Rays
from .candidates import Pairs
from .certified.contest import Contest
from .hits import Hits, Statistics
from .nearest import PAIRS, test_pairs, test_planes
from .progress import Work
from .settings import Settings
from .world import WorldTriangles, batches, world_triangles


def trace_rays(scene: Scene, rays: Rays, settings: Settings, statistics: Statistics) -> Work[Hits]:
    """Find the nearest hits of n rays with t in the camera's clip range, in small steps.

    Parameters are as of `render.trace`, the settings' method a method.
    """
    dtype, first = settings.precision.dtype, len(scene.instances)
    rays = Rays(rays.origins.astype(dtype), rays.directions.astype(dtype))
    count = max(rays.origins.shape[1], rays.directions.shape[1])
    clip = scene.camera.clip_start, scene.camera.clip_end
    hits, contest = Hits.none(count), None
    if settings.method.is_plain:
        test_planes(scene, rays, hits)
    else:
        contest = Contest(rays, [(p.point, p.normal) for p in scene.planes], first, *clip)
    for triangles in _all_triangles(scene, dtype):
        for some in _pairs(triangles, count):
            statistics.pairs_tested += len(some.pixel)
            if contest:
                contest.enter(some)
            else:
                test_pairs(scene, settings, rays, some, hits)
            yield 0.0
    return (yield from contest.hits(statistics)) if contest else hits


def _all_triangles(scene: Scene, dtype: np.dtype) -> Iterator[WorldTriangles]:
    for batch in batches(scene):
        triangles = world_triangles(scene, batch, dtype)
        finite = np.isfinite(triangles.corners).all(axis=(0, 1))
        yield triangles.take(np.flatnonzero(finite))


def _pairs(triangles: WorldTriangles, count: int) -> Iterator[Pairs]:
    """Yield each of `count` rays with each triangle."""
    size = len(triangles.instance)
    total = count * size
    for start in range(0, total, PAIRS):
        ray, row = np.divmod(np.arange(start, min(start + PAIRS, total)), size)
        yield Pairs(ray, row, triangles)
