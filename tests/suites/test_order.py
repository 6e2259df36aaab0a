"""Who is the nearest: among surfaces an ulp apart, that tie, that are the same, at any size."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.tracer.camera import Rays

from ..moved import may, touched
from ..oracle import sights
from ..rays import nearest_hits
from .families import FAMILIES, SIZES, at_any_size

torture = pytest.mark.torture


KINDS = pytest.mark.parametrize("kind", ["an ulp apart", "duplicates", "crossing"])
SHARE = pytest.mark.parametrize("share", ["nothing", "origin", "direction"])


def layers(rng, kind, share, behind=False):
    """A few triangles whose order is hard to tell, and 40 rays through them, or away from them."""
    o = rng.uniform(-4, 4, (3, 40)) / (5 if behind else 1)
    if kind == "an ulp apart":
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        flat = rng.uniform(-1, 1, (3, 3, 6))
        flat[:, 2] = 5 * (1 + rng.integers(0, 5, 6) * 2.0**-52)
        corners = sum(turn[:, k][None, :, None] * flat[:, k][:, None] for k in range(3))
        o = rng.uniform(-0.1, 0.1, (3, 40))
    elif kind == "duplicates":
        corners = rng.uniform(-1, 1, (3, 3, 3))[:, :, [0, 1, 0, 2, 1, 0]]
        for k in range(6):
            corners[:, :, k] = corners[rng.permutation(3), :, k]
    else:  # small integers, so that surfaces meet each other, and edges, on the very ray
        corners = rng.integers(-2, 3, (3, 3, 6)).astype(float)
        o = rng.integers(-3, 4, (3, 40)).astype(float)
    target = corners.mean(axis=0)[:, rng.integers(6, size=40)]
    if kind == "crossing":
        target = rng.integers(-4, 5, (3, 40)) / rng.choice((1, 2, 4), 40)
    if share == "origin":
        o = o[:, :1]
    d = target - o
    if share == "direction":
        o, d = o + (target - target[:, :1] - o + o[:, :1]), d[:, :1]
    if behind and share == "direction":
        o = o + d * rng.choice((0, 2), 40)
    elif behind:
        d = d * rng.choice((-1, 1), 40)
    d[0, ~d.any(axis=0)] = 1
    return o, d, corners


@SHARE
@KINDS
@pytest.mark.parametrize("start", [0.0, -40.0])
@pytest.mark.parametrize("count", [12, pytest.param(500, marks=torture)])
def test_the_order_of_hits(rng, kind, share, start, count):
    """Before and behind where the rays begin, too: an orthographic camera may see behind itself."""
    seen = behind = open_answers = 0
    for _ in range(count):
        o, d, corners = layers(rng, kind, share, start < 0)
        hits = nearest_hits(Rays(o, d), corners, start)
        o, d = (np.broadcast_to(v, (3, 40)) for v in (o, d))
        expected = sights(o, d, corners, clip=(start, np.inf))
        off = np.array([not begins_on(o[:, k], corners) for k in range(40)]) | (start == 0)
        given = list(zip(hits.instance.tolist(), hits.triangle.tolist(), strict=True))
        wrong = [k for k in np.flatnonzero(off) if given[k] != expected[k].seen]
        assert not wrong, (o[:, wrong], d[:, wrong], corners)
        seen += (hits.triangle >= 0).sum()
        behind += (hits.t < 0).sum()
        open_answers += sum(len(touched(s)) > 1 for s in expected)
    assert seen > 2 * count
    assert (behind > count) == (start < 0)
    if kind != "an ulp apart":
        assert open_answers > 2 * count


def begins_on(point, corners) -> bool:
    """Whether an origin lies in the plane of a triangle: what it sees there is told elsewhere."""
    n = np.cross(corners[1] - corners[0], corners[2] - corners[0], axis=0)
    return bool((((corners[0] - point[:, None]) * n).sum(axis=0) == 0).any())


@SHARE
@pytest.mark.parametrize("start", [0.0, -1.0])
def test_surfaces_through_where_the_rays_begin(rng, share, start):
    """All of them but for rounding: some are met at a tiny t, some at a tiny t below 0."""
    seen = 0
    for _ in range(25):
        corners = rng.normal(size=(3, 3, 6))
        o = rng.normal(size=(3, 1))
        weights = rng.dirichlet((1, 1, 1), 6).T
        corners += o - (weights[:, None] * corners).sum(axis=0)
        d = rng.normal(size=(3, 1 if share == "direction" else 20))
        if share != "origin":
            o = o + rng.integers(-2, 3, (3, 20)) * 2.0**-53
        hits = nearest_hits(Rays(o, d), corners, start)
        o, d = (np.broadcast_to(v, (3, 20)) for v in (o, d))
        off = [k for k in range(20) if start == 0 or not begins_on(o[:, k], corners)]
        expected = sights(o, d, corners, clip=(start, np.inf))
        assert [hits.triangle[k] for k in off] == [expected[k].seen[1] for k in off]
        seen += (hits.triangle >= 0).sum()
    assert seen > 300


@SHARE
@KINDS
def test_ties_name_all_that_moved_rays_see(rng, kind, share):
    """`ties` misses nothing that some infinitesimally moved ray sees, and makes nothing up."""
    for _ in range(10):
        o, d, corners = layers(rng, kind, share)
        hits = nearest_hits(Rays(o, d), corners)
        o, d = (np.broadcast_to(v, (3, 40)) for v in (o, d))
        for ray, sight in enumerate(sights(o, d, corners)):
            ties = hits.ties.get(ray, frozenset((sight.seen,)))
            assert may(sight) <= ties <= touched(sight)


@SHARE
@pytest.mark.parametrize("count", [1, pytest.param(40, marks=torture)])
def test_batches_at_any_size(share, count):
    """One bound for all rays from a point, or along a direction, whatever else is in the batch."""
    seen = 0
    for number in range(count):
        for family in FAMILIES:
            for how in SIZES:
                rng = np.random.default_rng([number, FAMILIES.index(family), SIZES.index(how)])
                o, d, corners = at_any_size(rng, *family(rng, 24), how=how)
                o, d = np.broadcast_to(o, (3, 24)).copy(), np.broadcast_to(d, (3, 24)).copy()
                if share == "origin":
                    o = o[:, :1]
                if share == "direction":
                    d = d[:, :1]
                hits = nearest_hits(Rays(o, d), corners[:, :, ::2])
                o, d = (np.broadcast_to(v, (3, 24)) for v in (o, d))
                expected = [s.seen[1] for s in sights(o, d, corners[:, :, ::2])]
                assert hits.triangle.tolist() == expected
                seen += (hits.triangle >= 0).sum()
    assert seen > 200 * count
