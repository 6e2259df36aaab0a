"""Finds points of faces on the film: none of it has to be exact."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ..arrays import Floats, Index
from ..tracer.vector import cross, dot
from .faces import EDGES, Faces

_ROOM = 1e-9  # of lines that meet, relative: to be taken for within, too


def points_of(faces: Faces, face: Index, low: Floats, high: Floats) -> Floats:
    """Return the middle of each face (n,) in its box from `low` to `high`, (2, n)."""
    v = faces.vertices
    corners = faces.corners[:, face]
    w = v.w[corners]
    at = np.stack((v.p[corners] - low[0] * w, v.q[corners] - low[1] * w, w), axis=1)
    edges = np.stack([cross(at[i], at[j]) for i, j in EDGES])
    edges *= np.sign(dot(at[0], edges[0]))
    zero, one = np.zeros_like(low[0]), np.ones_like(low[0])
    width, height = high - low
    sides = [(one, zero, zero), (-one, zero, width), (zero, one, zero), (zero, -one, height)]
    lines = np.concatenate((edges, np.array(sides)))  # b x + c y + a: (7, b c a, n)
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
    middle = np.nansum(points, axis=0) / np.maximum(known.sum(axis=0), 1)
    return np.clip(low + middle, low, high)
