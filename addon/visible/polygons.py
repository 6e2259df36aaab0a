"""Finds points of convex parts of the film, and their areas: none of it has to be exact.

A face is a little larger here, by what bounds its error, so that no area is too small.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ..arrays import Floats, Index
from .faces import Faces
from .hiding import Cells

_BESIDE = 2.0**-24  # pixels from an edge in the way, where a ray looks past it
_ROOM = 1e-9  # of lines that meet, relative: to be taken for within, too


def in_cells(
    faces: Faces, face: Index, cells: Cells, edge: Index | None = None
) -> tuple[Floats, Floats]:
    """Return a point of each face in its cell, (2, n), and the area of that part, (n,).

    `edge` (n,), as k m + f: only what is just beyond that edge of another face.
    """
    width, height = cells.high - cells.low
    zero, one = np.zeros_like(width), np.ones_like(width)
    own = faces.lines(face)  # (a b c, 3, n)
    own[0] += 2 * faces.edge_error[face]
    lines = [own.swapaxes(0, 1)]
    if edge is not None:
        k, other = np.divmod(edge, faces.count)
        faces.need(other)
        beyond = np.take_along_axis(faces.lines(other), k[None, None], axis=1)[:, 0]
        beyond = -beyond / np.hypot(beyond[1], beyond[2])
        strip = np.stack((beyond, -beyond))
        strip[0, 0] -= _BESIDE
        strip[1, 0] += 2 * _BESIDE
        lines.append(strip)
    x, y = cells.low
    for each in lines:
        each[:, 0] += each[:, 1] * x + each[:, 2] * y
    sides = [(zero, one, zero), (width, -one, zero), (zero, zero, one), (height, zero, -one)]
    points, area = _corners(np.concatenate((*lines, np.array(sides))))
    middle = np.where(area > 0, points, np.stack((width, height)) / 2)
    return np.clip(cells.low + middle, cells.low, cells.high), area


def _corners(lines: Floats) -> tuple[Floats, Floats]:
    """Return the middle and the area of what is within k lines, a + b x + c y >= 0: (k, 3, n)."""
    size = np.abs(lines[:, 1:]).max(axis=1)
    lines = lines / np.where(size > 0, size, 1)[:, None]
    points = []
    for i, j in combinations(range(len(lines)), 2):
        (a, b, c), (d, e, f) = lines[i], lines[j]
        turn = b * f - c * e
        x, y = (c * d - a * f) / turn, (a * e - b * d) / turn
        rest = [k for k in range(len(lines)) if k not in (i, j)]
        value = lines[rest, 0] + lines[rest, 1] * x + lines[rest, 2] * y
        room = _ROOM * np.abs(lines[-3, 0] + lines[-1, 0])
        inside = (value >= -room).all(axis=0) & np.isfinite(x) & np.isfinite(y)
        points.append(np.where(inside, (x, y), np.nan))
    found = np.stack(points)  # (pairs, 2, n)
    middle = np.nansum(found, axis=0) / np.isfinite(found).sum(axis=0)
    away = found - middle
    order = np.argsort(np.arctan2(away[:, 1], away[:, 0]), axis=0)  # NaN comes last
    away = np.take_along_axis(away, order[:, None], axis=0)
    away = np.where(np.isnan(away), away[:1], away)
    after = np.roll(away, -1, axis=0)
    area = 0.5 * (away[:, 0] * after[:, 1] - away[:, 1] * after[:, 0]).sum(axis=0)
    return middle, np.nan_to_num(np.abs(area))
