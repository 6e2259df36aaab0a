"""Numbers with a bound on what sound float64 may make of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from reference_tracer.arrays import Floats


@dataclass(frozen=True, eq=False)
class Bounded:
    """Numbers (...), and how far they may be off, in roundings u = 2^-53, to first order.

    A sum counts both its terms, not what is left of them: so the bound holds for every order of
    summation, and for formulas whose brackets are multiplied out. A vector is an array of three.

    References
    ----------
    .. [1] Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., 2002, 3.3: running
       error analysis.
    """

    value: Floats
    error: Floats

    @classmethod
    def of(cls, value: Floats | float) -> Bounded:
        """Return numbers that are exact."""
        return cls(np.asarray(value, np.float64), np.zeros(1))

    def __neg__(self) -> Bounded:
        return Bounded(-self.value, self.error)

    def __add__(self, other: Bounded) -> Bounded:
        error = self.error + other.error + np.abs(self.value) + np.abs(other.value)
        return Bounded(self.value + other.value, error)

    def __sub__(self, other: Bounded) -> Bounded:
        return self + -other

    def __mul__(self, other: Any) -> Any:
        if not isinstance(other, Bounded):
            return NotImplemented  # a vector's
        value, size = self.value * other.value, np.abs(self.value)
        error = size * other.error + np.abs(other.value) * self.error + np.abs(value)
        return Bounded(value, error)

    def __truediv__(self, other: Bounded) -> Bounded:
        value = self.value / other.value
        error = self.error + np.abs(value) * other.error
        return Bounded(value, error / np.abs(other.value) + np.abs(value))
