"""Cuts one polygon into triangles by clipping ears, in the order in which Blender clips them.

What is cut is right if no triangle is turned over: the triangles, counted with their signs, cover
each point as often as the polygon winds round it, so triangles of one sign cover a polygon that
does not cross itself once, and nothing beside it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache

import numpy as np

from ..arrays import Integers
from .planar import Planar, Triple

_MOST = 1000  # corners of a polygon of which all ways are tried: it takes seconds, as their cube
_FEW = 40  # corners that are looked at one by one; of more, those in a box are found first


class _Ring:
    """The corners that are left, each with its neighbours and with how the polygon turns there."""

    def __init__(self, count: int, turn: Callable[[int, int, int], int]) -> None:
        self.turn = turn
        self.before = [(k - 1) % count for k in range(count)]
        self.after = [(k + 1) % count for k in range(count)]
        self.turns = [turn(self.before[k], k, self.after[k]) for k in range(count)]
        self.left = count
        self.first = 0
        self.hindering = [k for k in range(count) if self.turns[k] <= 0]

    def ear(self, tip: int) -> Triple:
        """Return a corner between its neighbours."""
        return self.before[tip], tip, self.after[tip]

    def clip(self, tip: int) -> None:
        """Remove a corner."""
        a, _, b = self.ear(tip)
        self.after[a], self.before[b] = b, a
        self.left -= 1
        self.first = b if tip == self.first else self.first
        gone = {tip} if self.turns[tip] <= 0 else set()
        self.turns[tip] = 1  # it hinders no more
        for k in (a, b):
            if self.turns[k] <= 0:
                self.turns[k] = self.turn(*self.ear(k))
                gone |= {k} if self.turns[k] > 0 else set()
        if gone:
            self.hindering = [k for k in self.hindering if k not in gone]


Free = Callable[[_Ring, int], bool]


def ears(shape: Planar, rounding: float) -> tuple[list[Triple], bool]:
    """Return the triangles of a polygon, as numbers of its corners, and whether they are right.

    Where Blender's way turns a triangle over, as it may where a polygon touches itself, all ways to
    cut it are tried. Where none is right, or edges cross, the polygon is cut as Blender cuts it.

    Parameters
    ----------
    shape : Planar
    rounding : float
        How far the corners may be rounded, in sizes of the polygon: by so much edges may cross.
    """
    own = _clipped(_Ring(len(shape.flat), shape.turn), _by_corners(shape))
    if not shape.has_area:
        return own, shape.is_line
    for reach in (0.0, rounding):
        if not _crosses(shape, reach):
            if not any(shape.is_turned_over(*triangle, reach) for triangle in own):
                return own, True
            if other := _divided(shape, reach):
                return other, True
    return own, False


@cache
def of_convex(count: int) -> list[Triple]:
    """Return the triangles of any convex polygon that turns left at each of its corners."""
    return _clipped(_Ring(count, lambda a, b, c: 1), lambda ring, tip: True)


def _clipped(ring: _Ring, is_free: Free) -> list[Triple]:
    """Clip ears in the order of Blender's `polyfill_2d.c`: each next to the one after the last."""
    out = []
    start, is_reverse = 0, False
    while ring.left > 3:
        ahead = ring.before if is_reverse else ring.after
        tip = _next_ear(ring, start, ahead, is_free)
        ear = ring.ear(tip)
        out.append(ear)
        ring.clip(tip)
        start = ahead[ear[0] if is_reverse else ear[2]]
        if ring.turns[start] <= 0:
            start = ahead[start]
            is_reverse = not is_reverse
    out.append((ring.first, ring.after[ring.first], ring.before[ring.first]))
    return out


def _next_ear(ring: _Ring, start: int, ahead: list[int], is_free: Free) -> int:
    if not ring.hindering:
        return start
    for turn in (1, 0):
        tip = start
        for _ in range(ring.left):
            if ring.turns[tip] == turn and is_free(ring, tip):
                return tip
            tip = ahead[tip]
    tip = start  # nothing is an ear: take any corner that is not turned over
    for _ in range(ring.left):
        if ring.turns[tip] >= 0:
            return tip
        tip = ring.after[tip]
    return tip


def _by_corners(shape: Planar) -> Free:
    """Return Blender's test of an ear: no corner that is not convex lies in it or on its rim."""
    flat, turn = np.array(shape.flat), shape.turn
    hindered: dict[int, Triple] = {}  # a corner's neighbours, and what lay in the ear

    def is_free(ring: _Ring, tip: int) -> bool:
        ear = a, b, c = ring.ear(tip)
        *neighbours, within = hindered.get(tip, (-1, -1, -1))
        if neighbours == [a, c] and within >= 0 and ring.turns[within] <= 0:
            return False
        near = ring.hindering
        if len(near) > _FEW:
            box = flat[[*ear]]
            at = flat[near]
            inside = ((at >= box.min(axis=0)) & (at <= box.max(axis=0))).all(axis=1)
            near = np.array(near)[inside].tolist()  # rounding keeps the order of coordinates
        lie_in_it = (
            k
            for k in near
            if k not in ear and turn(c, a, k) >= 0 and turn(a, b, k) >= 0 and turn(b, c, k) >= 0
        )
        within = next(lie_in_it, -1)
        hindered[tip] = a, c, within
        return within < 0

    return is_free


def _divided(shape: Planar, reach: float) -> list[Triple]:
    """Return triangles none of which is turned over, [] if there are none.

    Found by dynamic programming: the corners from i to j can be cut if there is a corner k between
    them, a triangle with i and j, and those from i to k and from k to j can be cut. A polygon that
    touches itself has such triangles: those of one that it is the limit of.
    """
    count = len(shape.flat)
    if count > _MOST:
        return []
    third = np.full((count, count), -1, np.int32)
    can = np.eye(count, k=1, dtype=bool)
    for wide in range(2, count):
        for i in range(count - wide):
            j = i + wide
            for k in i + 1 + np.flatnonzero(can[i, i + 1 : j] & can[i + 1 : j, j]):
                if not shape.is_turned_over(i, int(k), j, reach):
                    third[i, j], can[i, j] = k, True
                    break
    return list(_thirds(third, 0, count - 1)) if can[0, count - 1] else []


def _thirds(third: Integers, i: int, j: int) -> Iterator[Triple]:
    """Yield the triangles of the corners from i to j."""
    todo = [(i, j)]
    while todo:
        i, j = todo.pop()
        if j - i > 1:
            k = int(third[i, j])
            yield i, k, j
            todo += [(i, k), (k, j)]


def _crosses(shape: Planar, reach: float) -> bool:
    """Return whether two edges cross, and end more than `reach` beyond one another."""
    count = len(shape.flat)
    ends = np.array(shape.flat)
    ends = np.stack((ends, np.roll(ends, -1, axis=0)))
    order = np.argsort(ends[..., 0].min(axis=0), kind="stable")
    low, high = ends.min(axis=0)[order], ends.max(axis=0)[order]
    last = np.searchsorted(low[:, 0], high[:, 0], "right")
    for n, stop in enumerate(last.tolist()):
        after = slice(n + 1, stop)
        near = (low[after, 1] <= high[n, 1]) & (high[after, 1] >= low[n, 1])
        for k in order[after][near].tolist():
            if _edges_cross(shape, int(order[n]), k, count, reach):
                return True
    return False


def _edges_cross(shape: Planar, i: int, j: int, count: int, reach: float) -> bool:
    """Return whether the edges from the corners i and j on cross, at no corner."""
    a, b, c, d = i, (i + 1) % count, j, (j + 1) % count
    turn = shape.turn
    if turn(a, b, c) * turn(a, b, d) >= 0 or turn(c, d, a) * turn(c, d, b) >= 0:
        return False
    ends = (a, b, c), (a, b, d), (c, d, a), (c, d, b)
    return all(shape.distance(*three) > reach for three in ends)
