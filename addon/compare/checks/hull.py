"""Whether a colour lies in the convex hull of others: a filter's mix does.

Workbench mixes log2(1 + colour) in place of the colour: the hull of those is tried, too. The
nearest point of a hull is found by pairwise steps of Frank and Wolfe's algorithm (Lacoste-Julien
and Jaggi, "On the global linear convergence of Frank-Wolfe optimization variants", 2015): weight
goes from the colour that is farthest behind to the one that is farthest ahead.
"""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ...tracer.progress import Work

DISTINCT = 16  # colours of which each three are tried
ITERATIONS = 400  # of Frank and Wolfe: two colours need one, three a few, some an age
# A mix is stored in half floats after some twenty roundings, and its samples lie between ours.
NEAR = 2.0**-7
STEP = 1 << 18  # numbers of which a step's iterations may take so many in all, or one iteration


def is_mix(color: NDArray, mixed: NDArray, sums: int = 0) -> Work[NDArray[np.bool_]]:
    """Return which colours (n, c) lie in the convex hull of those of (k, n, c), or near it.

    Each of `sums` additions in half floats may lose as much as half a unit of every channel.
    """
    color, count = np.nan_to_num(color).astype(np.float64), len(color)
    allowed = (NEAR + sums * 2.0**-11) * np.maximum(1, np.abs(color).max(axis=-1, initial=0))
    found = np.zeros(count, bool)
    together = max(1, STEP * count // max(mixed.size, 1))
    for first in range(0, count, together):
        some = slice(first, first + together)
        points = mixed[:, some].astype(np.float64)
        found[some] = yield from in_hull(color[some], points, allowed[some])
        rest = np.flatnonzero(~found[some])
        logs = [np.log2(1 + np.maximum(v, 0)) for v in (color[some][rest], points[:, rest])]
        # A colour's own error is up to 1.44 times as large in the logarithm, itself a half float.
        found[first + rest] = yield from in_hull(*logs, 2 * allowed[some][rest])
        yield 0.0
    return found


def in_hull(
    target: NDArray[np.float64], points: NDArray[np.float64], allowed: NDArray[np.float64]
) -> Work[NDArray[np.bool_]]:
    """Return which targets (n, c) lie within `allowed` (n,) of the hull of points (k, n, c).

    A target is outside for sure once a plane lies between. Where colours lie almost on a line the
    iterations move little: then each two and three of the colours are tried.
    """
    found = np.zeros(len(target), bool)
    left = np.arange(len(target))  # those that are not decided yet
    nearest = np.argmin(((points - target) ** 2).sum(axis=-1), axis=0)
    at, all_points = points[nearest, left], points
    weight = np.zeros(points.shape[:2])
    weight[nearest, left] = 1
    worked = 0
    for _ in range(ITERATIONS):
        worked += points.size
        if worked > STEP:
            worked = 0
            yield 0.0
        way = target[left] - at
        length = np.sqrt((way**2).sum(axis=-1))
        near = length <= allowed[left]
        found[left[near]] = True
        ahead, behind, share, beyond = _pair(points, weight, way, at)
        keep = np.flatnonzero(~near & (beyond <= allowed[left] * length))
        if len(keep) < len(left):
            left, at, points, weight = left[keep], at[keep], points[:, keep], weight[:, keep]
            ahead, behind, share = ahead[keep], behind[keep], share[keep]
        if not len(left):
            break
        index = np.arange(len(left))
        at = at + share[:, None] * (points[ahead, index] - points[behind, index])
        weight[ahead, index] += share
        weight[behind, index] -= share
    for n in left:
        distinct = np.unique(all_points[:, n], axis=0)[:DISTINCT]
        found[n] = distance_to_triangles(target[n], distinct) <= allowed[n]
        yield 0.0
    return found


def _pair(
    points: NDArray[np.float64],
    weight: NDArray[np.float64],
    way: NDArray[np.float64],
    at: NDArray[np.float64],
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
    """Return the points farthest ahead and behind on the way from `at` to the target, (n,) each.

    Besides, how much weight to move, and how far the target lies beyond the farthest of all, times
    the length of the way.
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


def distance_to_triangles(target: NDArray[np.float64], points: NDArray[np.float64]) -> float:
    """Return how far a colour (c,) is from the nearest point, side or triangle of some (k, c)."""
    least = np.linalg.norm(points - target, axis=1).min()
    for corners in (2, 3):
        if len(points) < corners:
            break
        index = np.array(list(combinations(range(len(points)), corners)))
        first, sides = points[index[:, 0]], points[index[:, 1:]] - points[index[:, :1]]
        share = np.einsum("tij,tj->ti", np.linalg.pinv(sides.swapaxes(1, 2)), target - first)
        inside = (share >= 0).all(axis=1) & (share.sum(axis=1) <= 1)
        foot = first + np.einsum("ti,tij->tj", share, sides)
        away = np.linalg.norm(foot - target, axis=1)
        least = min(least, away[inside].min(initial=np.inf))
    return float(least)
