"""The sine has the bits that its operations say, and is as near as its bound says."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.projections.sine import sine

BOUND = Fraction(1, 2**51)
_UNIT = 1 << 1700  # of fixed point: what is left out is far below the bound


def true_sine(angle: float, quarters: int) -> Fraction:
    """By the whole series from 0, in fixed point: no reduction, no pi."""
    x, k = Fraction(float(angle)), 2 - quarters
    size = x.numerator * _UNIT // x.denominator
    term, total = (_UNIT if quarters else size), 0
    while abs(term) > 1:
        total += term
        term, k = -(term * size // _UNIT) * size // _UNIT // (k * (k + 1)), k + 2
    return Fraction(total, _UNIT)


def angles(rng) -> np.ndarray:
    """Everywhere, and around the multiples of pi / 4, where the parts of the series meet."""
    turns = np.arange(-9, 10) * np.pi / 4
    near = np.concatenate([turns * (1 + k * 2.0**-52) for k in range(-3, 4)])
    return np.concatenate((near, rng.uniform(-7, 7, 300), rng.uniform(-1024, 1024, 8)))


@pytest.mark.slow
def test_it_is_within_its_bound(rng):
    worst = Fraction(0)
    for quarters in (0, 1):
        given = angles(rng)
        for angle, found in zip(given.tolist(), sine(given, quarters).tolist(), strict=True):
            error = abs(Fraction(found) - true_sine(angle, quarters))
            assert error < BOUND, angle
            worst = max(worst, error)
    assert worst > BOUND / 16  # or the bound would say little


def test_what_it_is_asked_together_with_changes_no_bit(rng):
    given = angles(rng)
    for quarters in (0, 1):
        whole = sine(given, quarters)
        assert [float(sine(a, quarters)) for a in given] == whole.tolist()
        assert np.array_equal(sine(given[::3], quarters), whole[::3])


def test_of_a_float32_it_is_rounded_once_more(rng):
    given = angles(rng).astype(np.float32)
    for quarters in (0, 1):
        found = sine(given, quarters)
        assert found.dtype == np.float32
        assert np.array_equal(found, sine(given.astype(float), quarters).astype(np.float32))


def test_right_angles():
    assert sine(np.array(0.0)) == 0 and sine(np.array(0.0), 1) == 1
    half = np.array([np.pi / 2, -np.pi / 2, np.pi])
    assert sine(half).tolist()[:2] == [1, -1] and sine(half, 1)[2] == -1
    assert (np.abs(sine(half, 1)[:2]) < 1e-16).all() and abs(sine(half)[2]) < 2e-16
