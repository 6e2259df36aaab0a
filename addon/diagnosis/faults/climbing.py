"""Hill climbing: the numbers of a fault with which the most pixels agree.

The count is an integer that jumps wherever an edge passes a pixel's centre, so it has no gradient.
The neighbours of the best place are evaluated, with ever smaller steps.

A pixel that is the same at all neighbours of a place is the same between them, as far as what it
shows is convex: once steps are small, only the other pixels are evaluated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Array, Bools, Floats, Places
from ...tracer.progress import Work
from ..evidence import SEED
from .fault import Values

Right = Callable[
    [Values], Work[Bools | None]
]  # which pixels are right; None if the numbers are impossible
Among = Callable[[Places], Right]  # the same function of some of the pixels, by index

# Neighbours on each side of an axis, by the number of axes; 1 otherwise.
WIDE = {1: 4, 2: 2}
NARROW = {1: 2}
COARSE = 1 / 2  # of a unit: smaller steps have fewer neighbours
ASKEW = 8  # random directions besides those of three axes
SMALL = 1 / 8  # of a unit: between larger steps, pixels may change and change back
ROUNDING = 1e-9  # of a step
FINE = 0.97  # of the pixels: with as many right, each wrong one is evaluated, too
FEWER = 1 / 2  # of the evaluated pixels: with more left, none is dropped


@dataclass(frozen=True, eq=False)
class _Near:
    """Pixels known to stay as they are in the neighbourhood of a place."""

    axes: Floats  # what a unit along each adds to the numbers, (m, k)
    units: Floats  # units of numbers, (k, m)
    centre: Floats
    step: float
    known: Bools  # (n,) which pixels are right in the centre
    changing: Places  # those that may change within a step
    right: Right  # of these

    def holds(self, values: Values) -> bool:
        """Return whether numbers lie within a step of the centre, along two axes at most."""
        offset = np.subtract(values, self.centre)
        along = self.units @ offset
        beside = np.abs(offset - self.axes @ along)  # beside all axes
        away = np.abs(along) / self.step
        between = np.max(away) <= 1 + ROUNDING and np.sum(away) <= 2 + ROUNDING
        return bool(between and np.all(beside <= ROUNDING * np.abs(offset).max()))


class Climb:
    """Hill climbing among the numbers of one fault; each place is evaluated once.

    Parameters
    ----------
    right : callable
        Which of n pixels are right with m numbers.
    axes : (m, k) or (m,) float
        What a unit, about a pixel, along each of k axes adds to the numbers; or of each alone.
    moves : float
        With steps of one length, at most.
    among : callable, optional
        What says the same of some pixels, by their numbers, and takes less work.
    """

    def __init__(
        self,
        right: Right,
        axes: Sequence[float] | Floats,
        moves: float = np.inf,
        among: Among | None = None,
    ) -> None:
        axes = np.asarray(axes, np.float64)
        self._right = right
        self.axes = np.diag(axes) if axes.ndim == 1 else axes
        self.moves = moves
        self._among = among
        self._known: dict[Values, Bools | None] = {}
        self._near: list[_Near] = []  # nested, the smallest last
        self._most = 0  # right pixels anywhere so far
        self._wanted = (
            np.inf
        )  # with as many, a place is as good as the best: all pixels are evaluated

    def climbed(self, values: Values, step: float, last: float) -> Work[tuple[Values, int]]:
        """Climb with ever smaller steps; return the best place and its count of right pixels."""
        right = yield from self.count(values)
        moves = 0
        while step >= last and right >= 0:
            values, better = yield from self._around(values, step)
            moves += 1
            if better == right:
                self._narrow(values, step)
            if better == right or moves >= self.moves:
                step, moves = step / 2, 0
            right = better
        return values, right

    def count(self, values: Values) -> Work[int]:
        """Return how many pixels are right with these numbers; -1 if they are impossible."""
        if values not in self._known:
            self._known[values] = yield from self._found(values)
        found = self._known[values]
        count = -1 if found is None else int(np.count_nonzero(found))
        self._most = max(self._most, count)
        return count

    def _found(self, values: Values) -> Work[Bools | None]:
        """Return which pixels are right with these numbers; None if they are impossible.

        Beyond what is known, the pixels that change first say whether all others together can make
        it a place that is wanted: if not, they are not looked at, and taken to be right.
        """
        near = next((n for n in reversed(self._near) if n.holds(values)), None)
        for one in [near] if near else self._near[:1]:
            found = one.known.copy() if near else np.ones_like(one.known)
            if len(one.changing):
                some = yield from one.right(values)
                if some is None:
                    return None
                found[one.changing] = some
            if near or np.count_nonzero(found) < min(self._most, self._wanted):
                return found
        return (yield from self._right(values))

    def _narrow(self, values: Values, step: float) -> None:
        """Restrict further evaluations to the pixels that change within a step of some numbers."""
        own = self._known[values]
        if self._among is None or step > SMALL or own is None:
            return
        others = [self._known[there] for there in self._places(values, step)]
        changes = np.any([own != v for v in others if v is not None], axis=0)
        if own.mean() >= FINE:  # a thin surface between the places may make right what is wrong
            changes |= ~own
        changing = np.flatnonzero(changes)
        before = len(self._near[-1].changing if self._near else own)
        if len(changing) <= FEWER * before:
            units = np.linalg.pinv(self.axes)
            right = self._among(changing)
            centre = np.array(values)
            self._near.append(_Near(self.axes, units, centre, step, own, changing, right))

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
    """Return numbers (m,) as a tuple."""
    return tuple(numbers.tolist())


def _directions(count: int, far: Mapping[int, int]) -> Array:
    """Return the directions to the neighbours, (m, count): along axes, and some askew."""
    if count > 3:
        around = np.concatenate((np.eye(count), -np.eye(count)))
        return np.concatenate((around, np.random.default_rng(SEED).normal(size=(ASKEW, count))))
    steps = far.get(count, 1)
    around = np.array(np.meshgrid(*[range(-steps, steps + 1)] * count)).reshape(count, -1).T
    around = around[around.any(axis=1)]
    if count < 3:
        return around
    rng = np.random.default_rng(SEED)
    return np.concatenate((around[np.abs(around).sum(axis=1) < 3], rng.normal(size=(ASKEW, count))))
