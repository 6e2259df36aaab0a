"""Who is seen, and ties: by a ray that is truly moved."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.certified.ties import seen_and_ties
from reference_tracer.tracer.camera import Rays

from ..moved import may
from ..oracle import sights
from ..tracer.rational import functions, plane_functions, rational

pytestmark = pytest.mark.filterwarnings("error")
NOTHING = (-1, -1)
TINY = Fraction(1, 2**2000)  # beside integers of a few digits: infinitesimal
BY = rational(np.array([TINY, TINY**2, TINY**3], object))


def small(rng, *shape):
    """Integers so small that rays often meet edges, corners and two surfaces at once."""
    return rng.integers(-2, 3, shape).astype(float)


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
