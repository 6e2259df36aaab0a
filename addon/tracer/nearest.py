"""Finds the nearest hit of every ray with an unproven method: floating point, and no proof.

Of all surfaces that a ray meets within the clip range, it sees the one of least t. Of exactly equal
t, the lower (instance, triangle) is seen; infinite planes come after the instances.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from ..arrays import Bools, Floats, Index, Places, parts
from ..scene import Camera, Region, Scene
from . import plane
from .camera import Rays, camera_rays, film_positions
from .candidates import PAIRS, Plan, candidates, cull
from .hits import Hits, Statistics
from .progress import Progress, Work
from .settings import Settings
from .triangle import TESTS, sum_is_1
from .world import Pairs, batches, world_triangles

# Finds the hits of a band's rays, which pass their pixels' centres at (dx, dy).
TraceBand = Callable[[Region, float, float], Work[Hits]]
# Takes what the rays of a band meet.
TakeHits = Callable[[Region, Hits], None]


def tracer(
    scene: Scene,
    settings: Settings,
    reach: float,
    statistics: Statistics,
    literally: TakeHits | None = None,
) -> Work[TraceBand]:
    """Prepare to trace bands of a picture by an unproven method.

    Parameters
    ----------
    settings : Settings
        With an unproven method.
    reach : float
        How far from its pixel's centre a ray may pass, in pixels along each axis.
    statistics : Statistics
        To count in.
    literally : callable, optional
        If the method is the textbook, takes what its test as printed meets: some of the same pairs.
        What that takes does not count as time.
    """
    made = yield from plan(scene, settings, reach)
    statistics.refused = made.refused
    return partial(_trace, made, settings, statistics, literally)


def plan(scene: Scene, settings: Settings, reach: float) -> Work[Plan]:
    """Look at every batch once; yields 0, as nothing is traced yet."""
    return cull(scene, settings.precision.dtype, settings.memory, reach)


def _trace(
    plan: Plan,
    settings: Settings,
    statistics: Statistics,
    literally: TakeHits | None,
    tile: Region,
    dx: float,
    dy: float,
) -> Work[Hits]:
    """Find the nearest hits of the rays of a tile, in small steps.

    Each ray passes its pixel's centre at (dx, dy), in pixels, at most `plan.reach`. The hits are
    those of the tile's pixels, row by row from the lowest. Pairs are counted in the statistics.
    `literally` is as :func:`tracer` has it.
    """
    scene = plan.scene
    rays = camera_rays(scene.camera, *film_positions(tile, dx, dy), settings.precision.dtype)
    hits = Hits.none(tile.width * tile.height)
    statistics.pairs_tested += len(scene.planes) * len(hits)
    test_planes(scene, rays, hits)
    printed = hits.take(np.arange(len(hits) if literally else 0))
    for share, some in candidates(plan, tile):
        if some is not None:
            statistics.pairs_tested += len(some.pixel)
            seen, found = test_pairs(scene, settings, rays, some, hits)
            if literally:
                began = time.perf_counter()
                own = np.flatnonzero(sum_is_1(found.s))
                keep_nearest(printed, None, some.pixel[seen[own]], found.take(own))
                statistics.seconds -= time.perf_counter() - began
        yield Progress(share)
    if literally:
        began = time.perf_counter()
        literally(tile, printed)
        statistics.seconds -= time.perf_counter() - began
    return hits


def trace_rays(scene: Scene, rays: Rays, settings: Settings, statistics: Statistics) -> Work[Hits]:
    """Find the nearest hits of any n rays, each tested with every triangle, in small steps."""
    hits = Hits.none(rays.count)
    test_planes(scene, rays, hits)
    for pairs in every_pair(scene, rays, statistics):
        test_pairs(scene, settings, rays, pairs, hits)
        yield None
    return hits


def every_pair(scene: Scene, rays: Rays, statistics: Statistics) -> Iterator[Pairs]:
    """Yield all pairs of a ray and a triangle: rays that are not a camera's can cull nothing."""
    dtype = rays.directions.dtype
    for batch in batches(scene):
        triangles = world_triangles(scene, batch, dtype)
        triangles = triangles.take(np.flatnonzero(triangles.finite))
        total = rays.count * len(triangles)
        for part in parts(total, PAIRS):
            number = np.arange(part.start, part.stop)
            statistics.pairs_tested += len(number)
            yield Pairs(*np.divmod(number, len(triangles)), triangles)


def test_pairs(
    scene: Scene,
    settings: Settings,
    rays: Rays,
    some: Pairs,
    hits: Hits,
    after: Hits | None = None,
) -> tuple[Places, Hits]:
    """Enter into `hits` what the rays meet of these pairs, where it is the nearest so far.

    With `after`, only what lies behind those hits counts, in the order of t, instance, triangle.
    Returns the places of all pairs that meet within the clip range, near or far, and their hits.
    """
    hit, t, s = TESTS[settings.method](rays.take(some.pixel), *some.corners)
    seen = np.flatnonzero(hit & within_clip(scene.camera, t))
    found = Hits.of(t[seen], some.instance[seen], some.triangle[seen], s[:, seen])
    keep_nearest(hits, after, some.pixel[seen], found)
    return seen, found


def test_planes(scene: Scene, rays: Rays, hits: Hits, after: Hits | None = None) -> None:
    """Enter into `hits` where the rays meet the scene's infinite planes, as :func:`test_pairs`."""
    dtype = rays.directions.dtype
    for index, infinite in enumerate(scene.planes):
        t = plane.intersect(
            rays, infinite.point[:, None].astype(dtype), infinite.normal[:, None].astype(dtype)
        )
        t = np.broadcast_to(t, hits.t.shape)
        seen = np.flatnonzero(within_clip(scene.camera, t))
        found = Hits.none(len(seen))
        found.t[:] = t[seen]
        found.instance[:] = len(scene.instances) + index
        keep_nearest(hits, after, seen, found)


def within_clip(camera: Camera, t: Floats) -> Bools:
    """Return whether each t (n,), which is the depth, lies in the camera's clip range."""
    with np.errstate(invalid="ignore", over="ignore"):  # NaN; an end that float32 does not have
        return (t >= camera.clip_start) & (t <= camera.clip_end)


def keep_nearest(hits: Hits, after: Hits | None, pixel: Index, found: Hits) -> None:
    """Enter hits where they are nearer than those before; a pixel may occur more than once."""
    if after is not None:
        behind = np.flatnonzero(_before(after, pixel, found, slice(None)))
        pixel, found = pixel[behind], found.take(behind)
    # A pixel may occur several times, and of several writes to one index numpy keeps the last. So
    # all that are nearer than what is stored are written, then those that are nearer still, and so
    # on. Each round brings a pixel's hit nearer, so that it ends. The order is turned round each
    # time, as a mesh is often sorted from near to far, or from far to near.
    while len(pixel):
        nearer = np.flatnonzero(_before(found, slice(None), hits, pixel))[::-1]
        pixel, found = pixel[nearer], found.take(nearer)
        hits.enter(pixel, found)


def _before(first: Hits, rays: Index | slice, second: Hits, others: Index | slice) -> Bools:
    """Return where hits of `rays` come before others, in the order of t, instance, triangle."""
    t, other_t = first.t[rays], second.t[others]
    instance, other = first.instance[rays], second.instance[others]
    lower = first.triangle[rays] < second.triangle[others]
    lower = (instance < other) | ((instance == other) & lower)
    return (t < other_t) | ((t == other_t) & lower)
