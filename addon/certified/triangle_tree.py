"""Proposes the pairs of a ray and a triangle that may meet, by a tree of boxes: for any rays.

What is dropped certainly misses, whatever is rounded: that is argued here and in `tree.py`, by
hand. What is left is decided by `ladder.py`, so that a tree changes nothing that is seen, no t and
no tie.

A triangle is seen along the ray, in two coordinates: of a corner v,
x = v_x - o_x - (d_x / d_z) (v_z - o_z), where z is the axis of the largest |d|. Then the edge
functions are x1 y2 - y1 x2, as `bounds.py` has them but for the factor d_z. If two of them have
opposite signs, the ray misses. With M the largest |v - o| of a component, x and y are off by less
than 6 u M: that is _OFF M with room. With r the largest |x|, |y|, an edge function is then off by
4 r _OFF M + 2 (_OFF M)^2, and 4 u r^2 for its own roundings. Underflow is as in `tree.py`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Bools, Bytes, Floats, Index, parts
from ..tracer.camera import Rays
from ..tracer.world import Pairs, WorldTriangles, finite_triangles
from .bounds import U
from .tree import TINY, TOGETHER, WIDE, BoxRays, Tree, around, neighbours

if TYPE_CHECKING:
    from ..scene import Scene

_OFF = 16 * U


@dataclass(frozen=True, eq=False)
class TriangleTree:
    """A scene's finite triangles, neighbours together, and a tree of boxes around them.

    Leaf i has the triangles WIDE i <= k < WIDE (i + 1).
    """

    triangles: WorldTriangles  # leaves are filled up with copies
    is_one: Bools  # whether each triangle is no copy
    boxes: Tree  # of the leaves

    @classmethod
    def of(cls, scene: Scene) -> TriangleTree:
        """Build the tree of a scene."""
        return cls.made_of(finite_triangles(scene))

    @classmethod
    def made_of(cls, found: WorldTriangles) -> TriangleTree:
        """Build the tree of triangles that are finite."""
        order = neighbours(_boxes(found))
        found = found.take(order)
        leaves = around(_boxes(found).reshape(6, -1, WIDE))
        return cls(found, order >= 0, Tree.of(leaves, np.arange(leaves.shape[1])))

    def pairs(self, rays: Rays, start: float, end: Floats | float) -> Iterator[Pairs]:
        """Yield all pairs of n rays and a triangle that may meet with start <= t <= end."""
        prepared = BoxRays.of(rays, start, end)
        sheared = _Sheared.of(prepared)
        corners = self.triangles.corners.reshape(-1, WIDE)
        ray = np.arange(rays.count)
        for crossed in self.boxes.crossed(prepared, ray, self.boxes.roots.repeat(rays.count)):
            for some in parts(len(crossed), TOGETHER):
                passed, row = _triangles(sheared, corners, crossed.ray[some], crossed.item[some])
                own = np.flatnonzero(self.is_one[row])
                if len(own):
                    yield Pairs(passed[own], row[own], self.triangles)


def _boxes(triangles: WorldTriangles) -> Floats:
    """Return the boxes around m triangles, (6, m)."""
    return np.concatenate((triangles.corners.min(axis=0), triangles.corners.max(axis=0)))


@dataclass(frozen=True, eq=False)
class _Sheared:
    """n rays, as they see triangles along themselves."""

    origins: Floats  # (3, n)
    axes: Bytes  # (3, n): x, y and z
    slopes: Floats  # (2, n): d_x / d_z and d_y / d_z

    @classmethod
    @np.errstate(all="ignore")  # what overflows drops nothing
    def of(cls, rays: BoxRays) -> _Sheared:
        z = np.abs(rays.directions).argmax(axis=0)
        axes = np.stack(((z + 1) % 3, (z + 2) % 3, z))
        along = np.take_along_axis(rays.directions, axes, axis=0)
        return cls(rays.origins, axes.astype(np.uint8), along[:2] / along[2])


@np.errstate(all="ignore")
def _triangles(seen: _Sheared, corners: Floats, ray: Index, leaf: Index) -> tuple[Index, Index]:
    """Return the triangles that p rays may meet of p leaves: rays, and the triangles' numbers."""
    count = len(corners) // 9
    axes = seen.axes[:, ray].astype(np.intp)
    origins = np.take_along_axis(seen.origins[:, ray], axes, axis=0)[..., None]
    sheared = seen.slopes[:, ray][..., None]
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
    off = _OFF * most + TINY
    error = 5 * off * (widest + off) + 8 * U * widest * widest + TINY
    edges = [
        ax * by - ay * bx
        for (ax, ay), (bx, by) in zip(points, [*points[1:], points[0]], strict=True)
    ]
    low = np.minimum(np.minimum(edges[0], edges[1]), edges[2])
    high = np.maximum(np.maximum(edges[0], edges[1]), edges[2])
    row, child = np.nonzero(~((low < -error) & (high > error)))
    return ray[row], leaf[row] * WIDE + child
