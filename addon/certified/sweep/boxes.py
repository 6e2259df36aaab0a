"""Finds the boxes of pixels that instances and triangles may cover, and sorts into depth bins.

An instance's bounding box says, before the instance is expanded, whether it may be in view, how
near it comes, and which pixels it may cover. The boxes of expanded triangles come from those of
their vertices. Triangles are sorted into depth bins, from the front to the back.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce

import numpy as np

from ...arrays import Bools, Floats, Index, Integers, parts
from ...scene import Region, Scene
from ...tracer.candidates import pixel_bounds
from ...tracer.vector import Vectors, gather, largest, transform_points
from ...tracer.world import world_corners
from .chunks import Expanded
from .depth_buffer import DepthBuffer
from .film import Film, with_room
from .vertices import Vertices

_MARGIN = 1.0  # pixels by which the region, and an instance's box, are widened
_TOGETHER = 1 << 15  # triangles at a time


@dataclass(frozen=True, eq=False)
class InstanceBoxes:
    """The boxes of n instances on the film.

    `in_view` (n,) is False for an instance that no ray of the region meets. `depth` (n,) is the
    least of its bounding box, in metres. It covers only pixels from `low` to `high`, (2, n) x and
    y, both included. `nearest` (n,) bounds its nearness (`edge_functions.py`) from above.
    """

    in_view: Bools
    depth: Floats
    low: Integers
    high: Integers
    nearest: Floats

    @classmethod
    @np.errstate(all="ignore")
    def of(cls, scene: Scene, film: Film) -> InstanceBoxes:
        """Project the bounding boxes of all instances."""
        corners, size = _corners_with_room(scene)
        count = corners.shape[2]
        camera = film.camera
        region = camera.region
        # What lies between the corners is rounded like them, from numbers of at most this size.
        size = 4 * (size + np.abs(camera.origin).max())
        vertices = Vertices.empty(8 * count, np.int32)
        film.enter(vertices, 0, corners.reshape(3, 8 * count))
        p = vertices.p.reshape(8, count)
        q = vertices.q.reshape(8, count)
        w = vertices.w.reshape(8, count)
        depth = vertices.depth.reshape(8, count)
        ahead = vertices.ahead.reshape(8, count)
        constant, slope = film.place
        place = constant + slope * size
        weight = film.weight * size
        own = film.depth_error[0] + film.depth_error[1] * size
        outside = (depth + own < camera.clip_start).all(axis=0)
        outside |= (depth - own > camera.clip_end).all(axis=0)
        for value, first, last in ((p, region.x0, region.x1), (q, region.y0, region.y1)):
            for sign, end in ((1, first - _MARGIN), (-1, last + _MARGIN)):
                error = place + abs(end) * weight
                outside |= (sign * (value - end * w) < -error).all(axis=0)
        # If a box is wholly in front of the eye, all of it appears between its corners, up to a
        # margin that is wide enough for all rounding.
        far = max(camera.width, camera.height)
        clear = ahead & (place + far * weight < 0.25 * _MARGIN * w)
        clear = clear.all(axis=0) & film.is_sound
        box = vertices.box.reshape(8, count, 4).min(axis=0).T
        margin = int(_MARGIN)
        return cls(
            ~outside if film.is_sound else np.ones(count, bool),
            np.nan_to_num(depth.min(axis=0)),
            np.where(clear, box[:2] - margin, np.iinfo(np.int32).min),
            np.where(clear, -box[2:] + margin, np.iinfo(np.int32).max),
            np.where(clear, film.nearest(depth.min(axis=0), size), np.inf),
        )

    @property
    def area(self) -> Floats:
        """The number of pixels of each box, (n,)."""
        width, height = self.high - self.low.astype(np.float64) + 1
        return width * height

    def in_region(self, region: Region) -> Bools:
        """Return which instances may cover pixels of a region, (n,)."""
        out = self.in_view.copy()
        for axis, (first, last) in enumerate(((region.x0, region.x1), (region.y0, region.y1))):
            out &= (self.low[axis] < last) & (self.high[axis] >= first)
        return out

    def hidden(self, instances: Index, depths: DepthBuffer) -> Bools:
        """Return which of these instances a depth buffer hides wholly, (k,)."""
        region = depths.region
        first = np.array([[region.x0], [region.y0]])
        last = np.array([[region.x1 - 1], [region.y1 - 1]])
        low = np.clip(self.low[:, instances], first, last) - first
        high = np.clip(self.high[:, instances], first, last) - first
        farthest = [depths.farthest_around(*box) for box in np.concatenate((low, high)).T.tolist()]
        return self.nearest[instances] < np.array(farthest)


def _corners_with_room(scene: Scene) -> tuple[Vectors, Floats]:
    """Return what `_corners` does, with a bound that holds whatever under- or overflows."""
    corners, size = _corners(scene)
    return corners, with_room(size, size + np.abs(scene.camera.origin).max())


def _corners(scene: Scene) -> tuple[Vectors, Floats]:
    """Return the corners of bounding boxes in world space, (3, 8, n).

    And a bound on the numbers that they are computed from, (n,).
    """
    low, high = scene.instance_bounds
    matrices = scene.instance_matrices
    ends = [
        np.stack([(low, high)[corner >> axis & 1][axis] for axis in range(3)])
        for corner in range(8)
    ]
    corners = np.stack([transform_points(matrices, end) for end in ends], axis=1)
    reach = np.maximum(np.abs(low), np.abs(high))
    x, y, z = (np.abs(matrices[:3, k]) * reach[k] for k in range(3))
    size = x + y + z + np.abs(matrices[:3, 3])
    return corners, size.max(axis=0)


def boxes_of(scene: Scene, film: Film, expanded: Expanded) -> tuple[Index, Index, Floats]:
    """Return the boxes of m triangles: lowest and highest pixels, (2, m) x and y each.

    They are clipped to the whole picture. And bounds on the nearness of each from above, (m,).
    """
    vertices = expanded.vertices
    corners = expanded.corners
    kind = vertices.box.dtype
    packed = vertices.box.view(np.int64 if kind.itemsize == 2 else np.complex128).ravel()
    count = corners.shape[1]
    low = np.empty((2, count), kind)
    high = np.empty((2, count), kind)
    nearest = np.empty(count)
    ends = np.array([[film.camera.width - 1], [film.camera.height - 1]], kind)
    overflown = ~np.isfinite(vertices.depth)
    if overflown.any():  # maybe in a sum's first terms alone
        vertices.nearest[overflown] = np.inf
    for part in parts(count, _TOGETHER):
        some = corners[:, part].astype(np.intp)
        box = reduce(np.minimum, [gather(packed, c).view(kind) for c in some]).reshape(-1, 4).T
        np.maximum(box[:2], 0, out=low[:, part])
        np.minimum(np.negative(box[2:], out=high[:, part]), ends, out=high[:, part])
        nearest[part] = largest(*(gather(vertices.nearest, c) for c in some))
    if not vertices.ahead.all() or not vertices.finite.all():
        _mend(scene, film, expanded, low, high)
    return low, high, nearest


def _mend(scene: Scene, film: Film, expanded: Expanded, low: Index, high: Index) -> None:
    """Correct the boxes of triangles with a corner that is not finite, or maybe behind the eye."""
    vertices = expanded.vertices
    corners = expanded.corners
    whole = replace(film.camera, region=Region(0, 0, film.camera.width, film.camera.height))
    finite = vertices.finite.take(corners).all(axis=0)
    high[:, ~finite] = -1
    some = np.flatnonzero(finite & ~vertices.ahead.take(corners).all(axis=0))
    for part in (some[chosen] for chosen in parts(len(some), _TOGETHER)):
        world = world_corners(scene, *expanded.names.of(part))
        x0, x1, y0, y1 = pixel_bounds(whole, world, reach=1.0)
        low[:, part] = x0, y0
        high[:, part] = x1 - 1, y1 - 1


@dataclass(frozen=True, eq=False)
class Boxed:
    """A chunk on the film, with the boxes of its m triangles.

    `first` is the number of its first surface. Boxes are (2, m) x and y, both ends included: `low`
    to `high` in the whole picture, `region_low` to `region_high` in the region. `nearest` (m,)
    bounds the nearness of each triangle from above.
    """

    expanded: Expanded
    first: int
    low: Index
    high: Index
    nearest: Floats
    region_low: Index
    region_high: Index

    @classmethod
    def of(
        cls,
        expanded: Expanded,
        first: int,
        region: Region,
        low: Index,
        high: Index,
        nearest: Floats,
    ) -> Boxed:
        """Clip the boxes to a region."""
        corner = np.array([[region.x0], [region.y0]], low.dtype)
        extent = np.array([[region.width - 1], [region.height - 1]], low.dtype)
        region_low = np.maximum(low - corner, 0)
        region_high = np.minimum(high - corner, extent)
        return cls(expanded, first, low, high, nearest, region_low, region_high)

    @property
    def seen(self) -> Index:
        """The triangles with a pixel of the region in their box."""
        fits = self.region_low <= self.region_high
        return np.flatnonzero(fits[0] & fits[1])

    def in_region(self, triangle: Index) -> tuple[Index, Index]:
        """Return the ends of triangles' boxes in the region."""
        return gather(self.region_low, triangle), gather(self.region_high, triangle)
