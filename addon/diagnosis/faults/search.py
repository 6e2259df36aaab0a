"""Finds the numbers of a fault with which the most sampled pixels are right, and their range.

Hill climbing leads to the best place (`climbing.py`). Then the region around it is enclosed in
which as many pixels are right: all numbers in it agree as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ...arrays import Floats
from ...tracer.progress import Work
from ..evidence import SEED
from .climbing import COARSE, SMALL, Among, Climb, Right, values_of
from .fault import Numbers, Values

FINEST = 1 / 512  # of a unit, which is about a pixel
ROUGH = 1 / 32  # of a unit: the last step if a refinement follows
FARTHEST = 256.0  # units: the largest distance of an end
ROUNDS = 5  # of enclosing a region of several numbers, at most
GROWN = 1.2  # growth in a round that leads to another one
PUSHES = 8  # of a region along each number, at most
PUSHED = 1.02  # growth in a push that leads to another one
LED = 4  # random directions of a push
INSIDE = 1 / 4  # of the way to the middle: where a push starts
CLOSE = 1 / 8  # of the region's half width: the precision of its ends
WIDER = 1.3  # safety factor of the box: the region's corners lie beyond its known ends
ANEW = 4  # times that a region is left for a better place beside it, at most
BESIDE = (1 / 64, 1 / 32, 1 / 16, 1 / 8)  # units from a region: where better places are searched
LOTS = 8  # random places at each of these distances
NEARLY = 0.97  # of the right pixels: from a place with as many it is climbed again
ENCLOSING = 1 << 20  # pixels that are evaluated to find how far the region of a fault reaches
DIGITS = range(-1, 5)  # digits of a number beyond those that its range fixes


class Search(Climb):
    """A search among the numbers of one fault.

    Parameters
    ----------
    right, axes, moves, among
        As those of :class:`Climb`.
    finest : float
        Units: the last step.
    least : float
        Right pixels after large steps, for smaller ones to be worth while.
    unseen : (m, j) float, optional
        Further axes, along which nothing changes: they are not searched, only enclosed.
    enclosing : float
        Places that are evaluated to find how far the region reaches, at most: if it reaches
        farther, no range is told.
    """

    def __init__(
        self,
        right: Right,
        axes: Sequence[float] | Floats,
        finest: float = FINEST,
        least: float = 0,
        unseen: Floats | None = None,
        moves: float = np.inf,
        among: Among | None = None,
        enclosing: float = np.inf,
    ) -> None:
        super().__init__(right, axes, moves, among)
        self.enclosing = enclosing
        self.all_axes = self.axes if unseen is None else np.hstack((self.axes, unseen))
        self.finest = finest
        self.least = least
        self.own = self.all_axes  # half the region along each of its own axes, (m, k)
        self._units = np.linalg.pinv(self.all_axes)
        self._middle: Floats = np.zeros(len(self.all_axes))  # from where the farthest is counted

    def guess(
        self, starts: Sequence[Values], step: float = 1.0, name: str = "", enclose: bool = True
    ) -> Work[Numbers | None]:
        """Return the best numbers near some starts, with their range; steps are in units.

        What will be fitted more finely need not be enclosed yet.
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
        self.left = self.enclosing
        for number in range(ANEW + 1):
            places = yield from self._region([np.array(best)], right)
            beside = yield from self._beside(np.array(best))
            better = max(beside.values())
            if better <= right or number == ANEW:
                break  # `places` are those around `best`
            there = next(place for place, found in beside.items() if found == better)
            best, right = yield from self.climbed(there, COARSE / 2, self.finest)
        # They are as good, though places between may not be.
        as_good = [place for place, found in beside.items() if found == right]
        places = np.array([*places, *as_good])
        simple = yield from self._simple_numbers(best, places, right)
        if (
            self.all_axes.shape[1] > 1
        ):  # the reported point lies in the region, too, perhaps far away
            places = yield from self._region([np.array(simple), *places], right)
        if self.left <= 0:  # it reaches farther than was looked
            return Numbers(simple, simple, simple, object=name)
        low, high = self._box(np.array([simple, *places]))  # its last digit may lie just outside
        return Numbers(simple, values_of(low), values_of(high), object=name)

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

    def _box(self, places: Floats) -> tuple[Floats, Floats]:
        """Return a box around places, wider by the finest step.

        A region of several numbers has corners beyond the places.
        """
        low, high = places.min(axis=0), places.max(axis=0)
        beyond = 0.0 if self.all_axes.shape[1] == 1 else (WIDER - 1) / 2 * (high - low)
        beyond += self.finest * np.abs(self.axes).sum(axis=1)
        return low - beyond, high + beyond

    def _region(self, known: list[Floats], right: int) -> Work[Floats]:
        """Return points on the border of the region in which as many pixels are right, (n, m).

        The place is the first of those that are known to lie in it. The region is convex, as far as
        edges are straight and move in proportion to the numbers, and may be long and thin in any
        direction. So its ends are looked for along its own axes, which are found from the ends that
        are known so far.
        """
        ends, self._wanted = [*known], right
        centre: Floats = known[0]
        self._middle = centre
        axes: Floats = self.all_axes if len(known) == 1 else self._own_axes(np.array(ends))
        alone = axes.shape[1] == 1
        first, far = (self.finest, FARTHEST) if len(known) == 1 else (CLOSE, 4.0)
        for number in range(1 if alone else ROUNDS):
            size = _size(ends)
            for direction in _spokes(axes.shape[1]):
                for side in (-1.0, 1.0):
                    along = side * axes @ direction
                    close = 0.0 if alone else CLOSE
                    ends.append((yield from self._end(centre, along, right, first, far, close)))
            axes = self._own_axes(np.array(ends))
            first, far = CLOSE, 4.0
            mean: Floats = np.array(ends).mean(axis=0)
            if (yield from self.count(values_of(mean))) >= right:
                centre = mean
            if (number or len(known) > 1) and _size(ends) < GROWN * size:
                break
        self.own = axes
        if not alone:
            yield from self._push(ends, right)
        return np.array(ends)

    def _push(self, ends: list[Floats], right: int) -> Work[None]:
        """Extend the known places of a region farther along each number.

        The region may be a needle askew to all axes. So the differences of known places lead on,
        from a little inside the farthest one.
        """
        rng = np.random.default_rng(SEED)
        for _ in range(PUSHES):
            size, middle = _size(ends), np.mean(ends, axis=0)
            for number in range(len(middle)):
                for side in (-1.0, 1.0):
                    farthest = max(ends, key=lambda v: side * v[number])
                    start = farthest + INSIDE * (middle - farthest)
                    drawn = rng.integers(len(ends), size=LED)
                    others = [middle] + [ends[k] for k in drawn]
                    for other in others:
                        if other[number] != farthest[number]:
                            along = farthest - other
                            ends.append(
                                (yield from self._end(start, along, right, CLOSE, 4.0, CLOSE))
                            )
            if _size(ends) < PUSHED * size:
                return

    def _beside(self, centre: Floats) -> Work[dict[Values, int]]:
        """Count the right pixels at some random places near a region."""
        rng = np.random.default_rng(SEED)
        out = {}
        for far in BESIDE:
            for direction in rng.normal(size=(LOTS, self.axes.shape[1])):
                there = values_of(centre + far * self.axes @ direction)
                out[there] = yield from self.count(there)
        return out

    def _own_axes(self, ends: Floats) -> Floats:
        """Return the half axes of the region of some places (n, m), as columns (m, k)."""
        units = (ends - ends.mean(axis=0)) @ self._units.T
        _, _, own = np.linalg.svd(units, full_matrices=False)
        reach = np.maximum(np.abs(units @ own.T).max(axis=0), self.finest / 4)
        return self.all_axes @ (own.T * reach)

    def _end(
        self, centre: Floats, along: Floats, right: int, first: float, far: float, close: float
    ) -> Work[Floats]:
        """Return the last place in a direction (m,) with as many right pixels (bisection)."""
        far = min(far, self._farthest(centre, along))
        good, bad = 0.0, min(first, far)
        while (
            bad < far
            and self.left > 0
            and (yield from self.count(values_of(centre + bad * along))) >= right
        ):
            good, bad = bad, 2 * bad
        while self.left > 0 and bad - good > max(first / 4, close * good):
            between = (good + bad) / 2
            if (yield from self.count(values_of(centre + between * along))) >= right:
                good = between
            else:
                bad = between
        return centre + good * along

    def _farthest(self, centre: Floats, along: Floats) -> float:
        """Return how many times a direction (m,) fits before a number is too far away."""
        begun, step = self._units @ (centre - self._middle), self._units @ along
        with np.errstate(divide="ignore", invalid="ignore"):
            return max(0.0, float(np.nanmin((FARTHEST - np.sign(step) * begun) / np.abs(step))))

    def _simple_numbers(self, best: Values, ends: Floats, right: int) -> Work[Values]:
        """Return the simplest of the numbers that are as good.

        Along the widest axis of the region they may be anything: first those are tried with which
        another number is 0, then the least ones.
        """
        middle = (ends.min(axis=0) + ends.max(axis=0)) / 2
        width = ends.max(axis=0) - ends.min(axis=0)
        if len(best) == 1:
            return (yield from self._rounded(middle, width, right)) or best
        widest = self.own[:, np.argmax(np.linalg.norm(self.own, axis=0))]
        found: list[Values] = []
        for start in (middle, np.array(best)):
            for place in _simplest(start, widest):
                told = yield from self._rounded(place, width, right)
                if told:
                    found.append(told)
        return min(found, key=lambda v: (-v.count(0.0), np.linalg.norm(v)), default=best)

    def _rounded(self, place: Floats, width: Floats, right: int) -> Work[Values | None]:
        """Round numbers to as few digits as are as good; None if none are."""
        known = np.clip(np.floor(-np.log10(np.maximum(width, 1e-12))), -6, 12)
        for more in DIGITS:
            near = tuple(
                round(float(v), int(d) + more) + 0.0 for v, d in zip(place, known, strict=True)
            )
            if (yield from self.count(near)) >= right:
                return near
        return None


def _size(ends: Sequence[Floats]) -> float:
    """Return the sum of the sides of the box around some places."""
    return float(np.ptp(ends, axis=0).sum())


def _simplest(start: Floats, along: Floats) -> Iterator[Floats]:
    """Yield the simplest places on a line: where a number is 0, nearest to 0, the start."""
    for k in np.flatnonzero(np.abs(along) > 1e-3 * np.linalg.norm(along)):
        yield start - start[k] / along[k] * along
    if along.any():
        yield start - (start @ along) / (along @ along) * along
    yield start


def _spokes(count: int) -> Floats:
    """Return the directions in which a region's border is searched, (n, count) unit vectors."""
    if count == 1:
        return np.eye(1)
    askew = np.random.default_rng(SEED).normal(size=(count, count))
    return np.concatenate((np.eye(count), askew / np.linalg.norm(askew, axis=1, keepdims=True)))
