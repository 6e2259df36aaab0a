"""Projects vertices to the film, in homogeneous pixels, and bounds the rounding errors.

A point of space has p, q, w: it appears at the film position (p / w, q / w), in pixels. For a
perspective camera w is the depth; for an orthographic one it is 1. A ray passes the film at its
pixel's position. So a ray and a triangle in space become a point and a triangle in the plane.

Vertices are rounded when they are projected, and rays were rounded before. The errors of both are
bounded together, as if the rays had none: p and q are off by at most `place`, w by `weight`, and
the depth by `depth_error`. Each is linear in the vertex's `size`, which is the largest |coordinate|
of the vertex plus that of the camera's origin. Theorems: `Perspective.vertex_near`,
`Orthographic.vertex_near'`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import Floats
from ...scene import Camera, Scene
from ...tracer.camera import dual_axes, pixel_size
from ...tracer.candidates import SAFETY, has_sound_axes
from ...tracer.vector import Vectors, largest
from ...tracer.world import reaches
from .vertices import Vertices

_EPS = 2.0**-52
_TINY = 2.0**-960  # added to a vertex's size: more than gradual underflow may lose
DELTA = 2.0**-25  # pixels: far above what dividing by w moves a film position
_HUGE = 2.0**900  # metres: nothing overflows of what is of a smaller size
_OFF = 2  # pixels beyond the picture to which boxes are clipped


def with_room(size: Floats, most: Floats, reach: Floats | float = 0.0) -> Floats:
    """Return the size of what n instances have, with room for underflow; inf where it may overflow.

    `most` (n,) is the largest |number| that is multiplied by the camera's axes. They may underflow
    before they are multiplied by coordinates of at most `reach` (n,).
    """
    size = size + _TINY * (1 + reach)
    return np.where(size + most < _HUGE, size, np.inf)


@dataclass(frozen=True, eq=False)
class Film:
    """A camera's film, for rays at (dx, dy) from their pixel's centre, at most half a pixel.

    The bounds are those of `candidates.py`, with the largest term of a sum in place of every term.
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
        """Whether the bounds hold; if not, they are infinite."""
        parallel = self.camera.projection.shares_direction
        return has_sound_axes(self.camera) and (parallel or self.ray_error <= 0.25)

    @cached_property
    def ray_error(self) -> float:
        """Bound the error of stored rays in camera space.

        For a perspective camera, that of a direction, relative to its depth; for an orthographic
        one, that of an origin, in metres.
        """
        c = self.camera
        reach = self._reach[0] + self._reach[1]
        axes = np.abs((c.right, c.up, c.forward)).max()
        parallel = c.projection.shares_direction
        length = np.abs(c.origin).max() + axes * reach if parallel else axes * (1 + reach)
        return 24 * _EPS * self._spread * length

    @cached_property
    def place(self) -> tuple[float, float]:
        """c0, c1: p and q of a vertex, relative to any pixel, are off by at most c0 + c1 size."""
        c = self.camera
        if not self.is_sound:
            return np.inf, 0.0
        starts = c.window.left, c.window.bottom
        constant = slope = 0.0
        for start, size, reach in zip(starts, pixel_size(c), self._reach, strict=True):
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
        """c0, c1: for parallel rays, the t of a vertex is off by at most c0 + c1 size."""
        return 2 * self.ray_error if self.is_sound else np.inf, SAFETY * _EPS * self._spread

    def rows(self, scene: Scene) -> tuple[Floats, Floats]:
        """Return p, q, w and the depth as linear functions of n instances' object spaces.

        (4, 4, n): the slopes along x, y and z, and a constant. And a bound on the size of the
        instances' vertices, (n,).
        """
        camera = self.camera
        columns = scene.instance_matrices[:3].copy()  # (3, 4, n)
        size = 1.01 * (reaches(scene).max(axis=0, initial=0) + np.abs(camera.origin).max())
        columns[:, 3] -= camera.origin[:, None]
        reach = np.abs(scene.instance_bounds).max(axis=(0, 1))
        size = with_room(size, np.abs(columns).max(axis=(0, 1)), reach)
        right, up, depth = (
            d[0] * columns[0] + d[1] * columns[1] + d[2] * columns[2] for d in self.dual
        )
        w = depth
        if camera.projection.shares_direction:
            w = np.zeros_like(depth)
            w[3] = 1
        window = camera.window
        width, height = pixel_size(camera)
        p = (right - window.left * w) / width - self.dx * w
        q = (up - window.bottom * w) / height - self.dy * w
        return np.stack((p, q, w, depth)), size

    def nearest(self, depth: Floats, size: Floats) -> Floats:
        """Bound the nearness of the visible part of vertices from above, (n,)."""
        if self.camera.projection.shares_direction:
            constant, slope = self.depth_error
            return (constant + slope * size) - depth
        before = np.maximum(depth - self.weight * size, self.camera.clip_start)
        return (1 + 2.0**-48 + 2 * self.ray_error) / before

    def enter(self, vertices: Vertices, first: int, world: Vectors) -> None:
        """Project world points (3, n) into the n vertices from `first` on."""
        part = slice(first, first + world.shape[1])
        camera = self.camera
        window = camera.window
        size = largest(*np.abs(world))
        vertices.finite[part] = np.isfinite(size)
        size += np.abs(camera.origin).max() + _TINY
        q = world - camera.origin[:, None]
        right, up, depth = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2] for d in self.dual)
        w = camera.projection.scale(depth)
        width, height = pixel_size(camera)
        vertices.p[part] = (right - window.left * w) * (1 / width) - self.dx * w
        vertices.q[part] = (up - window.bottom * w) * (1 / height) - self.dy * w
        vertices.w[part] = w
        vertices.depth[part] = depth
        vertices.size[part] = size
        vertices.nearest[part] = self.nearest(depth, size)
        self._enter_positions(vertices, part)

    def _enter_positions(self, vertices: Vertices, part: slice) -> None:
        """Divide p and q by w, and bound the error of that: film positions, and boxes of pixels."""
        camera = self.camera
        w = vertices.w[part]
        size = vertices.size[part]
        # Where w is off by less than a thousandth, a point that is projected far beside the picture
        # truly lies on that side of it, and the others lie at most `margin` away.
        constant, slope = self.place
        margin = constant + slope * size
        vertices.ahead[part] = w > 2.0**10 * self.weight * size
        x = np.divide(vertices.p[part], w, out=vertices.x[part])
        y = np.divide(vertices.q[part], w, out=vertices.y[part])
        far = 2 * max(camera.width, camera.height)
        margin += far * self.weight * size
        margin = 1.01 * (margin / w)
        margin += 0.5
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
        """The sum of all |elements| of the dual axes."""
        a, b, c, d, e, f, g, h, i = np.abs(self.dual).ravel()
        return float(((a + b) + (c + d)) + ((e + f) + (g + h)) + i)

    @property
    def _reach(self) -> tuple[float, float]:
        """The largest |x| and |y| of the view window."""
        w = self.camera.window
        return max(abs(w.left), abs(w.right)), max(abs(w.bottom), abs(w.top))
