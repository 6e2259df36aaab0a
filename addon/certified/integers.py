"""Vectors of Python's integers, and floats as such: an integer times a power of two is exact.

Theorems: `Integers.integers_exact`, `ConversionsCode.integers_is`.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array

Integers = tuple[int, int, int]

ZERO: Integers = (0, 0, 0)


def integers(vectors: Array) -> tuple[list[Integers], int]:
    """Return vectors (3, n) as n triples of integers, and an exponent e: float = integer * 2^e.

    Fractions must have powers of two as denominators.
    """
    if vectors.dtype == object:
        unit = max((value.denominator for value in vectors.flat), default=1)
        x, y, z = ([int(value * unit) for value in row] for row in vectors)
        return list(zip(x, y, z, strict=True)), 1 - unit.bit_length()
    mantissa, exponent = np.frexp(vectors)
    zero = mantissa == 0
    least = int(exponent[~zero].min()) if not zero.all() else 0
    exponent[zero] = least
    digits = (mantissa * 2.0**53).astype(np.int64)  # exact: a mantissa has 53 digits
    rows = zip(digits.tolist(), (exponent - least).tolist(), strict=True)
    x, y, z = ([m << e for m, e in zip(row, by, strict=True)] for row, by in rows)
    return list(zip(x, y, z, strict=True)), least - 53


def scaled(a: Integers, by: int) -> Integers:
    """Return a vector times an integer."""
    return a[0] * by, a[1] * by, a[2] * by


def sub(a: Integers, b: Integers) -> Integers:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def dot(a: Integers, b: Integers) -> int:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Integers, b: Integers) -> Integers:
    """Return a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
