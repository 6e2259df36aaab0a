"""Numbers as the sum of two float64, high + low: about 106 binary digits.

Every operation here has a relative error of at most ERROR; sums, differences and products of two
floats have none, as far as nothing under- or overflows. An overflow ends in NaN or inf.

Source: Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building blocks of
double-word arithmetic", ACM TOMS 44(2), 2017: algorithms 6, 7, 10 and 17; their bounds are 3, 2, 7
and 15 u^2 and terms in u^3.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Pair = tuple[Floats, Floats]  # high + low, |low| <= u |high|

ERROR = 16 * 2.0**-106
_SPLITTER = 2.0**27 + 1  # Veltkamp's: leaves halves of 26 digits, whose products are exact


def two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b exactly."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def two_product(a: Floats, b: Floats) -> Pair:
    """Return a * b exactly."""
    product = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def add(x: Pair, y: Pair) -> Pair:
    """Return x + y."""
    high, high_error = two_sum(x[0], y[0])
    low, low_error = two_sum(x[1], y[1])
    high, rest = _fast_two_sum(high, high_error + low)
    return _fast_two_sum(high, low_error + rest)


def negative(x: Pair) -> Pair:
    """Return -x."""
    return -x[0], -x[1]


def scale(x: Pair, y: Floats) -> Pair:
    """Return x * y for a float y."""
    high, error = two_product(x[0], y)
    high, rest = _fast_two_sum(high, x[1] * y)
    return _fast_two_sum(high, rest + error)


def multiply(x: Pair, y: Pair) -> Pair:
    """Return x * y."""
    high, error = two_product(x[0], y[0])
    return _fast_two_sum(high, error + (x[0] * y[1] + x[1] * y[0]))


def divide(x: Pair, y: Pair) -> Pair:
    """Return x / y."""
    quotient = x[0] / y[0]
    high, low = scale(y, quotient)
    return _fast_two_sum(quotient, ((x[0] - high) + (x[1] - low)) / y[0])


def _fast_two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b exactly, for |a| >= |b| or a = 0."""
    total = a + b
    return total, b - (total - a)


def _split(a: Floats) -> Pair:
    scaled = _SPLITTER * a
    high = scaled - (scaled - a)
    return high, a - high
