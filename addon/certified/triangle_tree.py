"""Proposes the pairs of a ray and a triangle that may meet, by a tree of boxes: for any rays.

What is dropped certainly misses, whatever is rounded: that is argued in `tree.py`, by hand. What is
left is decided by `ladder.py`, so that a tree changes nothing that is seen, no t and no tie.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Floats, parts
from ..tracer.camera import Rays
from ..tracer.candidates import PAIRS
from ..tracer.world import Pairs, WorldTriangles, finite_triangles
from .tree import BoxRays, Tree

if TYPE_CHECKING:
    from ..scene import Scene


@dataclass(frozen=True, eq=False)
class TriangleTree:
    """A scene's finite triangles, and a tree of the boxes around them."""

    triangles: WorldTriangles
    boxes: Tree

    @classmethod
    def of(cls, scene: Scene) -> TriangleTree:
        """Build the tree of a scene."""
        return cls.made_of(finite_triangles(scene))

    @classmethod
    def made_of(cls, found: WorldTriangles) -> TriangleTree:
        """Build the tree of triangles that are finite."""
        corners = found.corners
        boxes = np.concatenate((corners.min(axis=0), corners.max(axis=0)))
        return cls(found, Tree.of(boxes, np.arange(len(found))))

    def pairs(self, rays: Rays, start: float, end: Floats | float) -> Iterator[Pairs]:
        """Yield all pairs of n rays and a triangle that may meet with start <= t <= end."""
        roots = self.boxes.roots.repeat(rays.count)
        prepared = BoxRays.of(rays, start, end)
        for crossed in self.boxes.crossed(prepared, np.arange(rays.count), roots):
            for some in parts(len(crossed), PAIRS):
                yield Pairs(crossed.ray[some], crossed.item[some], self.triangles)
