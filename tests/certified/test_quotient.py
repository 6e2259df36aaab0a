"""Sums and products have no error; and where t is said to be the nearest float64, it is."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified import quotient
from reference_tracer.certified.quotient import Quotients
from reference_tracer.tracer.camera import Rays

from ..tracer.rational import functions, plane_functions, rational, rounded

pytestmark = pytest.mark.filterwarnings("error")
COUNT = 400
MANY = 1500


def triangles(rng, scale=0, place=0.0):
    o, d, c = (rng.normal(size=(*k, COUNT)) for k in ((3,), (3,), (3, 3)))
    return (o + place) * 2.0**scale, d, (c + place) * 2.0**scale


def found_t(rays, surface, corners):
    with np.errstate(all="ignore"):
        return Quotients.of(rays, corners).meet(rays, surface)


def found_t_of_planes(rays, surface, point, normal):
    planes = list(zip(point.T, normal.T, strict=True))
    with np.errstate(all="ignore"):
        return Quotients.of(rays, np.zeros((3, 3, 0)), planes).meet(rays, surface)


def truth(depth, towards):
    return np.array([rounded(t) for t in depth / towards])


def assert_right(t, sure, expected):
    assert np.array_equal(t[sure], expected[sure])


@pytest.mark.slow
@pytest.mark.parametrize("scale", [0, -300, 300])
@pytest.mark.parametrize("place", [0.0, 1e3, 1e8])
@pytest.mark.parametrize("shared", ["nothing", "origin", "direction"])
def test_triangles(rng, scale, place, shared):
    o, d, c = triangles(rng, scale, place)
    if shared == "origin":
        o = o[:, :1]
    if shared == "direction":
        d = d[:, :1]
    rows = rng.integers(0, 50, COUNT)
    t, sure = found_t(Rays(o, d), rows, c[..., :50])
    o, d = (np.broadcast_to(v, (3, COUNT)) for v in (o, d))
    _, depth, towards = functions(o, d, c[..., rows])
    assert_right(t, sure, truth(depth, towards))
    assert sure.mean() > 0.99


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("kind", ["origin in the plane", "direction in the plane"])
def test_where_almost_all_digits_cancel(rng, kind, shared):
    """T or D has lost many digits of a float: the 72 that there are do not do for all t."""
    o, d, c = triangles(rng)
    s = rng.normal(size=(2, COUNT))
    within = s[0] * (c[1] - c[0]) + s[1] * (c[2] - c[0])
    within += 2.0 ** -rng.integers(1, 40, COUNT) * rng.normal(size=(3, COUNT))
    if kind.startswith("origin"):
        o = c[0] + within
    else:
        d = within
    if shared:
        o, c = np.zeros((3, 1)), c - o
    t, sure = found_t(Rays(o, d), np.arange(COUNT), c)
    _, depth, towards = functions(np.broadcast_to(o, d.shape), d, c)
    possible = towards != 0
    expected = truth(depth[possible], towards[possible])
    assert_right(t[possible], sure[possible], expected)
    assert not sure[~possible].any() and 0.1 < sure.mean() < 0.9
    assert (t[possible] != expected).any()  # what is not sure may be wrong


@pytest.mark.parametrize("shared", ["origin", "direction"])
@pytest.mark.parametrize("kind", ["flat", "far", "wide", "tiny"])
def test_almost_all_that_a_camera_sees_is_sure(rng, kind, shared):
    """One power of two serves all its rays; fractions judge some of them, of any scale."""
    count, unsure = 20_000, {"flat": 1e-3, "far": 2e-3, "wide": 1e-2, "tiny": 2e-3}[kind]
    wide = {"flat": 0.5, "wide": 40.0}.get(kind, 1.0)
    aside = np.stack((*rng.uniform(-wide, wide, (2, count)), np.zeros(count)))
    forward = np.array([[0.0], [0], [1]])
    size = 1e-4 if kind == "tiny" else 1.0
    c = rng.normal(size=(3, 3, count)) * size
    c[:, 2] *= 0.1 if kind == "flat" else 0.5
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    c += 3 * (aside + forward) if shared == "origin" else aside + 3 * forward
    o, d = (0 * forward, aside + forward) if shared == "origin" else (aside, forward)
    o, d, c = turn @ o, turn @ d, turn @ c
    if kind == "far":  # as a scene at 100 km, to float32
        o, c = o + 1e5, (c + 1e5).astype(np.float32).astype(float)
    factor = 2.0 ** rng.integers(-250, 250)
    rays, c = Rays(o * factor, d), c * factor
    t, sure = found_t(rays, np.arange(count), c)
    some = rng.permutation(count)[:100]
    o, d = (np.broadcast_to(v, (3, count))[:, some] for v in (rays.origins, rays.directions))
    _, depth, towards = functions(o, d, c[..., some])
    assert_right(t[some], sure[some], truth(depth, towards))
    assert 1 - sure.mean() < unsure


@pytest.mark.parametrize("shared", ["nothing", "origin", "direction"])
def test_rays_in_parts_are_the_same(rng, shared):
    o, d, c = triangles(rng)
    o, d = {"origin": (o[:, :1], d), "direction": (o, d[:, :1])}.get(shared, (o, d))
    rows, rays = rng.integers(0, 50, COUNT), Rays(o, d)
    prepared = Quotients.of(rays, c)
    whole = prepared.meet(rays, rows)
    for part in np.split(np.arange(COUNT), range(7, COUNT, 7)):
        for some, expected in zip(prepared.meet(rays.take(part), rows[part]), whole, strict=True):
            assert np.array_equal(some, expected[part])


@pytest.mark.parametrize("orthographic", [False, True])
def test_planes(rng, orthographic):
    o, d, c = triangles(rng)
    o, d = (o, d[:, :1]) if orthographic else (o[:, :1], d)
    point, normal = c[0, :, :5], c[1, :, :5]
    rows = rng.integers(0, 5, COUNT)
    t, sure = found_t_of_planes(Rays(o, d), rows, point, normal)
    o, d = (np.broadcast_to(v, (3, COUNT)) for v in (o, d))
    assert_right(t, sure, truth(*plane_functions(o, d, point[:, rows], normal[:, rows])))
    assert sure.mean() > 0.99


def near_midpoints(rng, off):
    """Planes whose t has 54 digits, the last of them set: between two floats, but for `off`.

    T = (p - o) . n with p - o = (whole, half, tiny) and n = (1, 1, off); D is a power of two.
    """
    whole = rng.integers(2**52, 2**53, COUNT).astype(float)
    point = np.stack((whole, np.full(COUNT, 0.5), np.full(COUNT, 1.0)))
    normal = np.stack((np.ones(COUNT), np.ones(COUNT), np.full(COUNT, off)))
    towards = 2.0 ** rng.integers(-3, 4, COUNT)
    directions = np.stack((towards, np.zeros(COUNT), np.zeros(COUNT)))
    return point, normal, directions


@pytest.mark.parametrize("shared", [False, True])
@pytest.mark.parametrize("exponent", [None, -4, -10, -20, -40, -51, -54, -70, -100, -1000])
@pytest.mark.parametrize("sign", [1, -1])
def test_beside_the_middle_of_two_floats(rng, shared, exponent, sign):
    off = 0.0 if exponent is None else sign * 2.0**exponent
    point, normal, directions = near_midpoints(rng, off)
    rows, origins = np.arange(COUNT), np.zeros((3, 1 if shared else COUNT))
    rays = Rays(origins, directions)
    t, sure = found_t_of_planes(rays, rows, point, normal)
    both = np.zeros((3, COUNT)), directions
    expected = truth(*plane_functions(*both, point, normal))
    assert_right(t, sure, expected)
    if exponent is None or exponent < -60:
        assert not sure.any()  # nothing short of all digits can say
    if exponent is not None and exponent >= -10:
        assert sure.all()
        down = np.floor(point[0] / directions[0] / np.spacing(t)) * np.spacing(t)
        assert ((t > down) == (sign > 0)).all()


def test_triangles_in_the_middle_of_two_floats(rng):
    """Axis-aligned triangles before an orthographic camera: T has 54 digits, D is a power of 2."""
    height = 2.0 ** rng.integers(-2, 3, COUNT)
    z = rng.integers(2**52, 2**53, COUNT).astype(float)
    flat = np.array([[-4.0, -4, 0], [4, -4, 0], [0, 4, 0]])[:, :, None] * np.ones(COUNT)
    flat[:, 2] = z
    origins = np.stack((np.zeros(COUNT), np.zeros(COUNT), np.full(COUNT, -0.5)))
    directions = np.stack((np.zeros(COUNT), np.zeros(COUNT), height))
    t, sure = found_t(Rays(origins, directions), np.arange(COUNT), flat)
    _, depth, towards = functions(origins, directions, flat)
    assert_right(t, sure, truth(depth, towards))
    assert not sure.any()


@pytest.mark.parametrize("scale", [-331, -338, -345, -352, -360, -1000, 325, 332, 340, 1000])
def test_what_under_or_overflows_is_not_called_sure(rng, scale):
    o, d, c = triangles(rng, scale)
    t, sure = found_t(Rays(o, d), np.arange(COUNT), c)
    _, depth, towards = functions(o, d, c)
    assert_right(t, sure, truth(depth, towards))


def test_what_the_ray_is_parallel_to_is_not_sure():
    corners = np.array([[0.0, 0, 1], [1, 0, 1], [0, 1, 1]])[:, :, None]
    rays = Rays(np.zeros((3, 1)), np.array([[1.0], [2], [0]]))
    _, sure = found_t(rays, np.zeros(1, int), corners)
    assert not sure.any()


def floats(rng, count=MANY):
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
    found = quotient.two_sum(a, b)
    assert (exact(found) == rational(a) + rational(b)).all()
    assert np.array_equal(found[0], a + b)


@pytest.mark.parametrize("exponent", [0, -300, 300])
def test_products_of_highest_digits_are_exact(rng, exponent):
    """With each other, and with what they leave of a float: nothing of it is lost."""
    a, b = floats(rng)
    a = a * 2.0**exponent
    top, other = quotient.highest(a), quotient.highest(b)
    assert (abs(a - top) <= abs(a) * 2.0**-25).all() and (abs(top) <= abs(a)).all()
    for factor in (other, b - other):
        assert (rational(top * factor) == rational(top) * rational(factor)).all()
    assert (rational(b - other) == rational(b) - rational(other)).all()


@pytest.mark.parametrize("exponent", [0, -300, 300])
def test_products_of_high_halves_are_exact(rng, exponent):
    """Of two vectors: the sum of the three products too, in any order."""
    u, v = rng.normal(size=(2, 3, MANY)) * 2.0 ** rng.integers(-30, 30, (2, 3, MANY))
    v = v * 2.0**exponent
    (uh, ul), (vh, vl) = (quotient.halves(w, quotient.power_above(w)) for w in (u, v))
    for w, high, low in ((u, uh, ul), (v, vh, vl)):
        assert (rational(high) + rational(low) == rational(w)).all()
        unit = quotient.power_above(w)
        assert (abs(w) < unit).all() and (unit <= 2 * abs(w).max(axis=0)).all()
        assert (abs(low) <= unit * 2.0 ** -(quotient.BITS + 1)).all()
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
        high, low = quotient.halves(x * 1e300, quotient.power_above(x) * 1e300)
        assert not np.isfinite(high + low).any()
