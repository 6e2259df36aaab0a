"""Anti-aliasing: whether a colour is a mix of what the tracer sees within the filter's radius.

A filter with weights that are not negative gives a point of the convex hull of the colours that it
mixes. Workbench mixes log2(1 + colour) in place of the colour, so the hull is looked for among
those, too. The nearest point of a hull is found by pairwise steps of Frank and Wolfe's algorithm
(Lacoste-Julien and Jaggi, "On the global linear convergence of Frank-Wolfe optimization variants",
2015): weight goes from the colour that is farthest behind to the one that is farthest ahead.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..tracer import shading
from ..tracer.nearest import plan
from ..tracer.probe import Probe
from ..tracer.progress import Work, result_of
from .again import SOUND, parts_of, set_out
from .cause import Cause, Settler
from .coverage import coverage
from .shown import Shown

# Rings within the radius and directions on each, where the tracer is asked; later ones only of
# what is left: a sliver passes between the samples.
DENSITIES = ((2, 8), (4, 16), (12, 32))
DISTINCT = 16  # colours of which each three are tried
_PIXELS = [(x, y) for x in (-2, -1, 0, 1, 2) for y in (-2, -1, 0, 1, 2) if x or y]
STEPS = 400  # of Frank and Wolfe: two colours need one, three a few, some an age
# A mix is stored in half floats after some twenty roundings, and its samples lie between ours.
NEAR = 2.0**-7


def look_around(scene: Scene, shown: Shown, radius: float, settle: Settler) -> Work[None]:
    """Settle open pixels whose colour is a mix of what is seen within `radius` pixels.

    The figure is the radius of the smallest ring that is enough. Yields the share that is done.
    """
    if not settle.open.any() or radius <= 0 or shown.lit:
        return
    made = result_of(plan(scene, SOUND, reach=np.sqrt(2) * radius))
    region = scene.camera.region
    parts = list(parts_of(scene, settle.open))
    for number, tile in enumerate(parts):
        rows = slice(tile.y0 - region.y0, tile.y1 - region.y0)
        part = settle.rows(rows)
        for rings, spokes in DENSITIES:
            wanted = part.open.copy()
            if wanted.any():
                probe = result_of(Probe.of(made, tile, wanted.ravel()))
                here = shown.at(rows).at(wanted)
                for reach, found, seen in _mixes(scene, probe, here, radius, rings, spokes):
                    mixed = seen  # in the end, of the last ring
                    part(set_out(found, wanted), Cause.ANTI_ALIASING, reach, radius)
                    yield number / len(parts)
        if part.open.any():  # of `wanted`, those that the last density has not found
            left = np.flatnonzero(~found)
            found[left] = _through_cracks(scene, probe, here, radius, mixed, left)
            part(set_out(found, wanted), Cause.ANTI_ALIASING, radius, radius)


def _mixes(
    scene: Scene, probe: Probe, shown: Shown, radius: float, rings: int, spokes: int
) -> Iterator[tuple[float, NDArray[np.bool_], NDArray]]:
    """Yield ring by ring how far it reaches, which of n pixels are a mix, and of what (k, n, c)."""
    mixed = [_seen(scene, probe, shown, 0.0, 0.0)]
    color, found = shown.color[:, : mixed[0].shape[-1]], np.zeros(len(probe.px), bool)
    for ring in range(1, rings + 1):
        reach = radius * ring / rings
        angles = 2 * np.pi * (np.arange(spokes) + ring / rings) / spokes
        offsets = [(reach * np.cos(a), reach * np.sin(a)) for a in angles]
        if ring == rings:  # what smooths edges takes in whole pixels
            offsets += [(x, y) for x, y in _PIXELS if max(abs(x), abs(y)) <= radius]
        mixed += [_seen(scene, probe, shown, *offset) for offset in offsets]
        rest, seen = np.flatnonzero(~found), np.stack(mixed)
        found[rest] = is_mix(color[rest], seen[:, rest], shown.sums)
        yield reach, found, seen


def _through_cracks(
    scene: Scene,
    probe: Probe,
    shown: Shown,
    radius: float,
    mixed: NDArray,
    left: NDArray[np.intp],
) -> NDArray[np.bool_]:
    """Return which of the pixels `left` are a mix, if what lies behind an edge shines through.

    Each of the filter's samples may meet a crack of float32's, and show any triangle that comes
    within the radius. Where all that is seen is one colour, there is no edge.
    """
    may = coverage(probe, np.full(len(probe.px), radius))
    behind = shown.made_of(shading.colors(scene, may.hits))
    found = np.zeros(len(left), bool)
    for n, pixel in enumerate(left):
        seen = np.unique(mixed[:, pixel], axis=0)
        if len(seen) > 1:
            near = np.unique(np.concatenate((seen, behind[may.pixel == pixel])), axis=0)
            color = shown.color[pixel : pixel + 1, : near.shape[1]]
            found[n] = is_mix(color, near[:, None], shown.sums)[0]
    return found


def _seen(scene: Scene, probe: Probe, shown: Shown, dx: float, dy: float) -> NDArray:
    return shown.made_of(shading.colors(scene, probe.trace(dx, dy)))


def is_mix(color: NDArray, mixed: NDArray, sums: int = 0) -> NDArray[np.bool_]:
    """Return which colours (n, c) lie in the convex hull of those of (k, n, c), or near it.

    Each of `sums` additions in half floats may lose as much as half a unit of every channel.
    """
    color, mixed = np.nan_to_num(color).astype(np.float64), mixed.astype(np.float64)
    allowed = (NEAR + sums * 2.0**-11) * np.maximum(1, np.abs(color).max(axis=-1, initial=0))
    found = in_hull(color, mixed, allowed)
    rest = np.flatnonzero(~found)
    logs = [np.log2(1 + np.maximum(v, 0)) for v in (color[rest], mixed[:, rest])]
    # A colour's own error is up to 1.44 times as large in the logarithm, itself a half float.
    found[rest] = in_hull(*logs, 2 * allowed[rest])
    return found


def in_hull(
    target: NDArray[np.float64], points: NDArray[np.float64], allowed: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which targets (n, c) lie within `allowed` (n,) of the hull of points (k, n, c).

    A target is outside for sure once a plane lies between. Where colours lie almost on a line the
    steps are short: then each two and three of the colours are tried.
    """
    found = np.zeros(len(target), bool)
    left = np.arange(len(target))  # those that are not decided yet
    nearest = np.argmin(((points - target) ** 2).sum(axis=-1), axis=0)
    at, all_points = points[nearest, left], points
    weight = np.zeros(points.shape[:2])
    weight[nearest, left] = 1
    for _ in range(STEPS):
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
