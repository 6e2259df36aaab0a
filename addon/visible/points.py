"""Finds points of faces on the film: none of it has to be exact."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ..arrays import Floats, Index
from ..tracer.vector import cross, dot
from .faces import EDGES, Faces

_ROOM = 1e-9  # of lines that meet, relative: to be taken for within, too
_TOWARDS = 0.9  # from the middle towards a corner


def points_of(
    faces: Faces, face: Index, other: Index, low: Floats, high: Floats, number: Index
) -> Floats:
    """Return a point of each face in its box, (2, n): the middle, or, by `number`, near a corner.

    Boxes are those from `low` to `high`, (2, n) each. Of the face, only what is before the plane of
    the `other` face (n,) counts, if that is not the same.
    """
    edges, near = _lines(faces, face, low)
    before = near - _lines(faces, other, low)[1]
    before[2, face == other] = 1.0
    zero, one = np.zeros_like(low[0]), np.ones_like(low[0])
    width, height = high - low
    sides = [(one, zero, zero), (-one, zero, width), (zero, one, zero), (zero, -one, height)]
    lines = np.concatenate((edges, np.array(sides), [before]))  # b x + c y + a: (8, b c a, n)
    lines = np.nan_to_num(lines)
    size = np.abs(lines[:, :2]).max(axis=1)
    lines /= np.where(size > 0, size, 1)[:, None]
    found = []
    for i, j in combinations(range(len(lines)), 2):
        x, y, scale = cross(lines[i], lines[j])
        x, y = x / scale, y / scale
        rest = np.delete(lines, (i, j), axis=0)
        value = rest[:, 0] * x + rest[:, 1] * y + rest[:, 2]
        inside = (value >= -_ROOM * (width + height)).all(axis=0)
        found.append(np.where(inside, (x, y), np.nan))
    points = np.stack(found)  # (pairs, 2, n)
    known = np.isfinite(points[:, 0])
    count = np.maximum(known.sum(axis=0), 1)
    middle = np.nansum(points, axis=0) / count
    rank = np.cumsum(known, axis=0) * known
    chosen = (rank == 1 + (number - 1) % count).argmax(axis=0)
    end = points[chosen, :, np.arange(len(face))].T
    towards = np.where(number > 0, _TOWARDS, 0.0)
    at = middle + np.where(np.isfinite(end), towards * (end - middle), 0)
    return np.clip(low + at, low, high)


def _lines(faces: Faces, face: Index, low: Floats) -> tuple[Floats, Floats]:
    """Return edge functions, (3, 3, n), and the nearness, (3, n), of x, y and 1 from `low`."""
    v = faces.vertices
    corners = faces.corners[:, face]
    w = v.w[corners]
    at = np.stack((v.p[corners] - low[0] * w, v.q[corners] - low[1] * w, w), axis=1)
    edges = np.stack([cross(at[i], at[j]) for i, j in EDGES])
    turn = dot(at[0], edges[0])
    parallel = faces.film.camera.projection.shares_direction
    size = -v.depth[corners] if parallel else np.ones_like(w)
    return edges * np.sign(turn), (edges * size[:, None]).sum(axis=0) / turn
