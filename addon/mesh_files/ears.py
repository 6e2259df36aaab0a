"""Cuts one polygon into triangles by clipping ears, in the order in which Blender clips them.

What is cut is right if no triangle is turned over: the triangles, counted with their signs, cover
each point as often as the polygon winds round it, so triangles of one sign cover a polygon that
does not cross itself once, and nothing beside it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from ..arrays import Floats
from .planar import Planar, Triple

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
        for k in (a, b):
            if self.turns[k] <= 0:
                self.turns[k] = self.turn(*self.ear(k))
                gone |= {k} if self.turns[k] > 0 else set()
        if gone:
            self.hindering = [k for k in self.hindering if k not in gone]


Free = Callable[[_Ring, int], bool]


def ears(shape: Planar) -> tuple[list[Triple], bool]:
    """Return the triangles of a polygon, as numbers of its corners, and whether they are right.

    Where Blender's way turns a triangle over, as it may where a polygon touches itself along a
    bridge, ears are looked for that no edge enters. Where that does not help either, or edges
    cross, the polygon crosses itself; it is then cut as Blender cuts it.
    """
    count = len(shape.flat)
    own = _clipped(_Ring(count, shape.turn), _by_corners(shape))
    if not shape.has_area or _crosses(shape):
        return own, shape.is_line
    if _upright(shape, own):
        return own, True
    other = _clipped(_Ring(count, shape.turn), _by_edges(shape))
    return (other, True) if _upright(shape, other) else (own, False)


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

    def is_free(ring: _Ring, tip: int) -> bool:
        ear = a, b, c = ring.ear(tip)
        near = ring.hindering
        if len(near) > _FEW:
            box = flat[[*ear]]
            at = flat[near]
            inside = ((at >= box.min(axis=0)) & (at <= box.max(axis=0))).all(axis=1)
            near = np.array(near)[inside].tolist()  # rounding keeps the order of coordinates
        return not any(
            turn(c, a, k) >= 0 and turn(a, b, k) >= 0 and turn(b, c, k) >= 0
            for k in near
            if k not in ear
        )

    return is_free


def _by_edges(shape: Planar) -> Free:
    """Return a stricter test, which lets corners touch: no edge enters the inside of the ear.

    An edge and the inside of a triangle are apart if a side of the one or the other has them on
    different sides (Gottschalk's theorem of separating axes).
    """
    turn = shape.turn

    def is_free(ring: _Ring, tip: int) -> bool:
        ear = a, b, c = ring.ear(tip)
        if ring.turns[tip] == 0:
            return True
        p = c
        while p != a:
            q = ring.after[p]
            sides = [turn(p, q, k) for k in ear]
            is_apart = min(sides) >= 0 or max(sides) <= 0
            is_apart = is_apart and any(sides)
            for i, j in ((a, b), (b, c), (c, a)):
                is_apart = is_apart or max(turn(i, j, p), turn(i, j, q)) <= 0
            if not is_apart:
                return False
            p = q
        return True

    return is_free


def _upright(shape: Planar, triangles: list[Triple]) -> bool:
    return all(shape.turn(*triangle) >= 0 for triangle in triangles)


def _crosses(shape: Planar) -> bool:
    """Return whether two edges cross at a point inside both."""
    count = len(shape.flat)
    ends = np.array(shape.flat)
    ends = np.stack((ends, np.roll(ends, -1, axis=0)))
    low, high = ends.min(axis=0), ends.max(axis=0)
    order = np.argsort(low[:, 0], kind="stable")
    low, high = low[order], high[order]
    last = np.searchsorted(low[:, 0], high[:, 0], "right")
    return any(
        _edges_cross(shape.turn, i, int(order[k]), count)
        for n, i in enumerate(order.tolist())
        for k in n + 1 + np.flatnonzero(_overlap(low, high, n, last[n]))
    )


def _overlap(low: Floats, high: Floats, n: int, last: int) -> Floats:
    """Return which edges after n and before `last` have heights of edge n."""
    own = slice(n + 1, last)
    return (low[own, 1] <= high[n, 1]) & (high[own, 1] >= low[n, 1])


def _edges_cross(turn: Callable[[int, int, int], int], i: int, j: int, count: int) -> bool:
    """Return whether the edges from the corners i and j on cross, at no corner."""
    a, b, c, d = i, (i + 1) % count, j, (j + 1) % count
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0
