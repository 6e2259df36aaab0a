"""No float is farther from the truth than its bound says, however hostile the numbers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.bounds import Fractions, FromPoint, Parallel, plane_fractions
from reference_tracer.tracer.camera import Rays

from ..tracer.rational import functions, plane_functions, rational

pytestmark = pytest.mark.filterwarnings("error")
COUNT = 120
SCALES = (0, -300, 300, -170, 170, -340, -352, -358, 336)  # of lengths: 3 of them are multiplied


def ordinary(rng):
    return rng.normal(size=(3, COUNT)), rng.normal(size=(3, COUNT)), rng.normal(size=(3, 3, COUNT))


def far(rng):
    """Small things far from the world's origin: what is left of the subtractions is little."""
    o, d, c = ordinary(rng)
    place = 10.0 ** rng.uniform(3, 12, COUNT) * rng.normal(size=(3, COUNT))
    return o + place, d, c + place


def distant(rng):
    """Small things far from the rays' origins, which aim at them."""
    o, _, c = ordinary(rng)
    o *= 10.0 ** rng.uniform(3, 12, COUNT)
    return o, c.mean(axis=0) - o, c


def cancelling(rng):
    """Rays through corners, through points of edges, and within the triangle's plane."""
    o, _, c = ordinary(rng)
    share = rng.random(COUNT)
    inner = rng.dirichlet((1, 1, 1), COUNT).T
    ways = (c[0] - o, c[0] + share * (c[1] - c[0]) - o, (c[1] - c[0]) + share * (c[2] - c[0]))
    o[:, 200:] = (inner[:, None] * c).sum(axis=0)[:, 200:]  # T is almost zero
    return o, np.choose(rng.integers(0, 3, COUNT), ways), c


def slivers(rng):
    o, d, c = ordinary(rng)
    c[2] = c[0] + rng.random(COUNT) * (c[1] - c[0]) * (1 + 2.0**-40 * rng.normal(size=(3, COUNT)))
    return o, np.where(rng.random(COUNT) < 0.5, c[2] - o, d), c


def uneven(rng):
    """Components of any size beside one another."""
    return tuple(v * 2.0 ** rng.integers(-60, 60, v.shape) for v in ordinary(rng))


def whole(rng):
    """Small integers: many exact zeros, and corners that coincide."""
    return tuple(rng.integers(-2, 3, v.shape).astype(float) for v in ordinary(rng))


FAMILIES = (ordinary, far, distant, cancelling, slivers, uneven, whole)
EVERY_FAMILY = pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)


@pytest.fixture(params=SCALES, ids="{:+}".format)
def scaled(request, rng):
    """Return what scales a family: lengths by this, directions to suit or by something else."""

    def make(family):
        o, d, c = family(rng)
        lengths = 2.0**request.param
        directions = 2.0 ** rng.integers(-300, 300, COUNT if family is uneven else 1)
        with np.errstate(under="ignore"):
            return o * lengths, d * (directions if rng.random() < 0.5 else 1), c * lengths

    return make


def assert_within(value, error, exact):
    """Assert that |value - exact| <= error where both are finite; returns how many are."""
    value, error = np.broadcast_arrays(value, error)
    known = np.isfinite(value) & np.isfinite(error)
    off = np.abs(rational(value[known]) - exact[known])
    assert (off <= rational(error[known])).all()
    assert not (np.abs(value[~known]) > error[~known]).any()  # no sign is called known
    return int(known.sum())


def check(prepared, rows, rays, exact):
    """Assert the bounds of pairs, and that the interval encloses t; returns shares."""
    with np.errstate(all="ignore"):
        edges, error = prepared.edges(rows, rays)
        fractions = prepared.fractions(rows, rays)
    e, depth, towards = exact
    finite = assert_within(edges, error, e)
    for found, off, truth in (
        (fractions.numerator, fractions.numerator_error, depth),
        (fractions.denominator, fractions.denominator_error, towards),
    ):
        finite += assert_within(
            *np.broadcast_arrays(found, off, fractions.numerator)[:2], exact=truth
        )
    sure = (np.abs(edges) > error).mean()
    return finite / (5 * len(rows)), sure, check_interval(fractions, depth, towards)


def check_interval(fractions: Fractions, depth, towards):
    """Assert that t lies in its interval, where it exists and is not negative."""
    with np.errstate(all="ignore"):
        low, high = np.broadcast_arrays(*fractions.interval())
        size = np.abs(np.broadcast_to(fractions.denominator, low.shape))
        unknown = ~(size > fractions.denominator_error)
    assert not np.isnan(low).any() and not np.isnan(high).any()
    assert np.isposinf(high[unknown]).all()
    for k in np.flatnonzero(towards != 0):
        t = depth[k] / towards[k]
        if t >= 0 or np.isfinite(high[k]):
            assert low[k] == -np.inf or Fraction(low[k]) <= t
            assert high[k] == np.inf or t <= Fraction(high[k])
    return np.isfinite(high).mean()


@pytest.mark.slow
@EVERY_FAMILY
def test_pair_by_pair(family, scaled):
    o, d, c = scaled(family)
    rays = Rays(o, d)
    with np.errstate(all="ignore"):
        prepared = FromPoint(o, np.abs(d), c)
    check(prepared, np.arange(COUNT), rays, functions(o, d, c))


@pytest.mark.slow
@EVERY_FAMILY
def test_many_rays_from_one_point(family, scaled, rng):
    o, d, c = scaled(family)
    rows = rng.integers(0, 40, COUNT)
    with np.errstate(all="ignore"):
        reach = np.abs(d).max(axis=1, keepdims=True)
        prepared = FromPoint(o[:, :1], reach, c[..., :40])
    exact = functions(np.broadcast_to(o[:, :1], d.shape), d, c[..., rows])
    check(prepared, rows, Rays(o[:, :1], d), exact)


@pytest.mark.slow
@EVERY_FAMILY
def test_many_rays_of_one_direction(family, scaled, rng):
    o, d, c = scaled(family)
    rows = rng.integers(0, 40, COUNT)
    low, high = (f(o, axis=1, keepdims=True) for f in (np.min, np.max))
    with np.errstate(all="ignore"):
        prepared = Parallel(d[:, :1], low, high, c[..., :40])
    exact = functions(o, np.broadcast_to(d[:, :1], o.shape), c[..., rows])
    check(prepared, rows, Rays(o, d[:, :1]), exact)


@EVERY_FAMILY
def test_planes(family, scaled, rng):
    o, d, c = scaled(family)
    normal = c[1] if rng.random() < 0.5 else rng.normal(size=(3, COUNT))
    with np.errstate(all="ignore"):
        fractions = plane_fractions(Rays(o, d), c[0], normal)
    depth, towards = plane_functions(o, d, c[0], normal)
    assert_within(fractions.numerator, fractions.numerator_error, depth)
    assert_within(fractions.denominator, fractions.denominator_error, towards)
    check_interval(fractions, depth, towards)


@pytest.mark.parametrize("scale", [0, -300, 300])
def test_the_bounds_decide_what_is_ordinary(scale, rng):
    """Not so wide that they would say nothing."""
    o, d, c = ordinary(rng)
    o, c = o * 2.0**scale, c * 2.0**scale
    prepared = FromPoint(o, np.abs(d), c)
    finite, sure, enclosed = check(prepared, np.arange(COUNT), Rays(o, d), functions(o, d, c))
    assert finite == 1 and sure > 0.999 and enclosed > 0.999
    low, high = prepared.fractions(np.arange(COUNT), Rays(o, d)).interval()
    assert np.median((high - low) / np.abs(low)) < 1e-13


def test_near_underflow_nothing_is_known():
    """Where every product is lost, zero is not taken for a number."""
    o, d = np.zeros((3, 1)), np.array([[1.0], [2], [3]])
    corners = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1.0]])[:, :, None] * 2.0**-540
    with np.errstate(all="ignore"):
        prepared = FromPoint(o, np.abs(d), corners)
        edges, error = prepared.edges(np.zeros(1, int), Rays(o, d))
        low, high = prepared.fractions(np.zeros(1, int), Rays(o, d)).interval()
    assert (np.abs(edges) <= error).all() and low == 0 and np.isposinf(high)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_never_known(bad, rng):
    for where in range(3):
        o, d, c = ordinary(rng)
        (o, d, c)[where][..., 1, :] = bad
        with np.errstate(all="ignore"):
            prepared = FromPoint(o, np.abs(d), c)
            edges, error = prepared.edges(np.arange(COUNT), Rays(o, d))
            fractions = prepared.fractions(np.arange(COUNT), Rays(o, d))
            low, high = fractions.interval()
        assert not ((np.abs(edges) > error).all(axis=0)).any()
        assert (np.isinf(high) & (low <= 0)).all()
