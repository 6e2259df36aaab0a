"""Decides whether faces before a face hide all of it, in exact signs.

Let U be the part of the film within the face F, and in a box. Take some faces S, each nearer than F
wherever a ray meets both. If a part of U is covered by S and another is not, the two meet along a
piece of an edge e of a face of S, and the uncovered part lies on the other side of e than the face
does. So S covers all of U if it covers one ray of U, and if on each edge e that reaches into U
almost every point is covered by S on its other side, too. That is how often intervals cover an
interval: along e, a face of S begins and ends where e crosses its edges or meets its corners. Where
the same edge or corner ends one and begins another, they meet exactly, however roughly its place is
known; others begin later and end earlier, by their errors.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Index
from .faces import EDGES, Faces

THROUGH = 2  # an edge crosses a face
_STEPS = 8  # from face to face, that a patch may need
_FIRST, _LAST = np.array(EDGES).T


def patches(faces: Faces, base: Index, at: Floats, low: Floats, high: Floats) -> Floats:
    """Return how near at least what covers n boxes is, -inf if they may not be covered.

    By `base` (n,), which a ray in the box sees, at film positions (2, n), and by what continues it
    over the edges that reach into the box. How often those faces cover a ray changes nowhere there:
    where one ends, another one begins.
    """
    out = np.where(faces.within(base, at, at).inside.all(axis=0), np.inf, -np.inf)
    box = np.flatnonzero(out > 0)
    own = base[box]
    known = box * faces.count + own
    for _ in range(_STEPS):
        found = faces.within(own, low[:, box], high[:, box])
        good = faces.clip.inside(found.least, found.most)
        least = np.where(good, found.least, -np.inf)
        np.minimum.at(out, box, np.where(found.beside, np.inf, least))
        k, row = np.nonzero(~found.inside & ~found.beside)
        edge, box = k * faces.count + own[row], box[row]
        first, last = faces.box(edge)
        met = ((first <= high[:, box]) & (last >= low[:, box])).all(axis=0)
        other = faces.beyond(edge[met])
        box = box[met]
        out[box[other < 0]] = -np.inf
        new = np.unique((box * faces.count + other)[out[box] > -np.inf])
        new = np.setdiff1d(new, known, assume_unique=True)
        if not len(new):
            return out
        known = np.concatenate((known, new))
        box, own = np.divmod(new, faces.count)
    out[box] = -np.inf
    return out


def crossed(faces: Faces, edge: Index, face: Index) -> tuple[Index, Floats]:
    """Find where edges (n,) are within faces (n,), as the camera sees them.

    The plane of the eye and an edge e cuts the triangle along a wedge, if it cuts it. Its ends are
    on those of its edges whose ends are on both sides of e; and they are met within e where the
    ends of e are on both sides of them.

    Returns
    -------
    side : (n,) int
        THROUGH; or of an edge that lies along one of the face's the face's side, 1 or -1; else 0.
    ends : (2, 3, n) float64
        Where they begin and end, from 0 at the edge's first vertex to 1 at its last; the error of
        that; and a number of the edge or corner that is met there, NaN for none.
    """
    first, last = faces.ends.take(edge, axis=1)
    corners = faces.corners[:, face]
    beside = faces.signs(first, last, corners).sign
    side = np.where((beside == 0).sum(axis=0) == 2, beside.sum(axis=0), 0)
    side[(beside > 0).any(axis=0) & (beside < 0).any(axis=0)] = THROUGH
    i, j = beside[_FIRST], beside[_LAST]
    k, row = np.nonzero((side != 0) & (i * j <= 0) & (i != j))
    own = k * faces.count + face[row]
    a, b = (faces.inside(own, end[row]) for end in (first, last))
    shown = faces.shown[np.stack([corners[ends[k], row] for ends in (_FIRST, _LAST)])]
    name = shown.min(axis=0) * len(faces.shown) + shown.max(axis=0)
    for corner, place in zip((_FIRST[k], _LAST[k]), shown, strict=True):
        name = np.where(beside[corner, row] == 0, -1 - place, name)
    apart = a.value - b.value
    error = (a.error + b.error) * 4 / np.abs(apart) + 2.0**-50
    known = np.isfinite(error)
    found = np.stack((np.where(known, a.value / apart, 0.5), np.where(known, error, np.inf), name))
    ends = np.full((2, 3, len(edge)), np.nan)
    for number, sign in enumerate((-1, 1)):
        here = (a.sign == sign) & (b.sign == -sign)
        ends[number][:, row[here]] = found[:, here]
    side[row[(a.sign <= 0) & (b.sign <= 0)]] = 0
    return side, ends


def nearer(faces: Faces, own: Index, other: Index, low: Floats, high: Floats) -> Bools:
    """Return which faces `own` surely are in the clip range, and before `other` where both are met.

    All of that in boxes from `low` to `high` of the film, (2, n) each.
    """
    out = (faces.turn[own] != 0) & (own != other)
    rows = np.flatnonzero(out & ~faces.in_clip[own])
    found = faces.within(own[rows], low[:, rows], high[:, rows])
    out[rows] = faces.clip.inside(found.least, found.most)
    rows = np.flatnonzero(out & ~(faces.far[own] < faces.near[other]))
    out[rows] = _before(faces, own[rows], other[rows])
    return out


def _before(faces: Faces, own: Index, other: Index) -> Bools:
    """Return which faces are not behind others where a ray meets both.

    On the film their nearness differs linearly. So it is enough to know in the corners of what they
    have in common: corners of one that are within the other one, and where their edges cross. Of
    faces in one plane the first is seen.
    """
    corners, others = faces.corners[:, own], faces.corners[:, other]
    edges = np.arange(3)[:, None, None] * faces.count
    inside = faces.inside(edges + own, others).sign  # by edge and corner, (3, 3, n)
    outside = faces.inside(edges + other, corners).sign
    rows = []
    nearer = []
    for face, points, within, sense in ((own, others, inside, -1), (other, corners, outside, 1)):
        k, row = np.nonzero((within >= 0).all(axis=0))
        rows.append(row)
        nearer.append(faces.height(face[row], points[k, row]).sign * sense)
    p, q = inside[:, _FIRST], inside[:, _LAST]
    i, j = (outside[:, ends].swapaxes(0, 1) for ends in (_FIRST, _LAST))
    k, e, row = np.nonzero((p * q <= 0) & (p != q) & (i * j <= 0) & (i != j))
    ends = others[_FIRST[e], row], others[_LAST[e], row]
    side = faces.signs(*ends, corners[_FIRST[k], row], corners[_LAST[k], row]).sign
    i, j = i[k, e, row], j[k, e, row]
    rows.append(row)
    nearer.append(side * np.where(i != 0, i, -j) * faces.turn[other[row]])
    row, sign = np.concatenate(rows), np.concatenate(nearer)
    flat = np.ones(len(own), bool)
    flat[row[sign != 0]] = False
    out = ~flat | (own < other)
    out[row[sign < 0]] = False
    return out
