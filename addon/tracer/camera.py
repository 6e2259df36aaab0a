"""Makes the rays of a camera: origins and directions in world space.

A ray is x = o + t d. Directions come from the camera's own axes: in perspective,
d = x right + y up + forward for a film position (x, y); `projections/` has each type of camera.
They are not normalised, so that t is the depth along the view axis (for a panorama, the distance).
They are never the difference of a world-space pixel and the camera's position, which would lose
most digits far from the origin.

The textbook (docs/glossary.md, "The exercise") has, for the pixel in column i,

    pixel = tan(a) / (height / 2)                    x = (i - (width - 1) / 2) pixel

where a is *half* the vertical angle of view. Here it is

    pixel = (right edge - left edge) / width         x = left edge + (i + 1/2) pixel

with the edges of the view window of `scene.Camera`. They are the same where the top edge is tan(a).
(The text can also be read as tan(a / (height / 2)), which holds for small angles only.)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import DTypeLike

from ..arrays import Array, Floats, Index
from .vector import Vectors, cross, dot

if TYPE_CHECKING:
    from ..scene import Camera, Region


@dataclass(frozen=True, eq=False)
class Rays:
    """n rays: `origins` and `directions`, (3, n) each, or (3, 1) where all share it.

    The shapes say what is shared, but not of one ray: that shares nothing, unless who makes it says
    that it has the origin or the direction of others.
    """

    origins: Vectors
    directions: Vectors
    one_origin: bool = False
    one_direction: bool = False

    def __post_init__(self) -> None:
        o, d = self.origins.shape[1] == 1, self.directions.shape[1] == 1
        object.__setattr__(self, "one_origin", o and (self.one_origin or not d))
        object.__setattr__(self, "one_direction", d and (self.one_direction or not o))

    @property
    def count(self) -> int:
        """How many rays there are."""
        return (self.directions if self.one_origin else self.origins).shape[1]

    def take(self, index: Index) -> Rays:
        """Return the rays at `index`; what all share stays shared."""
        return Rays(
            self.origins if self.one_origin else self.origins.take(index, axis=1),
            self.directions if self.one_direction else self.directions.take(index, axis=1),
            self.one_origin,
            self.one_direction,
        )

    def at(self, t: Floats) -> Vectors:
        """Return the points o + t d, (3, n)."""
        return self.origins + t * self.directions


def pixel_size(camera: Camera) -> tuple[float, float]:
    """Return width and height of a pixel on the view window's plane."""
    w = camera.window
    return (w.right - w.left) / camera.width, (w.top - w.bottom) / camera.height


def film_positions(
    tile: Region,
    dx: Floats | float = 0.0,
    dy: Floats | float = 0.0,
    pixel: Index | None = None,
) -> tuple[Floats, Floats]:
    """Return where rays that pass their pixel's centre at (dx, dy) meet the film, (n,) each.

    In pixels of the whole picture. The rays are those of the tile's pixels, row by row from the
    lowest, or of some, by their numbers `pixel` (n,).
    """
    if pixel is None:
        pixel = np.arange(tile.width * tile.height)
    pixel = pixel.astype(np.int32)
    y = pixel // np.int32(tile.width)  # faster than `divmod`
    x = pixel - y * np.int32(tile.width)
    return (x + tile.x0) + 0.5 + dx, (y + tile.y0) + 0.5 + dy


def camera_rays(
    camera: Camera,
    px: Array,
    py: Array,
    dtype: DTypeLike = np.float64,
) -> Rays:
    """Return the rays through film positions.

    Parameters
    ----------
    px, py : (n,) float
        Pixels of the whole picture; pixel (i, j) has its centre at (i + 0.5, j + 0.5).
    dtype
        In which every step is computed.
    """

    def cast(value: object) -> Array:
        return np.asarray(value, dtype=dtype)

    width, height = pixel_size(camera)
    with np.errstate(over="ignore", invalid="ignore"):  # a camera may be beyond float32's range
        x = cast(camera.window.left) + cast(px) * cast(width)
        y = cast(camera.window.bottom) + cast(py) * cast(height)
        right, up, forward, origin = (
            cast(v)[:, None] for v in (camera.right, camera.up, camera.forward, camera.origin)
        )
        ray = camera.projection.ray(origin, x, y, right, up, forward)
    parallel = camera.projection.shares_direction
    return Rays(*ray, one_origin=not parallel, one_direction=parallel)


def dual_axes(camera: Camera) -> Floats:
    """Return the rows of the inverse of the axes right, up, forward, (3, 3)."""
    axes = np.stack((camera.right, camera.up, camera.forward))
    dual = np.stack([cross(axes[k - 2], axes[k - 1]) for k in range(3)])
    return dual / dot(axes[0], dual[0])


def corner_rays(camera: Camera, dx: float = 0.0, dy: float = 0.0) -> Rays:
    """Return rays that enclose those of all pixels, by component.

    What is computed for these holds for all rays, and does not depend on the region that is traced.
    Where rays are linear they are those of the picture's corner pixels, as rounding is monotone;
    else the axes' sums, for what an axis is multiplied by is at most 1, but for a few roundings.
    """
    if not camera.projection.is_linear:
        most = np.abs((camera.right, camera.up, camera.forward)).sum(axis=0) * (1 + 2.0**-40)
        return Rays(camera.origin[:, None], np.stack((-most, most), axis=1))
    px = np.array([0.5, 0.5, camera.width - 0.5, camera.width - 0.5]) + dx
    py = np.array([0.5, camera.height - 0.5] * 2) + dy
    return camera_rays(camera, px, py)


def film_of(camera: Camera, points: Vectors) -> tuple[Floats, Floats, Floats]:
    """Return where world points (3, n) appear on the film, in pixels, and their t, (n,) each.

    What a perspective camera does not have in front of it appears nowhere: NaN.
    """
    xyz, _ = project(camera, points)
    width, height = pixel_size(camera)
    w = camera.window
    x, y, t = camera.projection.film(xyz, (w.left + w.right) / 2)
    return (x - w.left) / width, (y - w.bottom) / height, t


def film_beside(camera: Camera, points: Vectors, px: Floats, py: Floats) -> Floats:
    """Return how far from film positions (n,) world points (3, n) appear, (2, n) pixels.

    Straight lines in space are straight there. Where the film is curved, it is the plane that
    touches it in each position: only what is near appears in its place.
    """
    xyz, _ = project(camera, points)
    (width, height), w = pixel_size(camera), camera.window
    at = w.left + px * width, w.bottom + py * height
    x, y = camera.projection.beside(xyz, *at)
    return np.stack((x / width, y / height))


def project(camera: Camera, points: Vectors) -> tuple[Vectors, Vectors]:
    """Return camera-space coordinates of world points, and what bounds their rounding errors.

    The axes need not be orthonormal, so they are inverted through their dual basis:
    X = (v - o) . (up x forward) / det, and so on; Z is the depth, positive in front.

    Returns
    -------
    xyz : (3, n) float64
        Right, up, depth, in metres.
    magnitude : (3, n) float64
        Sum of the absolute values of the terms of each coordinate: times a few ulp it bounds the
        error of `xyz`, and of rays that were computed from the same camera.
    """
    dual = dual_axes(camera)
    origin = camera.origin[:, None]
    q, size = points - origin, np.abs(points) + np.abs(origin)
    weight = np.abs(dual)
    xyz = [d[0] * q[0] + d[1] * q[1] + d[2] * q[2] for d in dual]
    magnitude = [w[0] * size[0] + w[1] * size[1] + w[2] * size[2] for w in weight]
    return np.stack(xyz), np.stack(magnitude)
