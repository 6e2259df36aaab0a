"""The exact oracle against closed forms, and against fractions worked out here in another way."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.scene import Mesh

from .oracle import (
    EDGE,
    INSIDE,
    OUTSIDE,
    intersect_pairs,
    scaled_integers,
    scene_sights,
)

TINY = Fraction(1, 2**2000)  # beside integers of a few digits


def det(a, b, c):
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def fractions(*vectors):
    return [[Fraction(float(x)) for x in v] for v in vectors]


def met(o, d, corners, by=(0, 0, 0)):
    """Return (t, the least barycentric) by Cramer's rule in fractions; None for a miss."""
    o, d, p1, p2, p3 = fractions(o, d, *corners)
    e1, e2, q = ([a - b for a, b in zip(v, p1, strict=True)] for v in (p2, p3, o))
    against = [-x - b for x, b in zip(d, by, strict=True)]
    whole = det(e1, e2, against)
    if whole == 0:
        return None
    u, v, t = (n / whole for n in (det(q, e2, against), det(e1, q, against), det(e1, e2, q)))
    least = min(u, v, 1 - u - v)
    return None if least < 0 else (t, least)


def first_sign(o, d, a, b):
    """The sign of the edge a b by the rule as it is written: d . m, else m_x, m_y, m_z."""
    o, d, a, b = fractions(o, d, a, b)
    a, b = ([x - y for x, y in zip(v, o, strict=True)] for v in (a, b))
    m = [det(axis, a, b) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    values = [v for v in (sum(x * y for x, y in zip(d, m, strict=True)), *m) if v]
    return 0 if not values else 1 if values[0] > 0 else -1


def small_integers(rng, count):
    """Pairs that often meet edges, corners, or nothing of any area."""
    o, d = (rng.integers(-2, 3, (3, count)).astype(float) for _ in range(2))
    return o, d, rng.integers(-2, 3, (3, 3, count)).astype(float)


def any_size(rng, count):
    o, d, c = (rng.normal(size=(*k, count)) for k in ((3,), (3,), (3, 3)))
    size = 2.0 ** rng.integers(-300, 300, count)
    d *= 2.0 ** rng.integers(-500, 500, count)
    c[:, 0] *= 2.0 ** rng.integers(-8, 8, count)
    return o * size, d, c * size


def test_the_unit_triangle_in_closed_form():
    """Rays straight down at multiples of 1/8: inside where x, y and 1 - x - y are positive.

    Moved by (e, e^2), a ray on the boundary is inside but at the edge x + y = 1.
    """
    x, y = (v.ravel() / 8 for v in np.meshgrid(np.arange(-2, 11), np.arange(-2, 11)))
    triangle = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0.0)])[:, :, None].repeat(len(x), axis=2)
    down = np.array([[0], [0], [-2.0]]).repeat(len(x), axis=1)
    given = intersect_pairs(np.stack((x, y, np.full(len(x), 3.0))), down, triangle)
    assert np.array_equal(given.side, np.sign(np.minimum(np.minimum(x, y), 1 - x - y)))
    assert np.array_equal(given.hit, (x >= 0) & (y >= 0) & (x + y < 1))
    assert {given.t(k) for k in np.flatnonzero(given.side != OUTSIDE)} == {Fraction(3, 2)}
    assert (given.side == EDGE).sum() == 24


@pytest.mark.slow
@pytest.mark.parametrize("family", [small_integers, any_size])
def test_pairs_are_those_of_fractions(rng, family):
    o, d, c = family(rng, 3000)
    given = intersect_pairs(o, d, c)
    seen = dict.fromkeys((OUTSIDE, EDGE, INSIDE), 0)
    for k in range(3000):
        found = met(o[:, k], d[:, k], c[:, :, k])
        side = OUTSIDE if found is None else INSIDE if found[1] else EDGE
        assert given.side[k] == side
        assert found is None or given.t(k) == found[0]
        seen[side] += 1
    assert min(seen[OUTSIDE], seen[INSIDE]) > 100
    assert (seen[EDGE] > 200) == (family is small_integers)


@pytest.mark.slow
def test_the_moved_ray_is_that_of_the_rule_and_of_a_tiny_fraction(rng):
    o, d, c = small_integers(rng, 6000)
    given = intersect_pairs(o, d, c)
    on_edge = np.flatnonzero((given.side == EDGE) & [t != 0 for t in given.numerator])
    assert 0.1 < given.hit[on_edge].mean() < 0.9
    assert len(on_edge) > 300
    for k in on_edge:
        column = o[:, k], d[:, k]
        signs = {first_sign(*column, c[i, :, k], c[i - 2, :, k]) for i in range(3)}
        assert given.hit[k] == (len(signs) == 1)
        assert 0 not in signs  # nothing is left undecided where t is not 0
        moved = met(*column, c[:, :, k], (TINY, TINY**2, TINY**3))
        assert given.hit[k] == (moved is not None and moved[1] > 0)


def test_the_range_is_closed_and_a_ray_does_not_meet_where_it_begins():
    o, d = np.zeros((3, 4)), np.array([[0.0, 0, 1]] * 4).T
    c = np.array([[-1.0, -1, 0], [2, -1, 0], [0, 3, 0]])[:, :, None].repeat(4, axis=2)
    c[:, 2] = (0, 1, 1, 5e-324)
    c[:, 2, 2] = np.nextafter(1, 0)
    given = intersect_pairs(o, d, c)
    assert given.within(0, 1).tolist() == [False, True, True, True]
    assert given.within(1, 1).tolist() == [False, True, False, False]
    assert given.within(-1, 0).tolist() == [True, False, False, False]


def test_integers_are_the_floats(rng):
    values = rng.normal(size=(3, 50)) * 10.0 ** rng.integers(-300, 300, (3, 50))
    values[:, 0], values[:, 1] = (0, -0.0, 5e-324), 0
    whole, exponent = scaled_integers(values)
    assert exponent.min() < -1000
    for floats, ints, e in zip(values.T, whole.T, exponent, strict=True):
        assert [Fraction(n) * Fraction(2) ** int(e) for n in ints] == fractions(floats)[0]


def test_what_is_not_finite_is_not_seen(make):
    """A corner that the object's matrix takes to infinity: its triangles are left out."""
    points, triangles = make.quad(-20, 40, -30, 70, -2).vertices.copy(), [[0, 1, 2], [0, 2, 3]]
    points[1, 0] = 1e200
    scene = make.scene(make.camera(4, 3), Mesh(points, triangles), make.quad(-20, 40, -30, 70, -3))
    far = replace(scene.instances[0], world_from_object=np.diag((1e200, 1, 1, 1.0)))
    seen = {s.seen for s in scene_sights(replace(scene, instances=(far, scene.instances[1])))}
    assert (0, 0) not in seen and any(i == 1 for i, _ in seen)
