"""Finds the numbers of a fault with which the most sampled pixels are right, and their ranges.

Their count is an integer that jumps wherever an edge passes a pixel's centre, so it has no
gradient: hill climbing leads to the best place, with ever smaller steps. From there, bisection
finds how far each number goes by itself with as many right pixels.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ...arrays import Array, Bools, Floats
from ...tracer.progress import Work
from ..evidence import SEED
from .fault import Numbers, Values

Right = Callable[
    [Values], Work[Bools | None]
]  # which pixels are right; None if the numbers are impossible

# Neighbours on each side of an axis, by the number of axes; 1 otherwise.
WIDE = {1: 4, 2: 2}
NARROW = {1: 2}
COARSE = 1 / 2  # of a unit: smaller steps have fewer neighbours
ASKEW = 8  # random directions besides those of three axes and more
NOISE = 2.0**12  # last places of the largest number

FINEST = 1 / 512  # of a unit, which is about a pixel
ROUGH = 1 / 32  # of a unit: the last step if a refinement follows
FARTHEST = 256.0  # units: the largest distance of an end
CLOSE = 1 / 16  # of the distance of an end: its precision
LEAST_UNITS = 1e-9  # along a number that hardly changes anything, alone
LIKELY = 0.75  # of the right pixels: where as many are right with one number, it is climbed alone
DIGITS = range(-1, 6)  # digits of a number beyond those that its range fixes


@dataclass(eq=False)
class Search:
    """A search among the numbers of one fault; each place is evaluated once."""

    right: Right
    axes: Floats  # (m, k) what a unit, about a pixel, along each of k axes adds to the m numbers
    finest: float = FINEST  # units: the last step
    least: float = 0  # right pixels after large steps, for smaller ones to be worth while
    unseen: Floats | None = None  # (m, j) axes along which nothing changes: they are not searched
    moves: float = np.inf  # with steps of one length, at most
    known: dict[Values, int] = field(default_factory=dict)  # how many pixels are right

    def guess(
        self, starts: Sequence[Values], step: float = 1.0, enclose: bool = True
    ) -> Work[Numbers | None]:
        """Return the best numbers near some starts, with their ranges; steps are in units.

        What will be fitted more finely need not have them yet.
        """
        best, most = starts[0], -1
        for start in starts:
            values, right = yield from self.climbed(start, step, COARSE)
            if right > most:
                best, most = values, right
        if most < max(self.least, 0):
            return None
        # It may have stopped on a ridge: climb once more from there, with larger steps.
        best, _ = yield from self.climbed(best, step / 2, COARSE)
        last = self.finest if enclose else ROUGH
        best, right = yield from self.climbed(best, min(step, COARSE), last)
        if len(best) > 1:
            best, right = yield from self._one_alone(best, right, last)
        if not enclose:
            return Numbers(best, best, best)
        places = yield from self._region(np.array(best), right)
        # Along what is unseen a range may be very long: its middle says nothing.
        told = yield from self._rounded(best, places[: 1 + 2 * len(best)], right)
        places = np.array([told, *places])
        beyond = self.finest * np.abs(self.axes).sum(axis=1)
        low, high = places.min(axis=0) - beyond, places.max(axis=0) + beyond
        return Numbers(told, values_of(low), values_of(high))

    def _one_alone(self, best: Values, right: int, last: float) -> Work[tuple[Values, int]]:
        """Return a place as good where all numbers but one are 0; else the best place."""
        numbers, units = np.array(best), np.linalg.pinv(self.axes)
        for axis, one in zip(np.eye(len(best)), units.T, strict=True):
            size = max(float(np.linalg.norm(one)), LEAST_UNITS)
            alone = replace(self, axes=axis[:, None] / size, moves=np.inf)
            place = values_of(axis * (one / size**2 @ units @ numbers))
            if (yield from self.count(place)) >= LIKELY * right:
                there, found = yield from alone.climbed(place, COARSE, last)
                if found >= right:
                    return there, found
        return best, right

    def _region(self, best: Floats, right: int) -> Work[Floats]:
        """Return the places, (n, m), to which each number goes by itself with as many right pixels.

        So does what is unseen, of all numbers together.
        """
        alone = np.diag(np.abs(self.axes).max(axis=1))
        unseen = np.zeros((len(best), 0)) if self.unseen is None else self.unseen
        places = [best]
        for along in np.hstack((alone, -alone, unseen, -unseen)).T:
            places.append((yield from self._end(best, along, right)))
        return np.array(places)

    def _end(self, place: Floats, along: Floats, right: int) -> Work[Floats]:
        """Return the last place in a direction (m,) with as many right pixels (bisection)."""
        good, bad = 0.0, self.finest
        while bad < FARTHEST and (yield from self.count(values_of(place + bad * along))) >= right:
            good, bad = bad, 2 * bad
        while bad - good > max(self.finest / 4, CLOSE * good):
            between = (good + bad) / 2
            if (yield from self.count(values_of(place + between * along))) >= right:
                good = between
            else:
                bad = between
        return place + good * along

    def _rounded(self, best: Values, places: Floats, right: int) -> Work[Values]:
        """Round numbers to as few digits as are as good: 0, the middles of ranges, or the best."""
        low, high = places.min(axis=0), places.max(axis=0)
        middle = (low + high) / 2
        simple = np.where((low <= 0) & (high >= 0), 0, middle)
        known = np.clip(np.floor(-np.log10(np.maximum(high - low, 1e-12))), -6, 12)
        for more in DIGITS:
            for place in (*map(values_of, (simple, middle)), best):
                near = tuple(
                    round(v, int(d) + more) + 0.0 for v, d in zip(place, known, strict=True)
                )
                if (yield from self.count(near)) >= right:
                    return near
        return best

    def climbed(self, values: Values, step: float, last: float) -> Work[tuple[Values, int]]:
        """Climb with ever smaller steps; return the best place and its count of right pixels."""
        right = yield from self.count(values)
        moves = 0
        while step >= last and right >= 0:
            values, better = yield from self._around(values, step)
            moves += 1
            if better == right or moves >= self.moves:
                step, moves = step / 2, 0
            right = better
        return values, right

    def count(self, values: Values) -> Work[int]:
        """Return how many pixels are right with these numbers; -1 if they are impossible."""
        if values not in self.known:
            found = yield from self.right(values)
            self.known[values] = -1 if found is None else int(np.count_nonzero(found))
        return self.known[values]

    def _places(self, values: Values, step: float) -> list[Values]:
        """Return the neighbours of a place, a step away."""
        directions = _directions(self.axes.shape[1], WIDE if step >= COARSE else NARROW)
        return [values_of(values + step * self.axes @ direction) for direction in directions]

    def _around(self, values: Values, step: float) -> Work[tuple[Values, int]]:
        """Return the best of a place and its neighbours, and its count."""
        best, most = values, (yield from self.count(values))
        for there in self._places(values, step):
            found = yield from self.count(there)
            if found > most:
                best, most = there, found
        return best, most


def values_of(numbers: Floats) -> Values:
    """Return numbers (m,) as a tuple, without their last digits: BLAS adds in any order."""
    last = np.spacing(np.abs(numbers).max(initial=0.0)) * NOISE
    return tuple((np.rint(numbers / last) * last).tolist())


def _directions(count: int, far: Mapping[int, int]) -> Array:
    """Return the directions to the neighbours, (m, count): along axes, and some askew."""
    askew = np.random.default_rng(SEED).normal(size=(ASKEW, count))
    if count > 3:
        return np.concatenate((np.eye(count), -np.eye(count), askew))
    steps = far.get(count, 1)
    around = np.array(np.meshgrid(*[range(-steps, steps + 1)] * count)).reshape(count, -1).T
    around = around[around.any(axis=1)]
    if count < 3:
        return around
    return np.concatenate((around[np.abs(around).sum(axis=1) < 3], askew))
