"""Sums, products and halves of floats have no error: fractions decide."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.tracer.certified import error_free as ef

from ..rational import rational

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


def exact(x):
    return rational(x[0]) + rational(x[1])


@pytest.mark.parametrize("exponent", [0, -300, 300])
def test_sums_of_floats_are_exact(rng, exponent):
    a, b = (v * 2.0**exponent for v in floats(rng))
    found = ef.two_sum(a, b)
    assert (exact(found) == rational(a) + rational(b)).all()
    assert np.array_equal(found[0], a + b)


@pytest.mark.parametrize("exponent", [0, -300, 300])
def test_products_of_floats_are_exact(rng, exponent):
    a, b = floats(rng)
    a = a * 2.0**exponent
    found = ef.two_product(a, b)
    assert (exact(found) == rational(a) * rational(b)).all()
    assert np.array_equal(found[0], a * b)


def test_the_fast_sum_is_exact_where_the_first_is_larger(rng):
    a, b = floats(rng)
    large, small = np.where(abs(a) >= abs(b), (a, b), (b, a))
    found = ef.fast_two_sum(large, small)
    assert (exact(found) == rational(a) + rational(b)).all()


@pytest.mark.parametrize("exponent", [0, -300, 300])
def test_products_of_high_halves_are_exact(rng, exponent):
    """Of two vectors: the sum of the three products too, in any order."""
    u, v = rng.normal(size=(2, 3, COUNT)) * 2.0 ** rng.integers(-30, 30, (2, 3, COUNT))
    v = v * 2.0**exponent
    (uh, ul), (vh, vl) = (ef.halves(w, ef.power_above(w)) for w in (u, v))
    for w, high, low in ((u, uh, ul), (v, vh, vl)):
        assert (rational(high) + rational(low) == rational(w)).all()
        unit = ef.power_above(w)
        assert (abs(w) < unit).all() and (unit <= 2 * abs(w).max(axis=0)).all()
        assert (abs(low) <= unit * 2.0 ** -(ef.BITS + 1)).all()
    truth = sum(rational(uh[k]) * rational(vh[k]) for k in range(3))
    for order in ((0, 1, 2), (2, 0, 1), (1, 2, 0)):
        x, y, z = (uh[k] * vh[k] for k in order)
        assert (rational(x + y + z) == truth).all()
        assert (rational(x - y) == rational(x) - rational(y)).all()


@pytest.mark.parametrize("large", [1e300, np.inf])
def test_an_overflow_is_seen(large):
    """What is too large ends in NaN or inf, never in a number that passes for one."""
    x = np.full((3, 1), large)
    with np.errstate(all="ignore"):
        for high, low in (ef.two_product(x, x), ef.halves(x * 1e300, ef.power_above(x) * 1e300)):
            assert not np.isfinite(high + low).any()
