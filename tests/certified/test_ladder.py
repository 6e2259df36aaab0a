"""The nearest hit, proven: as exact arithmetic has it, ray by ray and pair by pair.

The oracle is written apart (`tests/oracle.py`): all rays with all triangles, in integers, and
the ray of the rule truly moved.
"""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from reference_tracer.certainty import Certainty, Reason
from reference_tracer.certified.ladder import Ladder
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.world import Pairs, WorldTriangles

from ..moved import may, touched
from ..oracle import sights
from ..rays import nearest_hits

pytestmark = pytest.mark.filterwarnings("error")
RAYS, TRIANGLES = 60, 30


def ordinary(rng):
    return (
        rng.normal(size=(3, RAYS)),
        rng.normal(size=(3, RAYS)),
        rng.normal(size=(3, 3, TRIANGLES)),
    )


def whole(rng):
    """Small integers: edges, corners, ties, triangles without area, rays in their planes."""
    o, d = rng.integers(-3, 4, (3, RAYS)), rng.integers(-2, 3, (3, RAYS))
    d[:, ~d.any(axis=0)] = 1
    return o * 1.0, d * 1.0, rng.integers(-3, 4, (3, 3, TRIANGLES)) * 1.0


def nearly_coplanar(rng):
    """Each triangle again, turned within its plane, but for rounding."""
    o, d, c = ordinary(rng)
    half = TRIANGLES // 2
    c[..., half:] = c[..., :half]
    c[2, :, half:] += rng.uniform(-0.3, 0.3, half) * (c[1] - c[0])[:, half:]
    return o, d, c


def through_corners(rng):
    """Rays at corners and points of edges, as near as float64 gets, far from the world's origin."""
    o, _, c = ordinary(rng)
    c += 1e6 * rng.normal(size=(3, 1))
    o += c[0].mean(axis=1, keepdims=True)
    rows = rng.integers(0, TRIANGLES, RAYS)
    share = rng.choice([0, 0.5, rng.random()], RAYS)
    target = c[0][:, rows] + share * (c[1] - c[0])[:, rows]
    return o, target - o, c


def uneven(rng):
    return tuple(v * 2.0 ** rng.integers(-40, 40, v.shape) for v in ordinary(rng))


FAMILIES = (ordinary, whole, nearly_coplanar, through_corners, uneven)
EVERY_FAMILY = pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)


def share(o, d, what):
    return Rays(o[:, :1] if what == "origin" else o, d[:, :1] if what == "direction" else d)


def check(rays, corners, start=0.0, end=np.inf) -> Hits:
    """Assert that all is as the oracle says."""
    hits = nearest_hits(rays, corners, start, end)
    origins, directions = (
        np.broadcast_to(v, (3, len(hits.t))) for v in (rays.origins, rays.directions)
    )
    for k, truth in enumerate(sights(origins, directions, corners, clip=(start, end))):
        name = int(hits.instance[k]), int(hits.triangle[k])
        assert name == truth.seen
        assert hits.t[k] == truth.rounded_t
        ambiguous = hits.certainty[k] == Certainty.AMBIGUOUS
        assert ambiguous == (len(touched(truth)) > 1) == (k in hits.ties)
        assert ambiguous or hits.certainty[k] in (Certainty.BOUND, Certainty.EXACT)
        ties = hits.ties.get(k, {name})
        assert name in ties and may(truth) <= ties <= touched(truth)
    return hits


@pytest.mark.slow
@pytest.mark.parametrize("what", ["nothing", "origin", "direction", "both"])
@EVERY_FAMILY
def test_nearest(rng, family, what):
    seen = Counter()
    for _ in range(3):
        o, d, c = family(rng)
        rays = share(o, d, what) if what != "both" else Rays(o[:, :1], d[:, :1])
        hits = check(rays, c)
        seen.update(hits.certainty.tolist())
    if what != "both":
        assert seen[Certainty.BOUND] + seen[Certainty.EXACT] > 30
        assert seen[Certainty.AMBIGUOUS] > 10 or family is not whole


@pytest.mark.slow
@pytest.mark.parametrize("what", ["nothing", "origin", "direction"])
@pytest.mark.parametrize("clip", [(1, 2), (0.5, 1), (0, 1), (1, np.inf)])
def test_the_clip_range(rng, clip, what):
    """Surfaces exactly on its ends, within it; and t = 0 where it starts at 0."""
    met = []
    for _ in range(5):
        o, d, c = whole(rng)
        met.append(check(share(o, d, what), c, *clip).t)
    assert np.isin(np.concatenate(met), clip).sum() > 2


@pytest.mark.parametrize("what", ["nothing", "origin", "direction"])
@pytest.mark.parametrize("together", [1, 7, 100])
def test_batches_and_their_parts_do_not_matter(rng, together, what):
    """Two batches, each in parts, the second first: as all triangles at once."""
    o, d, c = whole(rng)
    rays = share(o, d, what)
    expected = nearest_hits(rays, c)
    names = np.arange(TRIANGLES, dtype=np.int32)
    every = WorldTriangles(c, np.zeros_like(names), names)
    ray, row = (v.ravel() for v in np.meshgrid(np.arange(RAYS), np.arange(11), indexing="ij"))
    ladder = Ladder(rays)
    for some in (every.take(names[19:]), every.take(names[8:19]), every.take(names[:8])):
        inside = np.flatnonzero(row < len(some.instance))
        for at in range(0, len(inside), together * RAYS):
            part = inside[at : at + together * RAYS]
            ladder.test(Pairs(ray[part], row[part], some))
    statistics = Statistics()
    hits = result_of(ladder.hits(statistics))
    for name in ("t", "instance", "triangle", "s"):
        assert np.array_equal(getattr(hits, name), getattr(expected, name)), name
    assert hits.ties == expected.ties
    again = nearest_hits(rays, c, together=together)
    assert np.array_equal(again.t, expected.t) and again.ties == expected.ties
    assert statistics.pairs_exact == sum(statistics.reasons.values()) > 0
    assert statistics.reasons[Reason.EDGE] > 0


def test_no_triangles_and_no_rays():
    some = Rays(np.zeros((3, 1)), np.ones((3, 4)))
    hits = nearest_hits(some, np.zeros((3, 3, 0)))
    assert np.isinf(hits.t).all() and (hits.certainty == Certainty.BOUND).all()
