"""What all readers do with the faces of a file: they are cut, and shared out to objects."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Floats, Index
from ..scene import Mesh
from .contents import Contents, Placed
from .polygons import cut


def contents(
    vertices: Floats,
    corners: Index,
    sizes: Index,
    names: Sequence[str],
    objects: Index | None = None,
    notes: Sequence[str] = (),
    missing: Sequence[str] = (),
) -> Contents:
    """Return a mesh for each object that has triangles.

    Parameters
    ----------
    vertices : (v, 3) float32 or float64
    corners : (c,) int
        The indices of vertices of all faces, one face after the other.
    sizes : (f,) int
        The number of corners of each face.
    names : (o,) str
        The objects' names.
    objects : (f,) int, optional
        Which object each face is of; by default all are the first's.
    notes, missing : (n,) str
        As of `Contents`.

    Raises
    ------
    ValueError
        If an index is out of range.
    """
    wrong = np.flatnonzero((corners < 0) | (corners >= len(vertices)))
    if len(wrong):
        face = np.searchsorted(np.cumsum(sizes), wrong[0], "right") + 1
        raise ValueError(
            f"face {face} names vertex {corners[wrong[0]]} of {len(vertices)}, counted from 0"
        )
    parts = cut(vertices, corners, sizes)
    placed = []
    of_object = np.zeros(len(sizes), np.intp) if objects is None else np.asarray(objects)
    of_triangle = of_object[parts.faces]
    for number, name in enumerate(names):
        own = parts.triangles if len(names) == 1 else parts.triangles[of_triangle == number]
        if len(own):
            placed.append(Placed(_mesh(vertices, own, name), np.eye(4), name))
    return Contents(tuple(placed), (*notes, *parts.notes), (*missing, *parts.missing))


def _mesh(vertices: Floats, triangles: Index, name: str) -> Mesh:
    """Return a mesh of the vertices that its triangles use, in their order."""
    is_used = np.zeros(len(vertices), bool)
    is_used[triangles] = True
    return Mesh(vertices[is_used], (np.cumsum(is_used) - 1)[triangles], name=name)
