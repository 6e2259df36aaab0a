"""Certified t against integers: rounded once, and within its clip range as the exact one is."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.tracer.camera import Rays

from ..oracle import intersect_pairs, rounded
from ..rays import nearest_hits


def generic(rng, n):
    """Nothing special; about a third hit."""
    corners = rng.normal(size=(3, 3, n))
    weights = rng.uniform(-0.4, 1, (3, n))
    o = rng.normal(size=(3, n)) * 4
    return o, (weights / weights.sum(axis=0) * corners.transpose(1, 0, 2)).sum(axis=1) - o, corners


def whole_numbers(rng, n):
    """Small integers: every third ray meets an edge, a corner, or nothing that has an area."""
    o, d = rng.integers(-3, 4, (2, 3, n)).astype(float)
    d[2, ~d.any(axis=0)] = 1
    return o, d, rng.integers(-3, 4, (3, 3, n)).astype(float)


@pytest.mark.parametrize("shared", ["nothing", "origin", "direction"])
@pytest.mark.parametrize(
    "lengths, directions", [(0, 0), (500, -500), (-500, 500), (-530, 530), (520, -505)]
)
def test_t_is_correctly_rounded(rng, shared, lengths, directions):
    """The float nearest to the exact t, the even one of two; inf above all floats; subnormals."""
    found = []
    for _ in range(6):
        corners = rng.normal(size=(3, 3, 1)) * 2.0**lengths
        target = corners.mean(axis=0) + 0.2 * rng.normal(size=(3, 400)) * 2.0**lengths
        away = rng.normal(size=(3, 400)) * 2.0**lengths
        faster = [2.0**directions, 2.0**-lengths]  # one by one: together they may overflow
        o, d = target - away, away * faster[1] * faster[0]
        if shared == "origin":
            o, d = o[:, :1], (target - o[:, :1]) * faster[1] * faster[0]
        d = d * 2.0 ** rng.integers(-8, 9, 400)
        if shared == "direction":
            o, d = target - away[:, :1] * rng.uniform(0.5, 2, 400), d[:, :1]
        seen = nearest_hits(Rays(o, d), corners)
        o, d = (np.broadcast_to(v, (3, 400)) for v in (o, d))
        result = intersect_pairs(o, d, corners.repeat(400, axis=2))
        hit = np.flatnonzero(result.within() & result.hit)
        assert np.array_equal(hit, np.flatnonzero(seen.triangle == 0))
        assert all(seen.t[k] == rounded(result.t(k)) for k in hit)
        found += seen.t[hit].tolist()
    assert len(found) > 400
    assert (np.inf in found) == (lengths == 520)
    assert (min(found) < np.finfo(float).tiny) == (lengths == -530)


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


def test_the_clip_range_is_exact_at_its_ends(rng):
    """Limits at the float nearest to t and beside it: those that t itself is within decide."""
    told = 0
    for family in (generic, whole_numbers):
        o, d, corners = family(rng, 3000)
        result = intersect_pairs(o, d, corners)
        hit = np.flatnonzero(result.within() & result.hit)[:40]
        assert len(hit) == 40
        for k in hit:
            exact = result.t(k)
            near = float(exact)
            pair = Rays(o[:, [k]], d[:, [k]]), corners[:, :, [k]]
            for limit in (np.nextafter(near, 0), near, np.nextafter(near, np.inf)):
                assert decide(*pair, limit).crossed.item() == (limit <= exact)
                assert decide(*pair, 0.0, limit).crossed.item() == (exact <= limit)
                assert decide(*pair, limit, limit).crossed.item() == (exact == limit)
                assert (nearest_hits(*pair, limit).triangle == 0).item() == (limit <= exact)
                assert (nearest_hits(*pair, -1.0, limit).triangle == 0).item() == (exact <= limit)
            told += exact != near
    assert 20 < told < 80


def test_the_least_and_the_most_that_there_can_be():
    """No pair, no triangle, no direction, no size: nothing is hit, and nothing is in the way."""
    none = np.zeros((3, 0))
    assert decide(Rays(none, none), np.zeros((3, 3, 0))).crossed.shape == (0,)
    ray = Rays(np.zeros((3, 1)), np.array([[0], [0], [1.0]]))
    assert nearest_hits(ray, np.zeros((3, 3, 0))).triangle.tolist() == [-1]
    corners = np.array([[-1.0, -1, 1], [2, -1, 1], [0, 3, 1]])[:, :, None]
    for o, d in (((0, 0, 0), (0, 0, 0)), ((0, 0, 1), (0, 0, 0)), ((-1, -1, 1), (0, 0, 0))):
        still = Rays(np.array(o, float)[:, None], np.array(d, float)[:, None])
        assert not decide(still, corners).crossed.any()
        assert nearest_hits(still, corners).triangle.tolist() == [-1]
    points = corners[:, :, [0, 0]] * 0
    both = Rays(np.zeros((3, 2)), np.array([[0, 1], [0, 0], [1.0, 0]]))
    assert not decide(both, points).crossed.any() and not decide(both, points + 1).crossed.any()
