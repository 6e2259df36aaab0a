"""Divides the triangles of a large mesh into clusters, each with a box in object space.

A cluster that is out of view, or behind what is in front, is left out before any vertex of it is
projected (`clustered.py`). Clusters are kept as long as their mesh, and shared by all its pictures
and instances. A single picture would take longer with them than without: they are made when a mesh
is swept for the second time.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce
from weakref import WeakKeyDictionary

import numpy as np

from ...arrays import Colors, Floats, Index, Integers
from ...scene import Mesh
from ...tracer.vector import largest

SIZE = 256  # triangles of a cluster
LEAST = 1 << 13  # triangles of a mesh that has clusters
_OWN = 3.0  # by how much boxes in the mesh's own order may be larger
_CELLS = 1 << 10  # along the longest side of a mesh; their numbers have 30 bits


@dataclass(frozen=True, eq=False)
class Clusters:
    """The n triangles of a mesh in k clusters.

    Those of cluster i are `order[SIZE * i : SIZE * (i + 1)]`. `bounds` (2, 3, k) are the lowest and
    highest coordinates of their vertices, in object space. `places` (3 corners, 3, k, SIZE) are
    those of the triangles' vertices, in float32; the last cluster may be filled up.
    """

    order: Integers
    bounds: Floats
    places: Colors

    @classmethod
    def of(cls, mesh: Mesh) -> Clusters:
        """Return clusters in the mesh's own order, or along a curve where their boxes are smaller.

        Neighbours often follow one another in a mesh, and then its own order is the better one.
        """
        vertices = mesh.vertices.T.copy()
        corners = mesh.triangles.T.astype(np.intp, order="C")
        own = cls._in_order(vertices, corners, np.arange(corners.shape[1], dtype=np.int32))
        sorted_ = cls._in_order(vertices, corners, _along_curve(mesh, vertices, corners[0]))
        return own if own._size <= _OWN * sorted_._size else sorted_

    @classmethod
    def _in_order(cls, vertices: Floats, corners: Index, order: Integers) -> Clusters:
        starts = np.arange(0, len(order), SIZE)
        bounds = np.empty((2, 3, len(starts)))
        places = np.zeros((3, 3, SIZE * len(starts)), np.float32)
        corners = corners.take(order, axis=1)
        for axis, along in enumerate(vertices):
            at = [along.take(corner) for corner in corners]
            bounds[0, axis] = np.minimum.reduceat(reduce(np.minimum, at), starts)
            bounds[1, axis] = np.maximum.reduceat(largest(*at), starts)
            places[:, axis, : len(order)] = at
        return cls(order, bounds, places.reshape(3, 3, -1, SIZE))

    @property
    def _size(self) -> float:
        """Half the surface of all boxes."""
        x, y, z = self.bounds[1] - self.bounds[0]
        return float((x * y + y * z + z * x).sum())

    def __len__(self) -> int:
        return self.bounds.shape[-1]

    def triangles(self, clusters: Index, some: Index | None = None) -> Integers:
        """Return the triangles of clusters, one cluster after the other; or `some` of these."""
        if some is None:
            some = np.arange(SIZE * len(clusters))
        at = SIZE * clusters.take(some // SIZE) + some % SIZE
        return self.order.take(at[at < len(self.order)])


_KNOWN: WeakKeyDictionary[Mesh, Clusters | None] = WeakKeyDictionary()


def clusters_of(mesh: Mesh) -> Clusters | None:
    """Return the clusters of a mesh; None if it is small, or for the first time."""
    if len(mesh.triangles) < LEAST:
        return None
    if mesh not in _KNOWN:
        return _KNOWN.setdefault(mesh)
    found = _KNOWN[mesh] or Clusters.of(mesh)
    _KNOWN[mesh] = found
    return found


def _along_curve(mesh: Mesh, vertices: Floats, first: Index) -> Integers:
    """Return the order of triangles along a curve through their first vertices, (n,).

    Reference: Morton, "A computer oriented geodetic data base", 1966.
    """
    low, high = mesh.bounds
    scale = _CELLS / np.nextafter((high - low).max(), np.inf)
    number = np.arange(_CELLS, dtype=np.uint32)
    apart = np.zeros_like(number)
    for bit in range(10):
        apart |= (number >> bit & 1) << 3 * bit
    curve = np.zeros(vertices.shape[1], np.uint32)
    for axis, along in enumerate(vertices):
        cell = np.nan_to_num((along - low[axis]) * scale)  # the sides of a huge mesh overflow
        cell = cell.clip(0, _CELLS - 1).astype(np.intp)
        curve |= apart.take(cell) << axis
    curve = curve.take(first)
    # numpy sorts 16 bits at a time several times as fast as more.
    order = np.argsort(curve.astype(np.uint16), kind="stable").astype(np.int32)
    upper = (curve >> 16).astype(np.uint16).take(order)
    return order.take(np.argsort(upper, kind="stable"))
