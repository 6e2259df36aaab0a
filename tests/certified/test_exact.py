"""Integers: they are the floats, and the ray of the rule is a ray that is truly moved."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from reference_tracer.certified.exact import Hit, IntegerBatch, sign_of_difference
from reference_tracer.certified.integers import integers
from reference_tracer.certified.ties import seen_and_ties
from reference_tracer.tracer.camera import Rays

from ..moved import may
from ..oracle import sights
from ..tracer.rational import functions, plane_functions, rational, rounded

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = (-1, -1)
TINY = Fraction(1, 2**2000)  # beside integers of a few digits: infinitesimal
BY = rational(np.array([TINY, TINY**2, TINY**3], object))
PAIRS = 2000


def small(rng, *shape):
    """Integers so small that rays often meet edges, corners and two surfaces at once."""
    return rng.integers(-2, 3, shape).astype(float)


def hits(rng, count=PAIRS, scale=0, **clip):
    """Return rays, triangles, and what meets; the rays all begin in their own corner."""
    o, d, c = small(rng, 3, count), small(rng, 3, count), small(rng, 3, 3, count)
    o, c = o * 2.0**scale, c * 2.0**scale
    batch = IntegerBatch(Rays(o, d), c, **clip)
    return o, d, c, batch, [batch.hit(k, k) for k in range(count)]


def one_ray(rng, count, planes=0):
    """Return a ray with what it meets of triangles and planes, and its own fractions."""
    o, d = small(rng, 3, 1), small(rng, 3, 1)
    c = small(rng, 3, 3, count)
    solids = [(v[:3], v[3:]) for v in small(rng, planes, 6) if v[3:].any()]
    batch = IntegerBatch(Rays(o, d), c, solids)
    names = [(1, k) for k in range(len(solids))] + [(0, k) for k in range(count)]
    found = [(name, batch.hit(0, k)) for k, name in enumerate(names)]
    return o, d, c, solids, [(name, m) for name, m in found if m]


def moved_t(o, d, c, solids, name):
    """Return t of the ray that is truly moved; None where it misses."""
    d = rational(d[:, 0]) + BY
    if name[0] == 1:
        depth, towards = plane_functions(o, d[:, None], *(v[:, None] for v in solids[name[1]]))
        return depth[0] / towards[0]
    edges, depth, towards = functions(o, d[:, None], c[:, :, name[1], None])
    inside = (edges > 0).all() or (edges < 0).all()
    return depth[0] / towards[0] if inside else None


def test_integers_are_the_floats(rng):
    values = rng.normal(size=(3, 60)) * 10.0 ** rng.integers(-300, 300, (3, 60))
    values[:, 0], values[:, 1], values[0, 2] = (0, -0.0, 5e-324), 0, 1.7e308
    whole, exponent = integers(values)
    scale = Fraction(2) ** exponent
    assert [tuple(n * scale for n in column) for column in whole] == [
        tuple(Fraction(x) for x in column) for column in values.T
    ]
    assert all(isinstance(n, int) for column in whole for n in column)
    assert integers(np.zeros((3, 2)))[0] == [(0, 0, 0)] * 2
    assert integers(np.zeros((3, 0)))[0] == []


@pytest.mark.parametrize("scale", [0, -1000, 900])
def test_a_hit_is_the_closed_triangle_and_its_hit_the_moved_rays(rng, scale):
    o, d, c, _, found = hits(rng, scale=scale)
    edges, depth, towards = functions(o, d, c)
    on_edge = 0
    for k, m in enumerate(found):
        e = edges[:, k]
        closed = (e >= 0).all() or (e <= 0).all()
        seen = closed and towards[k] != 0 and depth[k] / (towards[k] or 1) > 0
        assert (m is not None) == seen
        if m:
            assert m.on_edge == (0 in e)
            moved, _, _ = functions(o[:, k], rational(d[:, k]) + BY, c[:, :, k])
            assert m.is_crossed() == bool((moved > 0).all() or (moved < 0).all())
            on_edge += m.on_edge
    assert on_edge > 60


def test_compare_is_the_order_of_the_moved_rays_t(rng):
    ties = 0
    for _ in range(300):
        o, d, c, solids, found = one_ray(rng, 12, planes=3)
        depths = {}
        for name, m in found:
            t = moved_t(o, d, c, solids, name)
            assert (t is not None) == m.is_crossed()
            if t is not None:
                depths[name] = t
        hits = [(name, m) for name, m in found if name in depths]
        for a, first in hits:
            for b, second in hits:
                gap = depths[a] - depths[b]
                assert sign_of_difference(first, second) == (gap > 0) - (gap < 0)
                ties += a != b and abs(gap) < Fraction(1, 2**1000)
    assert ties > 20


def test_compare_is_an_order(rng):
    """Also between what the moved ray does not hit: antisymmetric, and transitive."""
    triples = 0
    for _ in range(60):
        found = [m for _, m in one_ray(rng, 10, planes=3)[-1]]
        signs = [[sign_of_difference(a, b) for b in found] for a in found]
        count = len(found)
        for a in range(count):
            for b in range(count):
                assert signs[a][b] == -signs[b][a]
                for c in range(count):
                    if signs[a][b] <= 0 and signs[b][c] <= 0:
                        assert signs[a][c] <= 0
                        triples += 1
    assert triples > 200


def test_nearest_is_what_the_moved_ray_sees(rng):
    several = ambiguous = 0
    for _ in range(250):
        o, d, c, solids, found = one_ray(rng, 12, planes=2)
        rng.shuffle(found)
        seen, ties = seen_and_ties(found)
        hits = [(moved_t(o, d, c, solids, name), name) for name, _ in found]
        hits = sorted((t, name) for t, name in hits if t is not None)
        name = found[seen][0] if seen >= 0 else NOTHING
        assert name == (hits[0][1] if hits else NOTHING)
        assert not ties or (name in ties and len(ties) > 1)
        assert ties <= {name for name, _ in found} | {NOTHING}
        several += len(hits) > 1
        ambiguous += bool(ties)
    assert several > 30 and ambiguous > 30


def sight(corners, direction=(0, 0, -1)):
    """Return what the one ray from the origin sees, its ties, and the oracle's answer."""
    o, d = np.zeros((3, 1)), np.array(direction, float)[:, None]
    c = np.array(corners, float).transpose(1, 2, 0)
    batch = IntegerBatch(Rays(o, d), c)
    found = [((0, k), batch.hit(0, k)) for k in range(c.shape[2])]
    seen, ties = seen_and_ties([(name, m) for name, m in found if m])
    return seen, {k if i == 0 else None for i, k in ties}, sights(o, d, c)[0]


LEFT, RIGHT = [(0, -1, -2), (0, 1, -2), (-3, 0, -2)], [(0, -1, -2), (0, 1, -2), (3, 0, -2)]
WALL = [(-9, -9, -3), (9, -9, -3), (0, 19, -3)]


def test_an_edge_inside_a_surface_and_one_on_its_outline():
    seen, ties, judged = sight([LEFT, RIGHT])
    assert ties == {0, 1} and seen in ties and may(judged) == {(0, 0), (0, 1)}
    for one in (LEFT, RIGHT):
        _, ties, judged = sight([one])
        assert ties == {0, None} and may(judged) == {(0, 0), NOTHING}
        _, ties, judged = sight([one, WALL])
        assert ties == {0, 1} and may(judged) == {(0, 0), (0, 1)}
    assert sight([WALL])[1] == set()
    assert sight([WALL, LEFT, RIGHT])[1] == {1, 2}
    assert sight([WALL, WALL])[:2] == (0, {0, 1})


def test_a_thin_gap_beside_a_corner_is_among_the_ties():
    """A fan around the ray lacks a slice of 15 degrees: what is behind may be seen there, too."""
    angle = np.radians(np.r_[25, 90, 150, 210, 270, 330, 370])
    rim = [(8 * np.cos(a), 8 * np.sin(a), -2) for a in angle]
    fan = [[(0, 0, -2), p, q] for p, q in pairwise(rim)]
    _, ties, judged = sight([*fan, WALL])
    assert may(judged) == {(0, k) for k in range(7)}
    assert ties == set(range(7))


@pytest.mark.parametrize("scale", [0, -1050, 950])
def test_t_is_correctly_rounded(rng, scale):
    o, d, c = (rng.normal(size=(*k, 400)) for k in ((3,), (3,), (3, 3)))
    with np.errstate(under="ignore"):
        o, c = o * 2.0**scale, c * 2.0**scale
    d *= 2.0 ** rng.integers(-60, 60, 400)
    batch = IntegerBatch(Rays(o, d), c, start=-np.inf)
    _, depth, towards = functions(o, d, c)
    checked = 0
    for k in range(400):
        if m := batch.hit(k, k):
            assert batch.t(m) == rounded(depth[k] / towards[k])
            checked += 1
    assert checked > 20


def test_t_too_large_or_too_small_for_a_float():
    corners = np.array([[-1.0, -1, 1], [2, -1, 1], [0, 3, 1]])[:, :, None]
    for length, direction, expected in (
        (2.0**600, 2.0**-600, np.inf),
        (2.0**-600, 2.0**600, 0.0),
        (2.0**-600, 2.0**474, 2.0**-1074),
    ):
        d = np.array([[0], [0], [direction]])
        batch = IntegerBatch(Rays(np.zeros((3, 1)), d), corners * length)
        assert batch.t(batch.hit(0, 0)) == expected
        behind = IntegerBatch(Rays(np.zeros((3, 1)), -d), corners * length, start=-np.inf)
        assert behind.t(behind.hit(0, 0)) == -expected


@pytest.mark.parametrize("scale", [0, -700, 700])
def test_the_clip_range_is_inclusive_and_exact(rng, scale):
    """A surface exactly on an end is seen, one beside it by a rounding is not."""
    inside = Fraction(2) ** scale
    for start, end in ((0.75, 1.5), (0.0, 1.5), (-1.5, 0.75), (-1.0, 0.0), (0.1, np.inf)):
        o, d, c, _, found = hits(rng, 700, scale, start=start * inside, end=end * inside)
        _, depth, towards = functions(o, d, c)
        for k, m in enumerate(hits_of_all(o, d, c)):
            t = depth[k] / towards[k] if m else None
            open_ = start == 0 and t == 0
            expected = m is not None and start * inside <= t <= end * inside and not open_
            assert (found[k] is not None) == expected


def hits_of_all(o, d, c) -> list[Hit | None]:
    batch = IntegerBatch(Rays(o, d), c, start=-np.inf)
    return [batch.hit(k, k) for k in range(o.shape[1])]


def test_clip_ends_a_rounding_away(rng):
    z = rng.uniform(1, 2, 50)
    for k in range(50):
        point, normal = np.array([0, 0, -z[k]]), np.array([0, 0, 3.0])
        rays = Rays(np.zeros((3, 1)), np.array([[0.3], [0.1], [-1]]))
        for start, end, seen in (
            (z[k], np.inf, True),
            (np.nextafter(z[k], 9), np.inf, False),
            (0, z[k], True),
            (0, np.nextafter(z[k], 0), False),
        ):
            batch = IntegerBatch(rays, np.zeros((3, 3, 0)), [(point, normal)], start, end)
            assert (batch.hit(0, 0) is not None) == seen
