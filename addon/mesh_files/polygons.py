"""Cuts the faces of a file into triangles by their own shape, as Blender does.

A face of four corners is cut from its first to its third, unless its triangles would then face
different ways; one of more corners by clipping ears of what is seen along its normal. Faces that
are convex for certain are cut all at once, as where their ears are does not depend on their shape.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..arrays import Array, Bools, Floats, Index, Places
from ..tracer.vector import cross, dot
from ..wording import count_of
from . import planar
from .ears import ears, of_convex
from .flatness import Bends
from .planar import Planar
from .scaling import local, normals

_AT_ONCE = 1 << 16  # faces: bounds the memory that they take meanwhile
_UNIT = 2.0**-53
# The scalar product of a quad's two normals, with corners of at most 1 that are off by a unit: a
# difference is off by 4 units, of at most 2; a component of a normal by 48 units, of at most 8; and
# the product by 3 * (2 * 8 * 48 + 64) + 2 * 192 units, and less than 100 of second order.
_QUAD_BOUND = 4096 * _UNIT


class Cut(NamedTuple):
    """The triangles of a file's faces, and what is to be said of these."""

    triangles: Places  # (t, 3) indices of vertices
    faces: Places  # (t,) the face that each triangle is of, ascending
    notes: tuple[str, ...]
    missing: tuple[str, ...]  # as of `Contents`


def cut(vertices: Floats, corners: Index, sizes: Index) -> Cut:
    """Cut faces into triangles.

    Parameters
    ----------
    vertices : (v, 3) float32 or float64
    corners : (c,) int
        The indices of vertices of all faces, one face after the other, in range.
    sizes : (f,) int
        The number of corners of each face.
    """
    starts = np.cumsum(sizes) - sizes
    finite = np.isfinite(vertices).all(axis=1)
    bad = np.add.reduceat(~finite[corners], starts[sizes > 0]) if len(corners) else np.array([])
    infinite = np.zeros(len(sizes), bool)
    infinite[sizes > 0] = bad > 0
    found = _Found(Bends(vertices), infinite, (sizes < 3) & ~infinite)
    for size in np.unique(sizes[sizes > 2]):
        which = np.flatnonzero((sizes == size) & ~infinite)
        for some in np.split(which, range(_AT_ONCE, len(which), _AT_ONCE)):
            own = corners[starts[some][:, None] + np.arange(size)]
            found.add(some, own, vertices)
    return found.cut()


class _Found:
    """What the faces have given so far."""

    def __init__(self, bends: Bends, infinite: Bools, small: Bools) -> None:
        self.bends = bends
        self.infinite = infinite  # (f,) which faces have a corner that is no number
        self.small = small  # (f,) which have fewer than three corners
        self.triangles: list[Places] = [np.zeros((0, 3), np.intp)]
        self.faces: list[Places] = [np.zeros(0, np.intp)]
        self.crossing: list[int] = []

    def add(self, faces: Places, corners: Index, vertices: Floats) -> None:
        """Cut faces, by their numbers (k,), of equally many corners (k, n)."""
        size = corners.shape[1]
        if size == 3:
            self._keep(faces, corners[:, None])
            return
        points = vertices.T[:, corners].astype(np.float64)
        self.bends.add(points)
        if size == 4:
            parts, crossing = _quads(points)
            self._keep(faces, np.take_along_axis(corners[:, None], parts, axis=2))
            self.crossing += faces[crossing].tolist()
            return
        convex = _are_convex(points)
        self._keep(faces[convex], corners[convex][:, np.array(of_convex(size))])
        with np.errstate(all="ignore"):
            rounding = self.bends.rounding(points) / np.ptp(points, axis=2).max(axis=0)
        for k in np.flatnonzero(~convex):
            ear_parts, is_right = ears(Planar(points[:, k].T), rounding[k])
            self._keep(faces[k : k + 1], corners[k][np.array(ear_parts)][None])
            self.crossing += [] if is_right else [int(faces[k])]

    def _keep(self, faces: Places, triangles: Array) -> None:
        """Keep the triangles (k, m, 3) of faces (k,)."""
        self.triangles.append(triangles.reshape(-1, 3))
        self.faces.append(np.repeat(faces, triangles.shape[1]))

    def cut(self) -> Cut:
        """Return it all, in the order of the faces."""
        faces = np.concatenate(self.faces)
        order = np.argsort(faces, kind="stable")
        triangles = np.concatenate(self.triangles)[order]
        missing = tuple(self._missing())
        return Cut(triangles, faces[order], tuple(self._notes()), missing)

    def _notes(self) -> Iterator[str]:
        if self.small.any():
            of = _faces(np.flatnonzero(self.small), "with fewer than three corners")
            yield f"{of}: what has no surface meets no ray"
        yield from self.bends.notes()

    def _missing(self) -> Iterator[str]:
        if self.infinite.any():
            which = np.flatnonzero(self.infinite)
            yield f"{_faces(which, 'with a corner that is no finite number')}: left out"
        if self.crossing:
            of = _faces(np.sort(self.crossing), "whose edges cross")
            yield f"{of}: programs fill them differently, and here they are cut as Blender does"


def _faces(which: Index, what: str) -> str:
    """Say how many faces are something, and which is the first of them, counted from 1."""
    return f"{count_of(len(which), 'face')} {what}, the first is face {which[0] + 1}"


def _quads(points: Floats) -> tuple[Places, Bools]:
    """Return the triangles (k, 2, 3) of faces (3, k, 4), and which cross themselves.

    Blender's rule (`is_quad_flip_v3_first_third_fast`): the diagonal is that of the corners 0 and 2
    unless the normals of its triangles are more than a right angle apart.
    """
    at = local(points)
    on_first, on_second = (_facing(at, points, order) for order in ((0, 1, 2, 3), (1, 2, 3, 0)))
    other = on_first < 0
    parts = np.where(other[:, None, None], [[0, 1, 3], [1, 2, 3]], [[0, 1, 2], [0, 2, 3]])
    return parts, other & (on_second < 0)


def _facing(at: Floats, points: Floats, order: tuple[int, ...]) -> Floats:
    """Return the sign (k,) of the scalar product of the two normals on a diagonal, exactly."""
    a, b, c, d = (at[..., k] for k in order)
    diagonal = c - a
    value = dot(cross(b - a, diagonal), cross(diagonal, d - a))
    out = np.sign(value)
    for k in np.flatnonzero(np.abs(value) <= _QUAD_BOUND):
        p, q, r, s = planar.integers(points[:, k, list(order)].T)
        span = planar.minus(r, p)
        first, second = planar.cross(planar.minus(q, p), span), planar.minus(s, p)
        out[k] = planar.sign(planar.dot(first, planar.cross(span, second)))
    return out


def _are_convex(points: Floats) -> Bools:
    """Return which faces (3, k, n) surely turn left at each corner, and go round once.

    As seen along their normals. With corners of at most 1, off by a unit each, a normal is off by
    8n + 2n^2 units; its product with a cross product of two edges, whose components are at most 8,
    by 24 times that, and by 96 units of the normal itself.
    """
    at = local(points)
    normal = normals(at)[..., None]
    edges = np.roll(at, -1, axis=2) - at
    before = np.roll(edges, 1, axis=2)
    turning = dot(cross(before, edges), normal)
    n = at.shape[2]
    bound = _UNIT * (96 * np.abs(normal).sum(axis=0) + 200 * n + 50 * n * n)
    sure = (turning > bound).all(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        square = dot(normal, normal)
        ahead = dot(before, edges) - dot(before, normal) * dot(edges, normal) / square
        angles = np.arctan2(turning, ahead * np.sqrt(square))
        return sure & (np.round(angles.sum(axis=1) / (2 * np.pi)) == 1)
