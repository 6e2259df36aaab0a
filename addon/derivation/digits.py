"""Writes numbers so that they can be read back, and marks the digits that are wrong.

A float is written with the fewest digits that mean it and no other. An exact number is written with
EXACT_DIGITS digits, and "…" where it has more.
"""

from __future__ import annotations

from decimal import Context, Decimal, Inexact
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from .textbook import Number

EXACT_DIGITS = 24  # significant: a float64 has 17
_PLAIN = range(-4, 16)  # decimal exponents that are written without "e"
_LIMITS = {kind: np.finfo(kind) for kind in (np.float32, np.float64)}  # numpy is slow to find them


class Parts(NamedTuple):
    """A number's text: the digits that are right, those that are not, and the exponent."""

    right: str
    wrong: str = ""
    exponent: str = ""

    def __str__(self) -> str:
        return "".join(self)

    def with_wrong(self, form: str) -> str:
        """Return the text with its wrong digits, if there are any, in a form such as '[{}]'."""
        return f"{self.right}{self.wrong and form.format(self.wrong)}{self.exponent}"


def digits_text(value: Number | float) -> str:
    """Return a number as text that means it: reading it gives the same float, to the bit."""
    if isinstance(value, Fraction):
        return exact_text(value)
    if not isinstance(value, np.float32):
        return repr(float(value))
    short = str(value)
    # By way of float64, as readers go: in theory it may round to the neighbour.
    return short if np.isnan(value) or np.float32(float(short)) == value else repr(float(value))


def exact_text(value: Fraction, count: int = EXACT_DIGITS) -> str:
    """Return an exact number as a decimal, correctly rounded to `count` digits, "…" if inexact."""
    if not value:
        return "0"
    context = Context(prec=count, Emax=10**9, Emin=-(10**9))
    quotient = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    more = "…" if context.flags[Inexact] else ""
    decimal = quotient.normalize(context)
    sign, digits, exponent = decimal.as_tuple()
    place = len(digits) - 1 + int(exponent)
    if place in _PLAIN:
        return f"{decimal:f}{more}"
    shown = "".join(map(str, digits))
    point = f".{shown[1:]}" if shown[1:] else ""
    return f"{'-' * sign}{shown[0]}{point}{more}e{place:+03d}"


def ulps(value: np.floating, exact: Fraction | None) -> float | None:
    """Return how far a float is from the truth, in units in the last place of the truth's float.

    A correctly rounded number is at most 0.5 off. None where there is no truth, no finite number,
    or the truth is 0 and the float is not: then no digit of it is right.
    """
    if exact is None or not np.isfinite(value):
        return None
    error, parts = _error(value, exact)
    if not error:
        return 0.0
    if not exact:
        return None
    power = last_place(exact, type(value))
    try:  # a quotient of integers is correctly rounded
        return (error << max(-power, 0)) / (parts << max(power, 0))
    except OverflowError:
        return float("inf")


def _error(value: np.floating, exact: Fraction) -> tuple[int, int]:
    """Return numerator and denominator, not reduced, of how far a float is from the truth.

    In integers alone: fractions take most of the time that a page of numbers takes.
    """
    top, bottom = float(value).as_integer_ratio()
    return abs(top * exact.denominator - exact.numerator * bottom), bottom * exact.denominator


def last_place(exact: Fraction, kind: type[np.floating]) -> int:
    """Return the power of 2 between neighbouring floats of a type around a number that is not 0."""
    limits = _LIMITS[kind]
    top, bottom = abs(exact.numerator), exact.denominator
    power = top.bit_length() - bottom.bit_length()
    if bottom << max(power, 0) > top << max(-power, 0):
        power -= 1  # 2^power <= size < 2^(power + 1)
    return max(power, int(limits.minexp)) - int(limits.nmant)


def marked(value: np.floating, exact: Fraction | None, off: float | None) -> Parts:
    """Return a float's text with its wrong digits apart; `off` is its error, in ulp.

    A digit is wrong where the error is more than half of one in its place; none is in a number that
    is correctly rounded.
    """
    whole = digits_text(value)
    if exact is None or not np.isfinite(value) or (off is not None and off <= 0.5):
        return Parts(whole)
    mantissa, mark, power = whole.partition("e")
    exponent = int(power) if mark else 0
    error, parts = _error(value, exact)
    point = mantissa.find(".") if "." in mantissa else len(mantissa)
    for at, sign in enumerate(mantissa):
        if sign.isdigit():
            place = point - at - 1 if at < point else point - at
            power_of_10 = place + exponent
            if 2 * error * 10 ** max(-power_of_10, 0) > parts * 10 ** max(power_of_10, 0):
                return Parts(mantissa[:at], mantissa[at:], mark + power)
    return Parts(whole)


def off_text(off: float | None) -> str:
    """Return an error in ulp, short: 0, 0.31, 2.5, 840, 1.2e+07; "–" where there is none."""
    if off is None:
        return "–"
    if off == 0:
        return "0"
    return f"{off:.2g}" if off < 99.5 else f"{off:.0f}" if off < 1e5 else f"{off:.1e}"
