"""Three ways to compute: float32, float64, and exactly.

A number is a numpy scalar, which rounds after every operation as the tracer's arrays do, or a
`Fraction`, which never rounds. All three know +, −, × and ÷, so a formula is written once.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from fractions import Fraction

import numpy as np

Number = np.float32 | np.float64 | Fraction
Vector = tuple[Number, Number, Number]


class Arithmetic(StrEnum):
    """What the numbers of a column are."""

    FLOAT32 = "float32"
    FLOAT64 = "float64"
    EXACT = "exact"

    def number(self, value: float) -> Number:
        """Return a finite float64 in this arithmetic: rounded to float32, else as it is."""
        if self is Arithmetic.EXACT:
            return Fraction(float(value))
        with np.errstate(over="ignore"):  # beyond float32's range it is inf, as in the tracer
            return np.dtype(self.value).type(value)

    def vector(self, values: Iterable[float]) -> Vector:
        """Return three finite float64 in this arithmetic."""
        x, y, z = (self.number(v) for v in values)
        return x, y, z


FLOATS = Arithmetic.FLOAT32, Arithmetic.FLOAT64


def dot(a: Vector, b: Vector) -> Number:
    """Return a · b, summed in the order x, y, z, as `tracer.vector.dot` does."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return a × b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def add(a: Vector, b: Vector) -> Vector:
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def subtract(a: Vector, b: Vector) -> Vector:
    """Return a − b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scale(k: Number, a: Vector) -> Vector:
    """Return k a."""
    return k * a[0], k * a[1], k * a[2]


def divides(value: Number) -> bool:
    """Return whether one can divide by it: a float always may, with inf or NaN for 0."""
    return not isinstance(value, Fraction) or value != 0
