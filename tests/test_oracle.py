"""The exact oracle against closed forms, and against fractions worked out here in another way."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
import trimesh
from reference_tracer.scene import Mesh
from reference_tracer.tracer.hits import NOWHERE

from .moved import may
from .oracle import (
    EDGE,
    INSIDE,
    OUTSIDE,
    intersect_pairs,
    scaled_integers,
    scene_sights,
    sights,
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


def test_what_may_be_seen_is_what_moved_rays_see(make, rng):
    """Rays moved by 2^-40, in hundreds of directions: no sector is missed, and none is made up."""
    fan = np.array([[np.cos(a), np.sin(a), -2] for a in rng.uniform(0, 2 * np.pi, 24)])
    order = np.argsort(np.arctan2(fan[:, 1], fan[:, 0]))
    fan = np.round(fan[order] * 16) / 16
    corners = np.stack([np.array([(0, 0, -2.0), fan[k - 1], fan[k]]) for k in range(24)], axis=2)
    corners = np.delete(corners, [3, 4, 11], axis=2)  # what is behind may be seen through these
    behind = np.array([[-9.0, -9, -3], [9, -9, -3], [0, 20, -3]])[:, :, None]
    slanted = np.array([[-9.0, -9, -3], [9, -9, -3], [0, 9, -3]])[:, :, None]
    corners = np.concatenate((corners, behind, slanted), axis=2)
    corners[:, 2, -1] += corners[:, 0, -1] / 4
    o, d = np.zeros((3, 1)), np.array([[0], [0], [-1.0]])
    [sight] = sights(o, d, corners)
    ways = rng.normal(size=(3, 800)) * 2.0**-40
    moved = sights(np.zeros((3, 800)), d + ways, corners)
    assert {s.seen for s in moved} == may(sight)
    assert len(may(sight)) > 20


def moved_hits(o, d, corners):
    """What the ray d + (x, x^2, x^3) crosses, the nearest first: (t of it, index)."""
    by = TINY, TINY**2, TINY**3
    found = ((met(o, d, corners[:, :, k], by), k) for k in range(corners.shape[2]))
    return sorted((hit[0], k) for hit, k in found if hit)


def check(o, d, corners):
    """Check one ray against fractions: what it sees, its t, and how many it crosses."""
    o, d = np.asarray(o, float), np.asarray(d, float)
    [sight] = sights(o[:, None], d[:, None], corners)
    hits = [(t, k) for t, k in moved_hits(o, d, corners) if t > 0]
    assert sight.seen == ((0, hits[0][1]) if hits else NOWHERE)
    assert sight.t == (met(o, d, corners[:, :, hits[0][1]])[0] if hits else None)
    assert sight.crossings == len(hits)
    return sight


@pytest.fixture
def box():
    """A cube of 4 m about the origin: its vertices, and the corners of its triangles."""
    cube = trimesh.creation.box((4, 4, 4))
    return cube.vertices, cube.vertices[cube.faces].transpose(1, 2, 0)


def test_a_closed_surface_is_crossed_once_from_inside(box):
    """Integers: every ray meets a corner, an edge or a diagonal."""
    vertices, corners = box
    centers = corners.mean(axis=0).T
    for target in [*vertices, *centers, (2, 0, 0), (2, 2, 0)]:
        assert check((0, 0, 0), target, corners).crossings == 1
    for target in vertices:
        assert check((1, 0, 1), target - (1, 0, 1), corners).crossings == 1


def test_an_outline_is_crossed_twice_or_not_at_all(box):
    for x in (-2, 0, 2):
        for y in (-2, 1, 2):
            assert check((x, y, 9), (0, 0, -1), box[1]).crossings in (0, 2)


def test_two_that_meet_at_the_ray_are_ordered_by_the_moved_one():
    """Two planes through one point of the ray: to the side it is moved to, one is nearer."""
    slopes = [[[-9, -9, 5 + s * -9], [9, -9, 5 + s * 9], [0, 9, 5]] for s in (1, -1)]
    corners = np.array(slopes, float).transpose(1, 2, 0)
    assert check((0, 0, 0), (0, 0, 1), corners).seen == (0, 1)
    assert check((0, 0, 0), (0, 0, 1), corners[:, :, ::-1]).seen == (0, 0)


def test_what_is_not_finite_is_not_seen(make):
    """A corner that the object's matrix takes to infinity: its triangles are left out."""
    points, triangles = make.quad(-20, 40, -30, 70, -2).vertices.copy(), [[0, 1, 2], [0, 2, 3]]
    points[1, 0] = 1e200
    scene = make.scene(make.camera(4, 3), Mesh(points, triangles), make.quad(-20, 40, -30, 70, -3))
    far = replace(scene.instances[0], world_from_object=np.diag((1e200, 1, 1, 1.0)))
    seen = {s.seen for s in scene_sights(replace(scene, instances=(far, scene.instances[1])))}
    assert (0, 0) not in seen and any(i == 1 for i, _ in seen)
