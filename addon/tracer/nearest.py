"""The nearest hit of every ray.

In come rays and candidates; out go `Hits`: for each ray the nearest t within the clip range, and
whose it is. Exactly equal t go to the lower (instance, triangle); planes come after instances.
`certified.py` does the same with proof.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, Region, Scene
from . import plane
from .camera import Rays, camera_rays, film_positions
from .candidates import Pairs, pairs, pixel_bounds, within
from .hits import NOTHING, Hits, Statistics
from .progress import Work
from .settings import Settings
from .triangle import METHODS
from .vector import Vectors
from .world import Batch, batches, world_triangles

PAIRS = 1 << 15  # tested together: arrays of this length stay in a core's cache
_BYTES_PER_PAIR = 1024  # temporaries of the most demanding test, float64, rounded up


@dataclass(frozen=True, eq=False)
class Plan:
    """Batches of a scene with the rows that each may cover.

    For rays within `reach` pixels of their pixel's centre.
    """

    scene: Scene
    settings: Settings
    reach: float
    batches: list[Batch]
    rows: list[tuple[int, int]]
    refused: int  # triangles that are not finite in world space


def plan(scene: Scene, settings: Settings, reach: float) -> Work[Plan]:
    """Look at every batch once; yields 0, as nothing is traced yet."""
    found, rows, refused = [], [], 0
    for batch in batches(scene):
        _, (x0, x1, y0, y1), left_out = _bounds(scene, settings, reach, batch)
        refused += left_out
        seen = (x0 < x1) & (y0 < y1)
        if seen.any():
            found.append(batch)
            rows.append((int(y0[seen].min()), int(y1[seen].max())))
        yield 0.0
    return Plan(scene, settings, reach, found, rows, refused)


def _bounds(scene: Scene, settings: Settings, reach: float, batch: Batch):
    """Return a batch's triangles but those that are not finite, their bounds, and how many are."""
    triangles = world_triangles(scene, batch, settings.precision.dtype)
    finite = np.isfinite(triangles.corners).all(axis=(0, 1))
    refused = len(finite) - int(finite.sum())
    if refused:
        triangles = triangles.take(np.flatnonzero(finite))
    return triangles, pixel_bounds(scene.camera, triangles.corners, reach), refused


def candidates(
    plan: Plan, tile: Region, wanted: NDArray[np.bool_] | None = None
) -> Iterator[tuple[float, Pairs | None]]:
    """Yield the share of the work that is done, and the next pairs of a tile (None: none yet).

    Parameters
    ----------
    plan : Plan
    tile : Region
        Of n pixels, which the pairs index row by row from the lowest.
    wanted : (n,) bool, optional
        Only these pixels are proposed.
    """
    limit = max(1, min(PAIRS, plan.settings.memory // (4 * _BYTES_PER_PAIR)))
    work = [
        b
        for b, (y0, y1) in zip(plan.batches, plan.rows, strict=True)
        if y0 < tile.y1 and y1 > tile.y0
    ]
    for done, batch in enumerate(work):
        triangles, bounds, _ = _bounds(plan.scene, plan.settings, plan.reach, batch)
        bounds = within(bounds, tile)
        inside = np.flatnonzero((bounds[0] < bounds[1]) & (bounds[2] < bounds[3]))
        triangles = triangles.take(inside)
        yield done / len(work), None
        for pixel, row in pairs(bounds[:, inside], tile, limit):
            if wanted is not None:
                keep = np.flatnonzero(wanted[pixel])
                pixel, row = pixel[keep], row[keep]
            yield done / len(work), Pairs(pixel, row, triangles)


def trace_tile(
    plan: Plan, tile: Region, dx: float = 0.0, dy: float = 0.0, statistics: Statistics | None = None
) -> Work[Hits]:
    """Find the nearest hits of the rays of a tile, in small steps.

    Parameters
    ----------
    plan : Plan
    tile : Region
        Of n pixels.
    dx, dy : float
        Where each ray passes its pixel's centre, in pixels; at most `plan.reach`.
    statistics : Statistics, optional
        To count the pairs in.

    Returns
    -------
    Hits
        Of the n rays, row by row from the lowest.
    """
    scene, settings = plan.scene, plan.settings
    statistics = statistics or Statistics()
    rays = camera_rays(scene.camera, *film_positions(tile, dx, dy), settings.precision.dtype)
    hits = Hits.none(tile.width * tile.height)
    statistics.pairs_tested += len(scene.planes) * len(hits.t)
    test_planes(scene, rays, hits)
    for share, some in candidates(plan, tile):
        if some is not None:
            statistics.pairs_tested += len(some.pixel)
            test_pairs(scene, settings, rays, some, hits)
        yield share
    return hits


def test_pairs(
    scene: Scene, settings: Settings, rays: Rays, some: Pairs, hits: Hits, after: Hits | None = None
) -> None:
    """Enter into `hits` what the rays meet of these pairs, where it is the nearest so far.

    With `after`, only what lies behind those hits counts, in the order of t, instance, triangle.
    """
    hit, t, s = METHODS[settings.method](rays.take(some.pixel), *some.corners)
    found = np.flatnonzero(hit & within_clip(scene.camera, t))
    _keep_nearest(
        hits,
        after,
        some.pixel[found],
        t[found],
        some.instance[found],
        some.triangle[found],
        s[:, found],
    )


def test_planes(scene: Scene, rays: Rays, hits: Hits, after: Hits | None = None) -> None:
    """Enter into `hits` where the rays meet the scene's infinite planes, as :func:`test_pairs`."""
    dtype = rays.directions.dtype
    for index, infinite in enumerate(scene.planes):
        t = plane.intersect(
            rays, infinite.point[:, None].astype(dtype), infinite.normal[:, None].astype(dtype)
        )
        t = np.broadcast_to(t, hits.t.shape)
        found = np.flatnonzero(within_clip(scene.camera, t))
        _keep_nearest(
            hits,
            after,
            found,
            t[found],
            np.full(len(found), len(scene.instances) + index, np.int32),
            np.full(len(found), NOTHING, np.int32),
            np.zeros((3, len(found))),
        )


def within_clip(camera: Camera, t: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Return whether each t (n,), which is the depth, lies in the camera's clip range."""
    with np.errstate(invalid="ignore", over="ignore"):  # NaN; an end that float32 does not have
        return (t >= camera.clip_start) & (t <= camera.clip_end)


def _keep_nearest(hits: Hits, after: Hits | None, pixel, t, instance, triangle, s: Vectors) -> None:
    """Enter hits where they are nearer than what is there; a pixel may occur more than once."""
    if after is not None:
        behind = np.flatnonzero(_behind(pixel, t, instance, triangle, after))
        pixel, t, instance, triangle, s = (
            v.take(behind, axis=-1) for v in (pixel, t, instance, triangle, s)
        )
    # Of several writes to one pixel the last one stays: so those that are nearer come again, the
    # other way round, as many may be sorted.
    while len(pixel):
        nearer = np.flatnonzero(_before(pixel, t, instance, triangle, hits))[::-1]
        pixel, t, instance, triangle, s = (
            v.take(nearer, axis=-1) for v in (pixel, t, instance, triangle, s)
        )
        hits.t[pixel], hits.instance[pixel], hits.triangle[pixel] = t, instance, triangle
        hits.s[:, pixel] = s


def _before(pixel, t, instance, triangle, hits: Hits) -> NDArray[np.bool_]:
    """Whether each hit comes before what its pixel has, in the order of t, instance, triangle."""
    t0, i0, k0 = hits.t[pixel], hits.instance[pixel], hits.triangle[pixel]
    return (t < t0) | ((t == t0) & ((instance < i0) | ((instance == i0) & (triangle < k0))))


def _behind(pixel, t, instance, triangle, hits: Hits) -> NDArray[np.bool_]:
    """Whether each comes after what its pixel has."""
    t0, i0, k0 = hits.t[pixel], hits.instance[pixel], hits.triangle[pixel]
    return (t > t0) | ((t == t0) & ((instance > i0) | ((instance == i0) & (triangle > k0))))
