"""Cuts the faces of a file into triangles, and checks the cut.

A face of four corners is cut from its first to its third, unless its triangles would then face
different ways; one that turns left at each corner as Blender cuts it; and any other by the library
mapbox_earcut, as it is seen along its normal. Whatever cut it, no triangle may face away from the
polygon, and their areas must add up to the polygon's: then they cover it once, and nothing beside
it. Else the face is refused.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np
from reference_tracer.arrays import Array, Bools, Floats, Index, Places
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.scene import SceneError
from reference_tracer.tracer.vector import cross, dot
from reference_tracer.wording import count_of

_AT_ONCE = 1 << 16  # faces: bounds the memory that they take meanwhile
_UNIT = 2.0**-53
# Of a doubled area whose corners are at most 1 and off by a unit each: a difference is off by 4
# units, of at most 2; its product with another by 16 + 4 units, and two of them and their own
# difference by 48 units and less than 1 of second order.
_AREA = 64 * _UNIT
# What programs round a coordinate to: six digits after the point, or float32.
_DECIMALS, _DIGITS = 5e-7, 2.0**-24
_MOST = 1 << 16  # corners of a face that is not convex: the library takes up to three seconds
_SEEN = 1e-3  # what is more than this share of a face's size is no rounding, however it came


class Cut(NamedTuple):
    """The triangles of a file's faces, and what is to be said of these."""

    triangles: Places  # (t, 3) indices of vertices
    faces: Places  # (t,) the face that each triangle is of, ascending
    notes: tuple[str, ...]
    missing: tuple[str, ...]  # as of `Contents`


@np.errstate(all="ignore")  # what is too large is halved; what has no normal is a line, or crosses
def cut(vertices: Floats, corners: Index, sizes: Index) -> Cut:
    """Cut faces into triangles.

    Parameters
    ----------
    vertices : (v, 3) float32 or float64
    corners : (c,) int
        The indices of vertices of all faces, one face after the other, in range.
    sizes : (f,) int
        The number of corners of each face.

    Raises
    ------
    SceneError
        If a face cannot be cut so that its triangles cover it once.
    MissingLibraryError
        If a face takes mapbox_earcut, and it is not installed.
    """
    starts = np.cumsum(sizes) - sizes
    infinite = np.zeros(len(sizes), bool)
    off = ~np.isfinite(vertices).all(axis=1)
    infinite[np.repeat(np.arange(len(sizes)), sizes)[off[corners]]] = True
    triangles, faces = [np.zeros((0, 3), np.intp)], [np.zeros(0, np.intp)]
    bends: list[Floats] = [np.zeros((2, 0))]
    for size in np.unique(sizes[sizes > 2]).tolist():
        which = np.flatnonzero((sizes == size) & ~infinite)
        for some in np.split(which, range(_AT_ONCE, len(which), _AT_ONCE)):
            own = corners[starts[some][:, None] + np.arange(size)]
            for k, parts in _parts(some, vertices.T[:, own], bends):
                triangles.append(own[k[:, None, None], parts].reshape(-1, 3))
                faces.append(np.repeat(some[k], parts.shape[1]))
    found = np.concatenate(faces)
    order = np.argsort(found, kind="stable")
    small, away = (np.flatnonzero(b) for b in ((sizes < 3) & ~infinite, infinite))
    few = _of(small, "with fewer than three corners: what has no surface meets no ray")
    missing = _of(away, "with a corner that is no finite number: left out")
    notes = *few, *_of_bends(bends)
    return Cut(np.concatenate(triangles)[order], found[order], notes, tuple(missing))


def _of(faces: Index, what: str) -> Iterator[str]:
    """Say how many faces are something, and which is the first of them, counted from 1."""
    if len(faces):
        head, tail = what.split(":")
        yield f"{count_of(len(faces), 'face')} {head}, the first is face {faces[0] + 1}:{tail}"


def _parts(faces: Places, points: Floats, bends: list[Floats]) -> Iterator[tuple[Places, Array]]:
    """Yield which of some faces (3, k, n), and their triangles (j, m, 3) as numbers of corners.

    How far those that are not flat are from it is appended to `bends`, (2, k): metres, and shares
    of their sizes.
    """
    every, count = np.arange(len(faces)), points.shape[2]
    if count == 3:
        yield every, np.arange(3)[None, None]
        return
    points = points.astype(np.float64)
    at = _local(points)
    normal = cross(at[..., 1:-1], at[..., 2:]).sum(axis=-1)  # Newell's
    rounding = _rounding(points, at, normal, bends)
    if count == 4:
        yield every, _quads(faces, at, normal, rounding)
        return
    convex = _are_convex(at, normal)
    yield every[convex], _of_convex(count)[None]
    for k in every[~convex]:
        yield every[k : k + 1], _by_library(faces[k] + 1, at[:, k], normal[:, k], rounding[k])[None]


def _local(points: Floats) -> Floats:
    """Return the corners of faces (3, k, n) from the first of each, scaled to be at most 1.

    By a power of two, so that each is off by the rounding of one difference.
    """
    out = points - points[..., :1]
    if not np.isfinite(out).all():
        out = points / 2 - points[..., :1] / 2
    largest = np.abs(out).max(axis=(0, 2))[:, None]
    return np.ldexp(out, -np.frexp(largest)[1])


def _quads(faces: Places, at: Floats, normal: Floats, rounding: Floats) -> Array:
    """Return the triangles (k, 2, 3) of faces of four corners.

    Blender's rule (`is_quad_flip_v3_first_third_fast`): the diagonal is that of the corners 0 and 2
    unless the normals of its triangles are more than a right angle apart.
    """
    first, second = (_facing(at, order) for order in ((0, 1, 2, 3), (1, 2, 3, 0)))
    turning, bound = _turning(at, normal)
    bound += 8 * rounding * np.sqrt(dot(normal, normal))  # as the file's numbers are rounded
    flat = dot(normal, normal) <= bound  # both halves cancel one another
    wrong = ((turning < -bound[:, None]).sum(axis=1) > 1) | (flat & (first < 0) & (second < 0))
    if wrong.any():
        raise _crosses(faces[np.argmax(wrong)] + 1)
    return np.where((first < 0)[:, None, None], [[0, 1, 3], [1, 2, 3]], [[0, 1, 2], [0, 2, 3]])


def _facing(at: Floats, order: tuple[int, ...]) -> Floats:
    """Return the scalar product (k,) of the two normals on a diagonal."""
    a, b, c, d = (at[..., k] for k in order)
    return dot(cross(b - a, c - a), cross(c - a, d - a))


def _turning(at: Floats, normal: Floats) -> tuple[Floats, Floats]:
    """Return how far faces (3, k, n) turn left at each corner, (k, n), and its bound (k,).

    As seen along their normals. With corners of at most 1, off by a unit each, a normal is off by
    8n + 2n^2 units; its product with a cross product of two edges, whose components are at most 8,
    by 24 times that, and by 96 units of the normal itself.
    """
    n = at.shape[2]
    edges = np.roll(at, -1, axis=2) - at
    turning = dot(cross(np.roll(edges, 1, axis=2), edges), normal[..., None])
    return turning, _UNIT * (96 * np.abs(normal).sum(axis=0) + 200 * n + 50 * n * n)


def _are_convex(at: Floats, normal: Floats) -> Bools:
    """Return which faces (3, k, n) surely turn left at each corner, and go round once."""
    turning, bound = _turning(at, normal)
    along = normal[..., None]
    edges = np.roll(at, -1, axis=2) - at
    before = np.roll(edges, 1, axis=2)
    square = dot(along, along)
    ahead = dot(before, edges) - dot(before, along) * dot(edges, along) / square
    angles = np.arctan2(turning, ahead * np.sqrt(square))
    once = np.round(angles.sum(axis=1) / (2 * np.pi)) == 1
    return (turning > bound[:, None]).all(axis=1) & once


@cache
def _of_convex(count: int) -> Array:
    """Return the triangles (n - 2, 3) of a convex polygon, in the order of Blender's ears.

    Each ear is next to the one after the last (`polyfill_2d.c`).
    """
    left, tip = list(range(count)), 0
    out = []
    while len(left) > 3:
        out.append((left[tip - 1], left[tip], left[(tip + 1) % len(left)]))
        del left[tip]
        tip = (tip + 1) % len(left)
    out.append((left[0], left[1], left[2]))
    return np.array(out)


def _by_library(face: int, at: Floats, normal: Floats, rounding: float) -> Array:
    """Return the triangles (n - 2, 3) of a polygon (3, n) by mapbox_earcut, checked."""
    try:
        from mapbox_earcut import triangulate_float64
    except ImportError:
        raise MissingLibraryError(
            f"face {face} is not convex, and to cut it takes the library mapbox_earcut: "
            'pip install "reference_tracer[meshes]"'
        ) from None
    if at.shape[1] > _MOST:
        raise SceneError(f"face {face} has {at.shape[1]:,} corners: cut it where it was made")
    axis = int(np.argmax(np.abs(normal)))
    seen = at[[(axis + 1) % 3, (axis + 2) % 3]]  # along the axis nearest to the normal
    seen = seen if normal[axis] >= 0 else seen[::-1]
    count = seen.shape[1]
    ends = np.array([count], np.uint32)
    found = triangulate_float64(np.ascontiguousarray(seen.T), ends).reshape(-1, 3).astype(np.intp)
    p, q, r = seen[:, found.T].swapaxes(0, 1)
    areas = (q - p)[0] * (r - p)[1] - (q - p)[1] * (r - p)[0]
    if areas.sum() < 0:  # the library winds all triangles one way, and says not which
        found, areas = found[:, ::-1], -areas
    own = (seen[0] * np.roll(seen[1], -1) - np.roll(seen[0], -1) * seen[1]).sum()
    # What rounding does to a doubled area: ours, and the file's of corners whose sides are below 3.
    bound = _AREA + 8 * rounding
    far = at[:, np.argmax(np.abs(at).max(axis=0))]
    is_line = bool(np.abs(cross(at, far[:, None])).max() <= bound)
    if (areas < -bound).any() or abs(areas.sum() - own) > count * bound or (own <= 0) > is_line:
        raise _crosses(face)
    return found


def _crosses(face: int) -> SceneError:
    return SceneError(
        f"the edges of face {face} cross, so programs fill it differently: cut it into triangles "
        "where it was made"
    )


def _rounding(points: Floats, at: Floats, normal: Floats, bends: list[Floats]) -> Floats:
    """Return how far faces (3, k, n) may be rounded, (k,) in sizes of each; note which are bent."""
    largest = np.abs(points).max(axis=(0, 2))
    unit = normal / np.sqrt(dot(normal, normal))
    middle = at.mean(axis=2, keepdims=True)
    away = np.abs(dot(at - middle, unit[..., None])).max(axis=1)
    spans, own = np.ptp(at, axis=2), np.ptp(points, axis=2)
    share = away / np.sqrt(dot(spans, spans))
    size = np.sqrt(dot(own, own))
    rounding = np.minimum(4 * (_DECIMALS + _DIGITS * largest) / size, _SEEN)
    bends.append(np.stack((share * size, share))[:, share > rounding])
    return np.nan_to_num(rounding, nan=_SEEN)


def _of_bends(bends: list[Floats]) -> Iterator[str]:
    """Say how far faces are not flat, if any are."""
    metres, shares = np.concatenate(bends, axis=1)
    if len(shares):
        many = "of more than three corners"
        are = count_of(len(shares), f"face {many} is", f"faces {many} are")
        yield (
            f"{are} not flat, by {metres.max():.2g} m or {100 * shares.max():.2g} % of their size "
            "at most: a program that cuts faces along other diagonals than Blender shows another "
            "surface"
        )
