"""Finds the numbers of a fault with which the most pixels of a sample are right.

The count is an integer that jumps wherever an edge passes a pixel's centre, so it has no slope to
follow. Looked at are the places around the best ones, ever nearer; then how far each number may go
alone before fewer pixels are right.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ...arrays import Array
from ...tracer.progress import Work
from ..evidence import SEED
from .fault import Guess

Values = tuple[float, ...]
Right = Callable[[Values], Work[int]]  # how many pixels are right, -1 if these numbers cannot be

FINEST = 1 / 512  # of a unit, which is about a pixel
# How many steps are looked at on each side, by how many numbers there are; 1 otherwise.
WIDE = {1: 4, 2: 2}
NARROW = {1: 2}
COARSE = 1 / 2  # of a unit: with smaller steps only the best start is followed
ASKEW = 8  # directions besides those of the axes, where there are three numbers
FARTHEST = 2.0  # units to which a number is enclosed, at most


class Search:
    """A search among the numbers of one fault; each place is looked at once."""

    def __init__(
        self, right: Right, units: Sequence[float], finest: float = FINEST, least: float = 0
    ) -> None:
        self._right = right
        self.units = np.array(units)
        self.finest = finest
        self.least = least  # right pixels after large steps, for smaller ones to be worth while
        self._known: dict[Values, int] = {}

    def guess(
        self, starts: Sequence[Values], step: float = 1.0, name: str = ""
    ) -> Work[Guess | None]:
        """Return the best numbers near some starts, with what encloses them; steps are in units."""
        best, most = starts[0], -1
        for start in starts:
            values, right = yield from self._climbed(start, step, COARSE)
            if right > most:
                best, most = values, right
        if most < max(self.least, 0):
            return None
        # What stopped on a ridge goes on from there with larger steps, once.
        best, _ = yield from self._climbed(best, step / 2, COARSE)
        best, right = yield from self._climbed(best, min(step, COARSE), self.finest)
        low, high = yield from self._enclosed(best, right)
        middle = rounded(low.tolist(), high.tolist())
        if (yield from self.right(middle)) < right:
            middle = best
        return Guess(middle, tuple(low.tolist()), tuple(high.tolist()), object=name)

    def _climbed(self, values: Values, step: float, last: float) -> Work[tuple[Values, int]]:
        """Return the best place that smaller and smaller steps reach, and how many are right."""
        right = yield from self.right(values)
        while step >= last and right >= 0:
            values, better = yield from self._around(values, step)
            if better == right:
                step /= 2
            right = better
        return values, right

    def right(self, values: Values) -> Work[int]:
        """Return how many pixels are right with these numbers."""
        if values not in self._known:
            self._known[values] = yield from self._right(values)
        return self._known[values]

    def _around(self, values: Values, step: float) -> Work[tuple[Values, int]]:
        """Return the best place a step away in any direction, or this one."""
        best, most = values, (yield from self.right(values))
        for direction in _directions(len(values), WIDE if step >= COARSE else NARROW):
            there = tuple((values + step * self.units * direction).tolist())
            found = yield from self.right(there)
            if found > most:
                best, most = there, found
        return best, most

    def _enclosed(self, values: Values, right: int) -> Work[tuple[Array, Array]]:
        """Return how far each number may go, alone, before fewer pixels are right."""
        ends = np.array((values, values))
        for k in range(len(values)):
            for end, side in zip(ends, (-1, 1), strict=True):
                good, bad = 0.0, self.finest
                while bad < FARTHEST and (yield from self._beside(values, k, side * bad)) >= right:
                    good, bad = bad, 2 * bad
                while bad - good > self.finest / 4:
                    middle = (good + bad) / 2
                    same = (yield from self._beside(values, k, side * middle)) >= right
                    good, bad = (middle, bad) if same else (good, middle)
                end[k] += side * good * self.units[k]
        return ends[0], ends[1]

    def _beside(self, values: Values, k: int, units: float) -> Work[int]:
        other = list(values)
        other[k] += float(units * self.units[k])
        return (yield from self.right(tuple(other)))


def _directions(count: int, far: Mapping[int, int]) -> Array:
    """Return the steps with which is looked around: (m, count), also some that follow no axis."""
    steps = far.get(count, 1)
    around = np.array(np.meshgrid(*[range(-steps, steps + 1)] * count)).reshape(count, -1).T
    around = around[around.any(axis=1)]
    if count < 3:
        return around
    rng = np.random.default_rng(SEED)
    return np.concatenate((around[np.abs(around).sum(axis=1) < 3], rng.normal(size=(ASKEW, count))))


def rounded(low: Sequence[float], high: Sequence[float]) -> Values:
    """Return numbers between others, in the middle, but with as few digits as that allows."""
    out = []
    for a, b in zip(low, high, strict=True):
        middle = (a + b) / 2
        for digits in range(8):
            near = round(middle, digits)
            if a <= near <= b:
                middle = near
                break
        out.append(middle)
    return tuple(out)
