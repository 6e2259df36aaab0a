"""Proposes the pairs of a ray and a triangle that may meet, by a tree of boxes: for any rays.

What is dropped certainly misses, whatever is rounded: that is argued here, by hand. What is left is
decided by `ladder.py`, so that a tree changes nothing that is seen, no t and no tie.

- **A box** holds its triangles' corners as they are: nothing of it is rounded. A ray is within it
  for the t between near and far, (side - o) / d along each axis. The quotients are off by three
  roundings each, and d by a power of two that is exact: `_LOOSE` is five times that. Where d is 0
  along an axis, the ray is within if its origin is. Where d is next to 0, so that 1 / d might
  overflow, nothing is dropped along that axis. A ray that was moved infinitesimally (`exact.py`)
  meets no triangle whose closed box the ray itself misses.
- **A triangle** is seen along the ray, in two coordinates: of a corner v,
  x = v_x - o_x - (d_x / d_z) (v_z - o_z), where z is the axis of the largest |d|. Then the edge
  functions are x1 y2 - y1 x2, as `bounds.py` has them but for the factor d_z. If two of them have
  opposite signs, the ray misses. With M the largest |v - o| of a component, x and y are off by less
  than 6 u M: that is _OFF M with room. With r the largest |x|, |y|, an edge function is then off by
  4 r _OFF M + 2 (_OFF M)^2, and 4 u r^2 for its own roundings.

Products that underflow are off by 2^-1075 each: `_TINY` is far above. What overflows is infinite or
NaN, and drops nothing: all comparisons with it are false.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Bools, Bytes, Floats, Index, Places
from ..tracer.camera import Rays
from ..tracer.vector import parts
from ..tracer.world import Pairs, WorldTriangles, batches, world_triangles
from .bounds import U

if TYPE_CHECKING:
    from ..scene import Scene

WIDE = 8  # triangles of a leaf, and children of a node: a cache line of float64
RAYS = 1 << 14  # that go down the tree together
_TOGETHER = 1 << 12  # nodes that are tested together: their temporaries stay in a core's cache
_LOOSE = 16 * U
_OFF = 16 * U
_TINY = 2.0**-1060
_MOST = 2.0**1022
_LEAST = 2.0**-500  # of |d| along an axis, the largest being 1 to 2


@dataclass(frozen=True, eq=False)
class Tree:
    """A scene's finite triangles, neighbours together, and boxes around them.

    Leaf i has the triangles WIDE i <= k < WIDE (i + 1); its box is child i % WIDE of the node
    i // WIDE of the last level, and so on up to the root.
    """

    triangles: WorldTriangles  # leaves are filled up with copies
    is_one: Bools  # whether each triangle is no copy
    refused: int  # triangles that are left out, as a corner is not finite
    # The children's boxes by level, the root first: (6 k, WIDE), rows 0 to k the low x, and so on.
    levels: tuple[Floats, ...]

    @classmethod
    def of(cls, scene: Scene) -> Tree:
        """Build the tree of a scene."""
        every = [world_triangles(scene, batch, np.dtype(float)) for batch in batches(scene)]
        found = WorldTriangles.joined([WorldTriangles.none(), *every])
        finite = np.flatnonzero(found.finite)
        refused = len(found) - len(finite)
        found = found.take(finite)
        count = len(found)
        order = _neighbours(found.corners) if count else np.arange(0)
        found = found.take(np.minimum(order, count - 1))
        ends = np.concatenate((found.corners.min(axis=0), found.corners.max(axis=0)))
        boxes = _joined(ends.reshape(6, -1, WIDE))
        levels: list[Floats] = []
        while count and (boxes.shape[1] > 1 or not levels):
            missing = -boxes.shape[1] % WIDE
            empty = np.repeat(((np.inf,), (-np.inf,)), 3, axis=0)
            boxes = np.concatenate((boxes, np.repeat(empty, missing, axis=1)), axis=1)
            children = boxes.reshape(6, -1, WIDE)
            levels.append(children.reshape(-1, WIDE))
            boxes = _joined(children)
        return cls(found, order < count, refused, tuple(levels[::-1]))

    def pairs(self, rays: Rays, start: float, end: float) -> Iterator[Pairs]:
        """Yield all pairs of n rays and a triangle that may meet with start <= t <= end."""
        seen = _Seen.of(rays, start, end)
        # Without a direction a ray meets nothing, not even a box.
        ray = np.flatnonzero(~seen.still.all(axis=0) & bool(self.levels))
        node = np.zeros_like(ray)
        for boxes in self.levels:
            kept = [_children(seen, boxes, ray[some], node[some]) for some in _some(ray)]
            ray, node = (np.concatenate(each) for each in zip(*kept, strict=True))
            if not len(ray):
                return
        corners = self.triangles.corners.reshape(-1, WIDE)
        for some in _some(ray):
            passed, row = _triangles(seen, corners, ray[some], node[some])
            own = np.flatnonzero(self.is_one[row])
            if len(own):
                yield Pairs(passed[own], row[own], self.triangles)


@dataclass(frozen=True, eq=False)
class _Seen:
    """n rays, as the tests take them: d is scaled by a power of two, its largest |d| 1 to 2."""

    origins: Floats  # (3, n)
    inverse: Floats  # (3, n) 1 / d; of any size where |d| is below _LEAST
    steep: Bools  # (3, n): |d| is below _LEAST, or 0
    still: Bools  # (3, n): d is 0
    backward: Places  # (3, n) 1 where d is negative, else 0
    start: Floats  # (n,) of the clip range, in the scaled t
    end: Floats
    axes: Bytes  # (3, n): x, y and z of the second test
    sheared: Floats  # (2, n): d_x / d_z and d_y / d_z

    @classmethod
    @np.errstate(all="ignore")  # what overflows drops nothing
    def of(cls, rays: Rays, start: float, end: float) -> _Seen:
        """Prepare finite rays."""
        count = rays.count
        origins = np.broadcast_to(rays.origins, (3, count))
        own = np.broadcast_to(rays.directions, (3, count))
        size = np.abs(own)
        exponent = np.frexp(size.max(axis=0))[1] - 1
        d = np.ldexp(own, -exponent)
        steep = np.abs(d) < _LEAST
        z = size.argmax(axis=0)
        axes = np.stack(((z + 1) % 3, (z + 2) % 3, z))
        along = np.take_along_axis(d, axes, axis=0)
        return cls(
            np.ascontiguousarray(origins),
            1 / np.where(steep, 1.0, d),
            steep,
            own == 0,
            (d < 0).astype(np.intp),
            np.ldexp(np.full(count, start), exponent),
            np.ldexp(np.full(count, end), exponent),
            axes.astype(np.uint8),
            along[:2] / along[2],
        )


@np.errstate(all="ignore")
def _children(seen: _Seen, boxes: Floats, ray: Index, node: Index) -> tuple[Index, Index]:
    """Return the children that p rays may meet of p nodes: rays, and the children's numbers."""
    count = len(boxes) // 6
    near = np.repeat(seen.start[ray][:, None], WIDE, axis=1)
    far = np.repeat(seen.end[ray][:, None], WIDE, axis=1)
    for axis in range(3):
        origin, inverse = seen.origins[axis][ray][:, None], seen.inverse[axis][ray][:, None]
        backward = seen.backward[axis][ray]
        first = boxes.take((axis + 3 * backward) * count + node, axis=0)
        last = boxes.take((axis + 3 - 3 * backward) * count + node, axis=0)
        for side in (first, last):
            side -= origin
            side *= inverse
        steep = np.flatnonzero(seen.steep[axis][ray])
        if len(steep):
            own = ray[steep]
            low = boxes.take(axis * count + node[steep], axis=0)
            high = boxes.take((axis + 3) * count + node[steep], axis=0)
            at = seen.origins[axis][own][:, None]
            beside = seen.still[axis][own][:, None] & ~((low <= at) & (at <= high))
            first[steep] = np.where(beside, np.inf, -np.inf)
            last[steep] = np.inf
        np.fmax(near, first, out=near)  # NaN, of 0 x inf, bounds nothing
        np.fmin(far, last, out=far)
    np.fmin(near, _MOST, out=near)  # else inf, of an empty box, is beyond no slack
    np.fmax(far, -_MOST, out=far)
    slack = _LOOSE * np.abs(near) + _LOOSE * np.abs(far) + _TINY
    row, child = np.nonzero(~(near - far > slack))
    return ray[row], node[row] * WIDE + child


@np.errstate(all="ignore")
def _triangles(seen: _Seen, corners: Floats, ray: Index, leaf: Index) -> tuple[Index, Index]:
    """Return the triangles that p rays may meet of p leaves: rays, and the triangles' numbers."""
    count = len(corners) // 9
    axes = seen.axes[:, ray].astype(np.intp)
    origins = np.take_along_axis(seen.origins[:, ray], axes, axis=0)[..., None]
    sheared = seen.sheared[:, ray][..., None]
    points = []
    most = np.zeros((len(ray), WIDE))
    widest = np.zeros((len(ray), WIDE))
    for corner in range(3):
        arm = [
            corners.take((3 * corner + axis) * count + leaf, axis=0) - origin
            for axis, origin in zip(axes, origins, strict=True)
        ]
        for each in arm:
            np.maximum(most, np.abs(each), out=most)
        point = [across - slope * arm[2] for across, slope in zip(arm, sheared, strict=False)]
        for each in point:
            np.maximum(widest, np.abs(each), out=widest)
        points.append(point)
    off = _OFF * most + _TINY
    error = 5 * off * (widest + off) + 8 * U * widest * widest + _TINY
    edges = [
        ax * by - ay * bx
        for (ax, ay), (bx, by) in zip(points, [*points[1:], points[0]], strict=True)
    ]
    low = np.minimum(np.minimum(edges[0], edges[1]), edges[2])
    high = np.maximum(np.maximum(edges[0], edges[1]), edges[2])
    row, child = np.nonzero(~((low < -error) & (high > error)))
    return ray[row], leaf[row] * WIDE + child


def _some(rows: Index) -> list[slice]:
    return parts(len(rows), _TOGETHER) or [slice(0)]


def _joined(boxes: Floats) -> Floats:
    """Return the box around each row of boxes: (6, k) of (6, k, WIDE)."""
    return np.concatenate((boxes[:3].min(axis=2), boxes[3:].max(axis=2)))


@np.errstate(all="ignore")  # any order is right
def _neighbours(corners: Floats) -> Index:
    """Return numbers below m, neighbours together: of each half, and of half of that, and so on.

    Each part is halved, or first cut in three, along the axis in which it is widest. There are a
    few more numbers than triangles, so that parts are equally large: those not below m are none's.
    """
    count = corners.shape[2]
    cuts = _cuts(-(-count // WIDE))
    total = WIDE * math.prod(cuts)
    middle = 0.5 * corners.min(axis=0) + 0.5 * corners.max(axis=0)
    middle = np.pad(middle, ((0, 0), (0, total - count)), "edge")
    order = np.arange(total)[None]
    for cut in cuts:
        along = middle.take(order, axis=1)
        widest = (along.max(axis=2) - along.min(axis=2)).argmax(axis=0)
        key = np.take_along_axis(along, widest[None, :, None], axis=0)[0]
        size = order.shape[1] // cut
        place = np.argpartition(key, [size * k for k in range(1, cut)], axis=1)
        order = np.take_along_axis(order, place, axis=1).reshape(-1, size)
    return order.reshape(-1)


def _cuts(leaves: int) -> list[int]:
    """Return how parts are cut, so that there are at least `leaves`, and few more."""
    sizes = []
    for threes in range(6):
        twos = max(0, math.ceil(math.log2(max(leaves, 1) / 3**threes)))
        sizes.append((3**threes * 2**twos, [3] * threes + [2] * twos))
    return min(sizes)[1]
