"""The certified decisions against integers: no pair, no order, no t may be wrong.

Some hundred thousand pairs always (131,072), and eight hundred times as many under `make torture`:
at the 20 microseconds a pair that this took when it was written, 35 minutes on one core.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.tracer.camera import Rays

from ..oracle import EDGE, intersect_pairs
from ..rays import nearest_hits
from .families import FAMILIES, at_any_size, generic, whole_numbers

torture = pytest.mark.torture
SIZES = (*("as it is", "all") * 5, "each", "each", "each", "mixed", "smallest", "largest")
CHUNK = 1 << 10
CHUNKS = len(SIZES)  # of each family; always 16 * 8 * 2^10 = 2^17 pairs


@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)
@pytest.mark.parametrize("chunks", [CHUNKS, pytest.param(800 * CHUNKS, marks=torture)])
def test_pairs_of_every_family_and_size(family, chunks):
    hits = edges = exact = 0
    for number in range(chunks):
        rng = np.random.default_rng([number, FAMILIES.index(family)])
        how = SIZES[number % len(SIZES)]
        o, d, corners = at_any_size(rng, *family(rng, CHUNK), how=how)
        decision = decide(Rays(o, d), corners)
        shape = (3, CHUNK)
        result = intersect_pairs(np.broadcast_to(o, shape), np.broadcast_to(d, shape), corners)
        met = result.within()
        wrong = (decision.crossed != (met & result.hit)) | (
            decision.edge != (met & (result.side == EDGE))
        )
        assert not wrong.any(), (how, number, np.flatnonzero(wrong))
        hits += decision.crossed.sum()
        edges += decision.edge.sum()
        exact += decision.exact.sum()
    pairs = chunks * CHUNK
    assert 0.02 < hits / pairs < 0.9
    assert edges <= exact
    if family.__name__ in ("at_vertices", "parallel", "whole_numbers"):
        assert edges > 0.01 * pairs  # true ties


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
        assert all(is_nearest_float(seen.t[k], result.t(k)) for k in hit)
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


def is_nearest_float(value: float, exact: Fraction) -> bool:
    if value == np.inf:  # half an ulp above the largest, or more
        return exact >= 2**1024 - 2**970
    error = abs(Fraction(value) - exact)
    for neighbour in (np.nextafter(value, -np.inf), np.nextafter(value, np.inf)):
        if neighbour != np.inf:
            other = abs(Fraction(float(neighbour)) - exact)
            even = not int(np.float64(value).view(np.int64)) & 1
            if error > other or (error == other and not even):
                return False
    return True


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
