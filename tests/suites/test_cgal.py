"""CGAL: the predicates' static filters against exact arithmetic, and an AABB tree's first hit.

*Static_filters.cpp* compares each filtered predicate with MP_Float, for random points, points that
are coplanar up to rounding, and such moved by 2^-40, in four orders of the arguments. The predicate
here is the whole decision of a ray and a triangle. Its answer may depend on the order of the
corners in nothing at all, as an edge belongs to a place, not to a triangle.

*AABB_tree ray test*: 1000 rays with the seed 23; the first hit is the least of all hits.
"""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from reference_tracer.certified.any_rays import decide
from reference_tracer.tracer.camera import Rays

from ..oracle import EDGE, intersect_pairs, sights
from ..rays import nearest_hits
from .meshes import bumpy_sphere, corners_of

LOOPS = pytest.mark.parametrize("loops", [2000, pytest.param(200_000, marks=pytest.mark.torture)])


def points(rng, loops, kind):
    """A ray's origin and end and three corners, (3, n) each: its end in their plane, or nearly."""
    p, q, r, o = rng.uniform(-1, 1, (4, 3, loops))
    if kind == "random":
        return o, rng.uniform(-1, 1, (3, loops)), p, q, r
    u, v = rng.uniform(-0.25, 1.25, (2, loops))
    v[::2] = 0  # on an edge but for rounding
    end = p + u * (q - p) + v * (r - p)
    o = p + rng.uniform(-2, 2, loops) * (q - p) + rng.uniform(-2, 2, loops) * (r - p)
    if kind == "moved":
        o = o + 2.0**-40 * rng.choice((-1, 1), (3, loops))
        end = end + 2.0**-40 * rng.choice((-1, 1), (3, loops))
    return o, end, p, q, r


@LOOPS
@pytest.mark.parametrize("kind", ["random", "coplanar", "moved"])
def test_static_filters(rng, loops, kind):
    """200,000 loops of 6 orders each take half a minute under `make torture`."""
    o, end, *corners = points(rng, loops, kind)
    corners, rays = np.stack(corners), Rays(o, end - o)
    result = intersect_pairs(o, end - o, corners)
    truth = result.within() & result.hit
    decisions = [decide(rays, corners[list(order)]) for order in permutations(range(3))]
    for decision in decisions:
        assert np.array_equal(decision.crossed, truth)
        assert np.array_equal(decision.edge, result.within() & (result.side == EDGE))
    assert 0.01 < truth.mean() < 0.9
    needed = decisions[0].exact.mean()
    assert needed > 0.3 if kind == "coplanar" else needed < 0.3


@pytest.mark.parametrize("kind", ["coplanar", "moved"])
def test_the_plane_of_three_points_and_a_fourth(rng, kind):
    """Origins in the plane up to rounding, directions across it: which side they begin on."""
    o, _, *corners = points(rng, 2000, kind)
    u, v = rng.dirichlet((1, 1, 1), 2000).T[:2]
    o = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0])
    o += (2.0**-40 if kind == "moved" else 0) * rng.choice((-1, 1), o.shape)
    d = rng.normal(size=o.shape)
    decision = decide(Rays(o, d), np.stack(corners))
    result = intersect_pairs(o, d, np.stack(corners))
    assert np.array_equal(decision.crossed, result.within() & result.hit)
    assert 0.3 < decision.crossed.mean() < 0.6
    away = decide(Rays(o, -d), np.stack(corners)).crossed
    on = result.numerator == 0
    assert np.array_equal(decision.crossed[~on], ~away[~on])  # from beside it, one of the two ways
    assert not (decision.crossed | away)[on].any()


def test_first_hit_is_the_least_of_all():
    """Of 1000 rays: the triangle, and its t correctly rounded."""
    rng = np.random.default_rng(23)
    corners = corners_of(*bumpy_sphere(rng, False))
    o, d = rng.uniform(-6, 6, (3, 1000)), rng.uniform(-1, 1, (3, 1000))
    chosen = rng.choice(corners.shape[2], 150, replace=False)
    corners = corners[:, :, chosen]
    seen = nearest_hits(Rays(o, d), corners)
    expected = [s.seen for s in sights(o, d, corners)]
    assert [(int(i), int(k)) for i, k in zip(seen.instance, seen.triangle, strict=True)] == expected
    hit = np.flatnonzero(seen.triangle >= 0)
    assert 100 < len(hit) < 900
    result = intersect_pairs(o[:, hit], d[:, hit], corners[:, :, seen.triangle[hit]])
    assert seen.t[hit].tolist() == [float(result.t(k)) for k in range(len(hit))]
    assert (seen.t[seen.triangle < 0] == np.inf).all()
