"""Where vertices appear on the film, in homogeneous pixels, and how far that may be off.

A point of space has p, q, w: it appears at the film position (p / w, q / w), in pixels. Before a
perspective camera w is the depth; for an orthographic one it is 1. A ray passes the film where its
pixel says. So a ray and a triangle of space are a point and a triangle of the plane.

Both are rounded, and the rays were before anything was projected. Their errors are bounded together
as if the rays had none: p and q are off by at most `place`, w by `weight`, and the depth by
`depth_error`, each linear in the vertex's `size`, the largest coordinate of |v| plus that of |o|.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...scene import Camera
from ...tracer.camera import dual_axes, pixel_size
from ...tracer.candidates import SAFETY, has_sound_axes
from ...tracer.vector import Floats, Vectors, largest

_EPS = 2.0**-52
# Added to a vertex's size: its share in the bounds is far above what gradual underflow may lose.
_TINY = 2.0**-960
DELTA = 2.0**-25  # pixels: a film position is `certain` where it is off by no more
_HUGE = 2.0**900  # metres: of what is smaller, and certain, nothing over- or underflows
_OFF = 2  # pixels beyond the picture where boxes end


@dataclass(frozen=True, eq=False)
class Vertices:
    """Vertices on the film, (v,) each.

    `box` (v, 4) holds, negated where it is an upper end, the pixels whose centres a triangle with
    this vertex may cover: lowest x, lowest y, -highest x, -highest y. The minimum over its corners
    is a triangle's own. It holds only where `ahead`: where the vertex surely is before the eye.
    `x`, `y` is the film position; it is off by at most DELTA where `certain`, which are ahead.
    `nearest` is the most that the nearness (`edge_functions.py`) of what is seen there can be.
    """

    p: Floats
    q: Floats
    w: Floats
    x: Floats
    y: Floats
    depth: Floats
    size: Floats
    nearest: Floats
    box: NDArray[np.integer]
    ahead: NDArray[np.bool_]
    certain: NDArray[np.bool_]
    finite: NDArray[np.bool_]

    @classmethod
    def empty(cls, count: int, dtype: np.dtype | type) -> Vertices:
        """Return room for vertices."""
        floats = (np.empty(count) for _ in range(8))
        box = np.empty((count, 4), dtype)
        return cls(*floats, box, *(np.empty(count, bool) for _ in range(3)))


@dataclass(frozen=True, eq=False)
class Film:
    """A camera's film, for rays that pass their pixel's centre at (dx, dy), at most half a pixel.

    The bounds are those of `candidates.py`, with the largest term of each sum for all of its terms.
    """

    camera: Camera
    dx: float = 0.0
    dy: float = 0.0

    @cached_property
    def dual(self) -> Floats:
        """The camera's dual axes, (3, 3)."""
        return dual_axes(self.camera)

    @cached_property
    def is_sound(self) -> bool:
        """Whether the bounds hold; where they do not, they are infinite."""
        parallel = self.camera.projection.shares_direction
        return has_sound_axes(self.camera) and (parallel or self.ray_error <= 0.25)

    @cached_property
    def ray_error(self) -> float:
        """How far a stored ray's direction may be off, in camera space: relative to its depth.

        Of an orthographic camera: how far its origin may be off, in metres.
        """
        c = self.camera
        reach = self._reach[0] + self._reach[1]
        axes = np.abs((c.right, c.up, c.forward)).max()
        parallel = c.projection.shares_direction
        length = np.abs(c.origin).max() + axes * reach if parallel else axes * (1 + reach)
        return 24 * _EPS * self._spread * length

    @cached_property
    def place(self) -> tuple[float, float]:
        """c0, c1: p and q of a vertex, counted from any pixel, are off by at most c0 + c1 size."""
        c = self.camera
        if not self.is_sound:
            return np.inf, 0.0
        window = (c.window.left, c.window.bottom)
        constant, slope = 0.0, 0.0
        for start, size, reach in zip(window, pixel_size(c), self._reach, strict=True):
            film = SAFETY * _EPS * (abs(start / size) + c.width + c.height)
            if c.projection.shares_direction:
                slope = max(slope, (SAFETY + 8) * _EPS * self._spread / size)
                constant = max(constant, film + 2 * self.ray_error / size)
            else:  # |w| <= spread * size; an error along the axis moves a ray by its film position
                own = (SAFETY + 8) * _EPS * (1 + abs(start)) / size
                ray = 2 * self.ray_error * (1 + reach) / size
                slope = max(slope, self._spread * (own + film + ray))
        return constant, slope

    @cached_property
    def weight(self) -> float:
        """c: w of a vertex is off by at most c size."""
        if not self.is_sound:
            return np.inf
        return 0.0 if self.camera.projection.shares_direction else SAFETY * _EPS * self._spread

    @cached_property
    def depth_error(self) -> tuple[float, float]:
        """c0, c1: the t of a vertex is off by at most c0 + c1 size, orthographic."""
        return 2 * self.ray_error if self.is_sound else np.inf, SAFETY * _EPS * self._spread

    def nearest(self, depth: Floats, size: Floats) -> Floats:
        """Return the most that the nearness of what is seen of vertices can be."""
        if self.camera.projection.shares_direction:
            constant, slope = self.depth_error
            return (constant + slope * size) - depth
        before = np.maximum(depth - self.weight * size, self.camera.clip_start)
        return (1 + 2.0**-48 + 2 * self.ray_error) / before

    def certain_nearness(self, depth: Floats) -> Floats:
        """Return the nearness of vertices that are `certain`."""
        return -depth if self.camera.projection.shares_direction else 1 / depth

    def certain_error(self, nearness: Floats) -> Floats | float:
        """Return by how much that of a ray may be another, of vertices as near as this or less.

        Where a vertex is certain, `weight` size / w is at most DELTA / 4 pixels of the picture's
        size, and for parallel rays the slope of `place` times size at most DELTA / 2.
        """
        if self.camera.projection.shares_direction:
            constant, slope = self.depth_error
            return constant + slope * (DELTA / self.place[1])
        far = max(self.camera.width, self.camera.height)
        return (DELTA / far + 2 * self.ray_error + 2.0**-50) * nearness

    def enter(self, vertices: Vertices, first: int, world: Vectors) -> None:
        """Project world points (3, n) into the n of these vertices from `first` on."""
        part = slice(first, first + world.shape[1])
        camera, window = self.camera, self.camera.window
        size = largest(*np.abs(world))
        vertices.finite[part] = np.isfinite(size)
        size += np.abs(camera.origin).max() + _TINY
        q = world - camera.origin[:, None]
        right, up, depth = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2] for d in self.dual)
        w = camera.projection.scale(depth)
        width, height = pixel_size(camera)
        x = (right - window.left * w) * (1 / width) - self.dx * w
        y = (up - window.bottom * w) * (1 / height) - self.dy * w
        vertices.p[part], vertices.q[part], vertices.w[part] = x, y, w
        vertices.depth[part], vertices.size[part] = depth, size
        # From here on film positions. Where w is off by less than a thousandth, what appears far
        # beside the picture truly lies on that side of it, and the rest at most `margin` away.
        constant, slope = self.place
        margin = constant + slope * size
        vertices.ahead[part] = w > 2.0**10 * self.weight * size
        x, y = np.divide(x, w, out=vertices.x[part]), np.divide(y, w, out=vertices.y[part])
        far = 2 * max(camera.width, camera.height)
        margin += far * self.weight * size
        margin = 1.01 * (margin / w)
        # Half of DELTA is for the rounding of the division.
        certain = np.less_equal(margin, 0.5 * DELTA, out=vertices.certain[part])
        certain &= vertices.ahead[part] & (largest(np.abs(x), np.abs(y)) <= far) & (size < _HUGE)
        margin += 0.5
        vertices.nearest[part] = self.nearest(depth, size)
        for axis, (at, end) in enumerate(((x, camera.width), (y, camera.height))):
            vertices.ahead[part] &= np.isfinite(at)
            lowest = at - margin
            np.clip(np.ceil(lowest, out=lowest), -_OFF, end + _OFF, out=lowest)
            vertices.box[part, axis] = lowest
            highest = np.floor(np.add(at, margin, out=lowest), out=lowest)
            np.clip(np.subtract(1, highest, out=lowest), -end - _OFF, _OFF, out=lowest)
            vertices.box[part, 2 + axis] = lowest

    @property
    def _spread(self) -> float:
        a, b, c, d, e, f, g, h, i = np.abs(self.dual).ravel()
        return float(((a + b) + (c + d)) + ((e + f) + (g + h)) + i)

    @property
    def _reach(self) -> tuple[float, float]:
        w = self.camera.window
        return max(abs(w.left), abs(w.right)), max(abs(w.bottom), abs(w.top))
