"""Finds out whether colours lie in the convex hull of others.

The nearest point of a hull is found by pairwise steps of Frank and Wolfe's algorithm: weight goes
from the colour that is farthest behind to the one that is farthest ahead.

References
----------
Lacoste-Julien and Jaggi, "On the global linear convergence of Frank-Wolfe optimization variants",
2015.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from ..arrays import Array, Bools, Floats, Places
from ..tracer.progress import Work

DISTINCT = 16  # colours, at most, for all triples to be tried
ITERATIONS = 400  # of Frank and Wolfe: two colours need one, three a few, some very many
STEP = 1 << 18  # numbers, of all points, that one iteration takes


def in_hull(target: Floats, points: Floats, allowed: Floats) -> Work[Bools]:
    """Return which targets (n, c) lie within `allowed` (n,) of the hull of points (k, n, c).

    A target is surely outside once a plane lies between. If colours lie almost on a line, the
    iterations move little: then all pairs and triples of the colours are tried.
    """
    found = np.zeros(len(target), bool)
    left = np.arange(len(target))  # the targets that are not decided yet
    nearest = np.argmin(((points - target) ** 2).sum(axis=-1), axis=0)
    at, all_points = points[nearest, left], points
    weight = np.zeros(points.shape[:2])
    weight[nearest, left] = 1
    for _ in range(ITERATIONS):
        yield None
        way = target[left] - at
        length = np.sqrt((way**2).sum(axis=-1))
        near = length <= allowed[left]
        found[left[near]] = True
        ahead, behind, share, beyond = _pair(points, weight, way, at)
        index = np.arange(len(left))
        at = at + share[:, None] * (points[ahead, index] - points[behind, index])
        weight[ahead, index] += share
        weight[behind, index] -= share
        open_ = ~near & (beyond <= allowed[left] * length)
        if not open_.any():
            return found
        if not open_.all():
            left = left[open_]
            at = at[open_]
            points = points[:, open_]
            weight = weight[:, open_]
    for n in left:
        distinct = np.unique(all_points[:, n], axis=0)[:DISTINCT]
        found[n] = distance_to_triangles(target[n], distinct) <= allowed[n]
        yield None
    return found


def _pair(
    points: Array, weight: Array, way: Array, at: Array
) -> tuple[Places, Places, Floats, Floats]:
    """Return the points farthest ahead and behind on the way from `at` to the target, (n,) each.

    Also how much weight to move between them, and how far the target lies beyond the farthest
    point, times the length of the way.
    """
    score = np.einsum("knc,nc->kn", points, way)
    ahead = np.argmax(score, axis=0)
    behind = np.argmin(np.where(weight > 0, score, np.inf), axis=0)
    index = np.arange(len(way))
    beyond = (way * (at + way)).sum(axis=-1) - score[ahead, index]
    step = points[ahead, index] - points[behind, index]
    size = (step**2).sum(axis=-1)
    share = (way * step).sum(axis=-1) / np.where(size > 0, size, 1)
    return ahead, behind, np.clip(share, 0, weight[behind, index]), beyond


def distance_to_triangles(target: Floats, points: Floats) -> float:
    """Return how far a colour (c,) is from the nearest point, side or triangle of points (k, c)."""
    least = np.min(np.linalg.norm(points - target, axis=1))
    for corners in (2, 3):
        if len(points) < corners:
            break
        index = np.array(list(combinations(range(len(points)), corners)))
        first, sides = points[index[:, 0]], points[index[:, 1:]] - points[index[:, :1]]
        share = np.einsum("tij,tj->ti", np.linalg.pinv(sides.swapaxes(1, 2)), target - first)
        inside = (share >= 0).all(axis=1) & (share.sum(axis=1) <= 1)
        foot = first + np.einsum("ti,tij->tj", share, sides)
        away = np.linalg.norm(foot - target, axis=1)
        least = np.min(away[inside], initial=least)
    return float(least)
