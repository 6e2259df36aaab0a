"""Twice the digits: sums and products of floats are exact, everything else as good as it says."""

from __future__ import annotations

import operator

import numpy as np
import pytest
from reference_tracer.tracer import double_double as dd

from .rational import rational

pytestmark = pytest.mark.filterwarnings("error")
COUNT = 1500


def floats(rng, count=COUNT):
    """Random digits and sizes, with many that nearly cancel, powers of two, zeros."""
    a = rng.normal(size=count) * 2.0 ** rng.integers(-60, 60, count)
    b = rng.normal(size=count) * 2.0 ** rng.integers(-60, 60, count)
    near = rng.random(count) < 0.3
    b[near] = -a[near] * (1 + rng.integers(-4, 5, near.sum()) * 2.0**-52)
    for v in (a, b):
        v[rng.random(count) < 0.1] = 2.0 ** rng.integers(-50, 50)
        v[rng.random(count) < 0.03] = 0
        full = rng.random(count) < 0.1  # all digits set
        v[full] = np.nextafter(2.0 ** rng.integers(-50, 50, full.sum()), 0)
    return a, b


def pairs(rng):
    """Two double-double numbers, (high, low) each; some nearly cancel."""
    out = []
    for high in floats(rng):
        low = rng.uniform(-0.5, 0.5, COUNT) * np.spacing(high)
        low[rng.random(COUNT) < 0.1] = 0
        out.append(dd.two_sum(high, low))
    return out


def exact(x):
    return rational(x[0]) + rational(x[1])


def check(found, truth):
    """Assert the relative error, and that the low part is at most half a digit of the high."""
    assert (np.abs(exact(found) - truth) <= rational(dd.ERROR) * np.abs(truth)).all()
    assert (np.abs(found[1]) <= 0.5 * np.spacing(np.abs(found[0]))).all()


@pytest.mark.parametrize("exponent", [0, -300, 300])
def test_sums_of_floats_are_exact(rng, exponent):
    a, b = (v * 2.0**exponent for v in floats(rng))
    found = dd.two_sum(a, b)
    assert (exact(found) == rational(a) + rational(b)).all()
    assert np.array_equal(found[0], a + b)


@pytest.mark.parametrize("exponent", [0, -300, 300])
def test_products_of_floats_are_exact(rng, exponent):
    a, b = floats(rng)
    a = a * 2.0**exponent
    found = dd.two_product(a, b)
    assert (exact(found) == rational(a) * rational(b)).all()
    assert np.array_equal(found[0], a * b)


@pytest.mark.parametrize(
    "found, truth",
    [(dd.add, operator.add), (dd.multiply, operator.mul), (dd.divide, operator.truediv)],
    ids=["add", "multiply", "divide"],
)
@pytest.mark.parametrize("exponent", [0, -150, 150])
def test_relative_error(rng, found, truth, exponent):
    x, y = pairs(rng)
    if found is dd.divide:
        keep = y[0] != 0
        x, y = ((high[keep], low[keep]) for high, low in (x, y))
    x, y = (tuple(v * 2.0**exponent for v in pair) for pair in (x, y))
    check(found(x, y), truth(exact(x), exact(y)))


def test_relative_error_of_scale_and_negative(rng):
    x, (y, _) = pairs(rng)
    check(dd.scale(x, y), exact(x) * rational(y))
    check(dd.negative(x), -exact(x))


def test_a_sum_of_opposites_is_zero(rng):
    x, _ = pairs(rng)
    high, low = dd.add(x, dd.negative(x))
    assert not high.any() and not low.any()


@pytest.mark.parametrize("large", [1e300, np.inf])
def test_an_overflow_is_seen(large):
    """What is too large ends in NaN or inf, never in a number that passes for one."""
    x = np.array([large]), np.zeros(1)
    with np.errstate(all="ignore"):
        for high, low in (dd.multiply(x, x), dd.two_product(*[x[0]] * 2), dd.scale(x, x[0])):
            assert not np.isfinite(high + low).any()
