"""Which triangles can cover which pixels: culling only, never deciding.

In come a scene and a camera; out go (pixel, triangle) pairs, which the ray/triangle test decides.
A pair may be proposed in vain, but one whose ray truly hits is never left out: the box of pixels
around a projected triangle is widened by a bound on every rounding error that could move it
(`SAFETY`). What a test in float32 says to hit far beside an edge-on sliver, by noise, may be.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .camera import pixel_size, project
from .vector import spread
from .world import WorldTriangles

if TYPE_CHECKING:
    from ..scene import Camera, Region

# Camera-space coordinates and rays are off by at most a few roundings, of half an eps each, of all
# their terms: one for v - o, five for each dot product, three for a ray's direction, two for its
# origin (and one for v and o each when they are cast to float32); and those of the dual basis, less
# than a hundred while the axes are about of unit length and far from a plane (`has_sound_axes`).
# Then the terms of all three coordinates together are not smaller than v and o themselves, and 64
# eps of them cover all. _TINY is far above what gradual underflow may lose.
SAFETY = 64
MIN_DETERMINANT, LENGTHS = 1 / 8, (0.5, 2.0)
_TINY = 2.0**-1000


@dataclass(frozen=True, eq=False)
class Pairs:
    """p pairs of a pixel and a triangle that may cover it.

    `pixel` (p,) indexes the rays; `row` (p,) the batch's `triangles`.
    """

    pixel: NDArray[np.integer]
    row: NDArray[np.integer]
    triangles: WorldTriangles

    @cached_property
    def corners(self) -> NDArray[np.floating]:
        """Corner, component, pair: (3, 3, p), world space."""
        return np.stack([corner.take(self.row, axis=1) for corner in self.triangles.corners])

    @property
    def instance(self) -> NDArray[np.int32]:
        """Whose each triangle is, (p,)."""
        return self.triangles.instance[self.row]

    @property
    def triangle(self) -> NDArray[np.int32]:
        """Which of its mesh each triangle is, (p,)."""
        return self.triangles.triangle[self.row]

    def take(self, index: NDArray) -> Pairs:
        """Return the pairs at `index`."""
        return Pairs(self.pixel[index], self.row[index], self.triangles)


def has_sound_axes(camera: Camera) -> bool:
    """Return whether the bounds of this file hold for a camera's axes."""
    axes = np.stack((camera.right, camera.up, camera.forward))
    with np.errstate(all="ignore"):
        lengths = np.sqrt((axes * axes).sum(axis=1))
        fits = (lengths > LENGTHS[0]) & (lengths < LENGTHS[1])
        return bool(fits.all() and abs(np.linalg.det(axes)) >= MIN_DETERMINANT)


@np.errstate(all="ignore")  # what overflows has no bounds
def pixel_bounds(
    camera: Camera, corners: NDArray[np.floating], reach: float = 0.0
) -> NDArray[np.int32]:
    """Return a box of pixels outside which no ray of the camera truly hits the triangle.

    Parameters
    ----------
    corners : (3, 3, m)
        Corner, component, triangle; world space.
    reach : float
        How far from its pixel's centre, in pixels along each axis, a ray may pass.

    Returns
    -------
    bounds : (4, m) int32
        x0, x1, y0, y1 with x0 <= x < x1 and y0 <= y < y1, within the camera's region; empty where
        x0 >= x1 or y0 >= y1.
    """
    region, count = camera.region, corners.shape[2]
    if not has_sound_axes(camera):
        return _everywhere(region, count)
    flat = np.concatenate(list(corners), axis=1).astype(np.float64)
    xyz, magnitude = project(camera, flat)
    error = SAFETY * np.finfo(corners.dtype).eps * magnitude.sum(axis=0) + _TINY
    error = error.reshape(3, count)
    x, y, depth = xyz.reshape(3, 3, count)
    error = error.max(axis=0)
    nearest, farthest = depth.min(axis=0) - error, depth.max(axis=0) + error
    sizes, window = pixel_size(camera), camera.window
    bounds = np.empty((4, count), np.int32)
    # The part of the triangle that can be seen has a depth of at least this.
    front = np.maximum(nearest, camera.clip_start)
    for axis, (value, size, start, low, high) in enumerate(
        (
            (x, sizes[0], window.left, region.x0, region.x1),
            (y, sizes[1], window.bottom, region.y0, region.y1),
        )
    ):
        smallest, largest = camera.projection.window_range(
            value, depth, error, front, camera.clip_start
        )
        with np.errstate(invalid="ignore", over="ignore"):
            # A film position near `start` comes from cancelling against it.
            slack = reach + SAFETY * np.finfo(corners.dtype).eps * (
                abs(start / size) + camera.width + camera.height
            )
            bounds[2 * axis] = _pixel(
                np.ceil((smallest - start) / size - 0.5 - slack), low, high, low
            )
            bounds[2 * axis + 1] = _pixel(
                np.floor((largest - start) / size - 0.5 + slack) + 1, low, high, high
            )
    unseen = (farthest < camera.clip_start) | (nearest > camera.clip_end)
    bounds[1, unseen] = bounds[0, unseen]
    return bounds


def _pixel(value: NDArray, low: int, high: int, unknown: int) -> NDArray[np.int32]:
    return np.where(np.isnan(value), unknown, np.clip(value, low, high)).astype(np.int32)


def _everywhere(region: Region, count: int) -> NDArray[np.int32]:
    box = np.array([region.x0, region.x1, region.y0, region.y1], np.int32)
    return np.repeat(box[:, None], count, axis=1)


def within(bounds: NDArray[np.int32], tile: Region) -> NDArray[np.int32]:
    """Return the parts of boxes, (4, m) as of :func:`pixel_bounds`, that lie in a tile."""
    x0, x1, y0, y1 = bounds
    return np.stack(
        (
            np.maximum(x0, tile.x0),
            np.minimum(x1, tile.x1),
            np.maximum(y0, tile.y0),
            np.minimum(y1, tile.y1),
        )
    )


def pairs(
    bounds: NDArray[np.int32], tile: Region, limit: int
) -> Iterator[tuple[NDArray[np.intp], NDArray[np.intp]]]:
    """Spell out boxes as (pixel, triangle) pairs, at most about `limit` at a time.

    Parameters
    ----------
    bounds : (4, m) int32
        As of :func:`pixel_bounds`, :func:`within` the tile.
    tile : Region

    Yields
    ------
    pixel : (p,) int
        Index into the tile, row by row from its lowest.
    triangle : (p,) int
        Column of `bounds`.
    """
    x0, x1, y0, y1 = bounds
    some = np.flatnonzero((x0 < x1) & (y0 < y1))
    if not len(some):
        return
    # A run is one row of one box: first its triangle and row, then its pixels.
    triangle, row = spread(some, (y1 - y0)[some])
    row += y0[triangle]
    start = (row - tile.y0) * tile.width + (x0[triangle] - tile.x0)
    length = (x1 - x0)[triangle]
    ends = np.cumsum(length)
    first = 0
    while first < len(length):
        done = ends[first - 1] if first else 0
        last = max(first + 1, int(np.searchsorted(ends, done + limit, side="right")))
        run, step = spread(np.arange(first, last), length[first:last])
        yield start[run] + step, triangle[run]
        first = last
