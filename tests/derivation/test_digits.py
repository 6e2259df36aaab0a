"""Numbers as text: whole, correctly rounded, and marked where they are wrong."""

from __future__ import annotations

from decimal import Decimal, localcontext
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.derivation.digits import (
    EXACT_DIGITS,
    digits_text,
    exact_text,
    last_place,
    marked,
    off_text,
    ulps,
)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_floats_read_back_to_the_bit(rng, kind):
    bits = rng.integers(0, 2 ** (8 * np.dtype(kind).itemsize), 3000, dtype=np.uint64)
    values = bits.astype(f"uint{8 * np.dtype(kind).itemsize}").view(kind)
    finite = [v for v in (*values, kind(0), kind(-0.0), np.finfo(kind).max) if np.isfinite(v)]
    assert len(finite) > 2000
    for value in finite:
        again = kind(float(digits_text(value)))  # by way of float64, as a JSON reader goes
        assert again == value and np.signbit(again) == np.signbit(value)
    assert digits_text(kind(np.inf)) == "inf" and digits_text(kind(np.nan)) == "nan"


def test_exact_numbers_are_correctly_rounded(rng):
    for _ in range(300):
        a, b = (int(v) for v in rng.integers(1, 2**62, 2))
        exact = Fraction(a, b) * Fraction(10) ** int(rng.integers(-40, 40))
        exact *= int(rng.choice([-1, 1]))
        shown = exact_text(exact)
        rest = abs(Fraction(Decimal(shown.replace("…", ""))) - exact)
        with localcontext() as context:
            context.prec = 60
            place = (Decimal(exact.numerator) / Decimal(exact.denominator)).adjusted()
        assert 2 * rest <= Fraction(10) ** (place - EXACT_DIGITS + 1)
        assert ("…" in shown) == bool(rest)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_ulps_are_those_of_numpy(rng, kind):
    for _ in range(200):
        value = kind(rng.normal() * 10.0 ** rng.integers(-30, 30))
        exact = Fraction(float(value))
        assert 2.0 ** last_place(exact, kind) == np.spacing(np.abs(value))
        assert ulps(value, exact) == 0
        assert ulps(np.nextafter(value, kind(np.inf)), exact) == pytest.approx(1)
    smallest = np.finfo(kind).smallest_subnormal
    assert 2.0 ** last_place(Fraction(float(smallest)) / 4, kind) == smallest
    assert ulps(kind(1), Fraction(0)) is None and ulps(kind(0), Fraction(0)) == 0
    assert ulps(kind(np.inf), Fraction(1)) is None and ulps(kind(1), None) is None


def test_digits_that_are_wrong_are_marked():
    def of(value, exact):
        return marked(value, exact, ulps(value, exact))

    third = Fraction(1, 3)
    assert of(np.float64(1 / 3), third).wrong == ""  # as good as it can be
    assert of(np.float64(0.333344), third) == ("0.3333", "44", "")
    assert of(np.float64(-0.333344), -third) == ("-0.3333", "44", "")
    assert of(np.float64(0.75), Fraction(0)) == ("", "0.75", "")
    assert of(np.float64(-0.5), Fraction(1, 2)) == ("-", "0.5", "")
    assert of(np.float64(1.25e-20), Fraction(1, 10**20)) == ("1.", "25", "e-20")
    assert of(np.float64(1.0000004e30), Fraction(10**30)) == ("1.000000", "4", "e+30")
    assert of(np.float32(1.0000001), Fraction(1)).wrong == "1"
    assert of(np.float64(0.99999), Fraction(1)).right == "0.9999"  # 0.99999 is off by 0.1 here
    assert of(np.float64(np.nan), third) == ("nan", "", "")


@pytest.mark.parametrize(
    ("off", "shown"),
    [
        (None, "–"),
        (0.0, "0"),
        (0.31, "0.31"),
        (12.4, "12"),
        (8412.3, "8412"),
        (123456.0, "1.2e+05"),
    ],
)
def test_errors_are_short(off, shown):
    assert off_text(off) == shown
