"""Divides the triangles of a large mesh into clusters, each with a box in object space.

Triangles that follow one another in a mesh are often neighbours: so a cluster is SIZE of them in a
row, and nothing is sorted. Clusters are kept as long as their mesh, from picture to picture, and
shared by all its instances. One picture is too few for them: they are made when a mesh is swept for
the second time.
"""

from __future__ import annotations

from dataclasses import dataclass
from weakref import WeakKeyDictionary, WeakSet

import numpy as np

from ...arrays import Floats
from ...scene import Mesh

SIZE = 64  # triangles of a cluster
LEAST = 1 << 13  # triangles of a mesh that has clusters
_TOGETHER = 1 << 8  # clusters whose boxes are computed together: they stay in a core's cache


@dataclass(frozen=True, eq=False)
class Clusters:
    """The k clusters of a mesh: SIZE triangles each, but for the last.

    Their vertices are at most `half` (3, k) from `middle` (3, k) along each axis of object space,
    up to a rounding.
    """

    middle: Floats
    half: Floats

    @classmethod
    def of(cls, mesh: Mesh) -> Clusters:
        """Compute the boxes of the clusters of a mesh that has triangles."""
        count = -(-len(mesh.triangles) // SIZE)
        low, high = np.empty((2, 3, count))
        axes = mesh.vertices.T.copy()
        for first in range(0, count, _TOGETHER):
            some = slice(first, first + _TOGETHER)
            corners = mesh.triangles[first * SIZE : (first + _TOGETHER) * SIZE].ravel()
            missing = -len(corners) % (3 * SIZE)
            corners = np.pad(corners.astype(np.intp), (0, missing), "edge")
            for axis, along in enumerate(axes):
                at = along.take(corners).reshape(-1, 3 * SIZE)
                low[axis, some] = at.min(axis=1)
                high[axis, some] = at.max(axis=1)
        middle = 0.5 * low + 0.5 * high
        return cls(middle, np.maximum(high - middle, middle - low))

    def __len__(self) -> int:
        return self.middle.shape[1]

    @property
    def are_compact(self) -> bool:
        """Whether the boxes are much smaller than that of the whole mesh.

        A k-th of a surface has about a k-th of the surface of its box, and a k-th of a volume
        k^(-2/3). But if triangles follow one another in any order, it has all of it.
        """
        low = (self.middle - self.half).min(axis=1)
        high = (self.middle + self.half).max(axis=1)
        whole = _surface(0.5 * high - 0.5 * low)
        return bool(_surface(self.half).sum() <= np.sqrt(len(self)) * whole)


_SWEPT: WeakSet[Mesh] = WeakSet()  # at least once
_KNOWN: WeakKeyDictionary[Mesh, Clusters | None] = WeakKeyDictionary()


def clusters_of(mesh: Mesh) -> Clusters | None:
    """Return the clusters of a mesh; None for the first time, or if they are not compact."""
    if len(mesh.triangles) < LEAST or mesh not in _SWEPT:
        _SWEPT.add(mesh)
        return None
    if mesh not in _KNOWN:
        found = Clusters.of(mesh)
        _KNOWN[mesh] = found if found.are_compact else None
    return _KNOWN[mesh]


def _surface(half: Floats) -> Floats:
    """Return an eighth of the surfaces of boxes, given half of their sides, (3, ...)."""
    x, y, z = half
    return x * y + y * z + z * x
