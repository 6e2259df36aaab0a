"""Finds the numbers of a fault with which the most sampled pixels are right, and their ranges.

Hill climbing leads to the best place (`climbing.py`). From there, bisection finds how far each
number goes by itself with as many right pixels.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...arrays import Floats
from ...tracer.progress import Work
from .climbing import COARSE, SMALL, Climb, Right, values_of
from .fault import Numbers, Values

FINEST = 1 / 512  # of a unit, which is about a pixel
ROUGH = 1 / 32  # of a unit: the last step if a refinement follows
FARTHEST = 256.0  # units: the largest distance of an end
CLOSE = 1 / 16  # of the distance of an end: its precision
NEARLY = 0.97  # of the right pixels: from a place with as many it is climbed again
DIGITS = range(-1, 6)  # digits of a number beyond those that its range fixes


class Search(Climb):
    """A search among the numbers of one fault.

    Parameters
    ----------
    right, axes, moves
        As those of :class:`Climb`.
    finest : float
        Units: the last step.
    least : float
        Right pixels after large steps, for smaller ones to be worth while.
    unseen : (m, j) float, optional
        Further axes, along which nothing changes: they are not searched.
    """

    def __init__(
        self,
        right: Right,
        axes: Sequence[float] | Floats,
        finest: float = FINEST,
        least: float = 0,
        unseen: Floats | None = None,
        moves: float = np.inf,
    ) -> None:
        super().__init__(right, axes, moves)
        self.unseen = np.zeros((len(self.axes), 0)) if unseen is None else unseen
        self.finest = finest
        self.least = least

    def guess(
        self, starts: Sequence[Values], step: float = 1.0, name: str = "", enclose: bool = True
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
        if not enclose:
            return Numbers(best, best, best, object=name)
        best, right = yield from self._with_fewer(best, right)
        places = yield from self._region(np.array(best), right)
        told = yield from self._rounded(best, places, right)
        places = np.array([told, *places])
        beyond = self.finest * np.abs(self.axes).sum(axis=1)
        low, high = places.min(axis=0) - beyond, places.max(axis=0) + beyond
        return Numbers(told, values_of(low), values_of(high), object=name)

    def _with_fewer(self, best: Values, right: int) -> Work[tuple[Values, int]]:
        """Return a place as good with a number near 0, if there is one; else the best place.

        On a ridge, climbing ends somewhere.
        """
        numbers = np.array(best)
        kept = sorted(np.ndindex(*(2,) * len(best)), key=sum)[1:-1]
        for some in kept:
            place = values_of(numbers * some)
            if (yield from self.count(place)) >= NEARLY * right:
                there, found = yield from self.climbed(place, SMALL, self.finest)
                return (there, found) if found >= right else (best, right)
        return best, right

    def _region(self, best: Floats, right: int) -> Work[Floats]:
        """Return the places, (n, m), to which each number goes by itself with as many right pixels.

        So does what is unseen, of all numbers together.
        """
        alone = np.diag(np.abs(self.axes).max(axis=1))
        places = [best]
        for along in np.hstack((alone, -alone, self.unseen, -self.unseen)).T:
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
