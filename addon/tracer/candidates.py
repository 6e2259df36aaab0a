"""Proposes the pairs of a pixel and a triangle that the ray/triangle test decides.

Pairs come batch by batch, so that memory is bounded. Some do not hit, but none that truly hits is
left out: the box of pixels around a projected triangle is widened by a bound on every rounding
error that could move it (`SAFETY`). float32 may report a hit far beside an edge-on sliver; such a
hit may be left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Bools, Floats, Integers
from .boxes import pairs
from .camera import pixel_size, project
from .progress import Work
from .vector import Vectors
from .world import (
    Batch,
    Pairs,
    WorldTriangles,
    WorldVertices,
    batches,
    world_triangles,
    world_vertices,
)

if TYPE_CHECKING:
    from ..scene import Camera, Region, Scene

# The error of camera-space coordinates and of rays, in eps (2 u) of the sum of their |terms|. A
# rounding is half an eps: one for v - o, five for each dot product, three for a ray's direction,
# two for its origin (and one each for v and o when they are cast to float32). Those of the dual
# basis are less than a hundred if the axes are about of unit length and far from lying in a plane
# (`has_sound_axes`). Then the terms of all three coordinates together are at least as large as v
# and o, and 64 eps cover all roundings.
SAFETY = 64
MIN_DETERMINANT = 1 / 8  # of the camera's axes, relative to the product of their lengths
LENGTHS = (0.5, 2.0)  # between which those of the camera's axes are
_TINY = 2.0**-1000  # added to an error: far above what gradual underflow may lose
PAIRS = 1 << 15  # pairs tested together: arrays of this length stay in a core's cache
KEPT = 1 << 17  # triangles of a plan, with their boxes, that are kept from pass to pass: 12 MB
BYTES_PER_PAIR = 1024  # temporaries of the most demanding test, float64, rounded up


# A batch's finite triangles, their boxes of pixels, and how many are not finite.
_Bounded = tuple[WorldTriangles, Integers, int]


@dataclass(frozen=True, eq=False)
class Plan:
    """The batches of a scene, each with the rows of pixels that it may cover.

    It holds for rays within `reach` pixels of their pixel's centre, and vertices rounded to
    `dtype`. Pairs may take about `memory` bytes.
    """

    scene: Scene
    dtype: np.dtype[np.floating]
    memory: int
    reach: float
    batches: list[Batch]
    rows: list[tuple[int, int]]  # first and end
    refused: int  # how many triangles are not finite in world space
    kept: list[_Bounded]  # of the first batches


def has_sound_axes(camera: Camera) -> bool:
    """Return whether the error bounds of this file hold for a camera's axes."""
    axes = np.stack((camera.right, camera.up, camera.forward))
    with np.errstate(all="ignore"):
        lengths = np.sqrt((axes * axes).sum(axis=1))
        fits = (lengths > LENGTHS[0]) & (lengths < LENGTHS[1])
        least = MIN_DETERMINANT * max(1.0, float(lengths.prod()))
        return bool(fits.all() and abs(np.linalg.det(axes)) >= least)


def pixel_bounds(camera: Camera, corners: Vectors, reach: float = 0.0) -> Integers:
    """Return boxes of pixels outside which no ray of the camera truly hits a triangle.

    Parameters
    ----------
    corners : (k, 3, m)
        Corner, component, convex polygon; world space.
    reach : float
        How far from its pixel's centre a ray may pass, in pixels along each axis.

    Returns
    -------
    bounds : (4, m) int32
        x0, x1, y0, y1 with x0 <= x < x1 and y0 <= y < y1, within the camera's region; empty where
        x0 >= x1 or y0 >= y1.
    """
    flat = np.concatenate(list(corners), axis=1)
    every = np.arange(flat.shape[1]).reshape(len(corners), -1)
    return vertex_bounds(camera, WorldVertices(flat, every), reach)


@np.errstate(all="ignore")  # what overflows has no bounds
def vertex_bounds(camera: Camera, vertices: WorldVertices, reach: float = 0.0) -> Integers:
    """Return what :func:`pixel_bounds` does, of polygons that share vertices."""
    region = camera.region
    count = vertices.corners.shape[1]
    if not has_sound_axes(camera):
        everywhere = np.array([region.x0, region.x1, region.y0, region.y1], np.int32)
        return np.repeat(everywhere[:, None], count, axis=1)
    xyz, magnitude = project(camera, vertices.points.astype(np.float64))
    magnitude = magnitude[0] + magnitude[1] + magnitude[2]
    eps = float(np.finfo(vertices.points.dtype).eps)
    error = vertices.of_corners(SAFETY * eps * magnitude + _TINY).max(axis=0)
    corners = vertices.of_corners(xyz).swapaxes(0, 1)
    w = camera.window
    sizes = pixel_size(camera)
    starts = (w.left, w.bottom)
    # Film positions near their start lose digits when it is subtracted.
    slacks = [
        reach + SAFETY * eps * (abs(start / size) + camera.width + camera.height)
        for start, size in zip(starts, sizes, strict=True)
    ]
    x, y = (size * slack for size, slack in zip(sizes, slacks, strict=True))
    edges = w.left - x, w.right + x, w.bottom - y, w.top + y
    smallest, largest, nearest, farthest = camera.projection.box(
        corners, error, camera.clip_start, edges, eps
    )
    bounds = np.empty((4, count), np.int32)
    ends = (region.x0, region.x1), (region.y0, region.y1)
    for axis, (size, start, slack, (low, high)) in enumerate(
        zip(sizes, starts, slacks, ends, strict=True)
    ):
        first = np.ceil((smallest[axis] - start) / size - 0.5 - slack)
        end = np.floor((largest[axis] - start) / size - 0.5 + slack) + 1
        bounds[2 * axis] = _pixel(first, low, high, low)
        bounds[2 * axis + 1] = _pixel(end, low, high, high)
    unseen = (farthest < camera.clip_start) | (nearest > camera.clip_end)
    bounds[1, unseen] = bounds[0, unseen]
    return bounds


def _pixel(value: Floats, low: int, high: int, unknown: int) -> Integers:
    """Return pixels, clipped to low and high; `unknown` for NaN."""
    return np.where(np.isnan(value), unknown, np.clip(value, low, high)).astype(np.int32)


def within(bounds: Integers, tile: Region) -> Integers:
    """Intersect boxes of pixels with a tile; they are as :func:`pixel_bounds` has them, (4, m)."""
    x = np.clip(bounds[:2], tile.x0, tile.x1)
    return np.concatenate((x, np.clip(bounds[2:], tile.y0, tile.y1)))


def cull(scene: Scene, dtype: np.dtype[np.floating], memory: int, reach: float) -> Work[Plan]:
    """Find the batches that are in view, and their rows."""
    found = []
    rows = []
    kept: list[_Bounded] = []
    refused = count = 0
    for batch in batches(scene):
        bounded = _bounds(scene, dtype, reach, batch)
        triangles, (x0, x1, y0, y1), left_out = bounded
        refused += left_out
        seen = (x0 < x1) & (y0 < y1)
        if seen.any():
            count += len(triangles)
            if count <= KEPT:
                kept.append(bounded)
            found.append(batch)
            rows.append((int(y0[seen].min()), int(y1[seen].max())))
        yield None
    return Plan(scene, dtype, memory, reach, found, rows, refused, kept)


def _bounds(scene: Scene, dtype: np.dtype[np.floating], reach: float, batch: Batch) -> _Bounded:
    vertices = world_vertices(scene, batch, dtype)
    triangles = world_triangles(scene, batch, dtype, vertices)
    finite = triangles.finite
    refused = len(finite) - int(finite.sum())
    if refused:
        some = np.flatnonzero(finite)
        triangles = triangles.take(some)
        vertices = replace(vertices, corners=vertices.corners[:, some])
    return triangles, vertex_bounds(scene.camera, vertices, reach), refused


def candidates(
    plan: Plan, tile: Region, wanted: Bools | None = None
) -> Iterator[tuple[float, Pairs | None]]:
    """Yield the share of the work that is done, and the next pairs of a tile, or None for none yet.

    Pairs number the tile's n pixels row by row from the lowest; or those that are `wanted` (n,), in
    that order.
    """
    limit = max(1, min(PAIRS, plan.memory // (4 * BYTES_PER_PAIR)))
    before = None if wanted is None else np.append(0, np.cumsum(wanted, dtype=np.int32))
    work = [number for number, (y0, y1) in enumerate(plan.rows) if y0 < tile.y1 and y1 > tile.y0]
    for done, number in enumerate(work):
        bounded = plan.kept[number] if number < len(plan.kept) else None
        triangles, bounds, _ = bounded or _bounds(
            plan.scene, plan.dtype, plan.reach, plan.batches[number]
        )
        bounds = within(bounds, tile)
        inside = np.flatnonzero((bounds[0] < bounds[1]) & (bounds[2] < bounds[3]))
        triangles = triangles.take(inside)
        yield done / len(work), None
        for pixel, row in pairs(bounds[:, inside], tile, limit, before):
            yield done / len(work), Pairs(pixel, row, triangles)
