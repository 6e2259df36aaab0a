"""Hill climbing: the numbers of a fault with which the most pixels agree.

The count is an integer that jumps wherever an edge passes a pixel's centre, so it has no gradient.
The neighbours of the best place are evaluated, with ever smaller steps.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ...arrays import Array, Bools, Floats
from ...tracer.progress import Work
from ..evidence import SEED
from .fault import Values

Right = Callable[
    [Values], Work[Bools | None]
]  # which pixels are right; None if the numbers are impossible

# Neighbours on each side of an axis, by the number of axes; 1 otherwise.
WIDE = {1: 4, 2: 2}
NARROW = {1: 2}
COARSE = 1 / 2  # of a unit: smaller steps have fewer neighbours
ASKEW = 8  # random directions besides those of three axes and more
NOISE = 2.0**12  # last places of the largest number
SMALL = 1 / 8  # of a unit: the first step where a place is nearly the best


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
    """

    def __init__(
        self,
        right: Right,
        axes: Sequence[float] | Floats,
        moves: float = np.inf,
    ) -> None:
        axes = np.asarray(axes, np.float64)
        self._right = right
        self.axes = np.diag(axes) if axes.ndim == 1 else axes
        self.moves = moves
        self._known: dict[Values, int] = {}

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
        if values not in self._known:
            found = yield from self._right(values)
            self._known[values] = -1 if found is None else int(np.count_nonzero(found))
        return self._known[values]

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
