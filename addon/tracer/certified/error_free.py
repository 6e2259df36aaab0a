"""Sums and products of floats without error: as a float and the rest that it leaves.

All hold as long as nothing under- or overflows; an overflow ends in NaN or inf.

Source: Dekker, "A floating-point technique for extending the available precision", Numerische
Mathematik 18, 1971; Knuth, "The art of computer programming", vol. 2, 4.2.2, theorem B.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Pair = tuple[Floats, Floats]  # high + low, |low| <= u |high|

BITS = 25  # of the high halves that `halves` leaves
_SPLITTER = 2.0**27 + 1  # leaves halves of 26 digits, whose products are exact


def two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def fast_two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b, for |a| >= |b| or a = 0."""
    total = a + b
    return total, b - (total - a)


def two_product(a: Floats, b: Floats) -> Pair:
    """Return a * b."""
    product = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def power_above(v: Floats) -> Floats:
    """Return the power of two above the largest component of vectors (3, n)."""
    x, y, z = np.abs(v)
    return np.ldexp(1.0, np.frexp(np.maximum(np.maximum(x, y), z))[1])


def halves(v: Floats, unit: Floats) -> Pair:
    """Return v as a multiple of unit * 2^-BITS and the rest, for |v| <= unit, a power of two.

    Three products of two such multiples, and sums of them, are exact: they have at most 52 digits.
    """
    shift = unit * (1.5 * 2.0 ** (52 - BITS))
    high = (v + shift) - shift
    return high, v - high


def _split(a: Floats) -> Pair:
    scaled = _SPLITTER * a
    high = scaled - (scaled - a)
    return high, a - high
