"""The checks and the bounds: what they say is held against integers."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.triangle import TESTS
from reference_tracer_grading.known import known
from reference_tracer_grading.subjects.triangle_cases import groups

from ..oracle import barycentrics, intersect_pairs, rational

HITS = {"front", "back", "whole", "scaled"}


def test_the_oracle_agrees_on_every_group(checks):
    for group in checks.subject.groups:
        rows = np.flatnonzero(checks.among(group))[::7]
        origins, directions, triangles = (array[rows] for array in checks.given)
        seen = intersect_pairs(origins.T, directions.T, triangles.transpose(1, 2, 0))
        hit = np.isfinite(checks.right[rows, 0])
        assert np.array_equal(seen.hit & seen.within(), hit), group


def test_groups_are_what_they_are_called(checks):
    for group in checks.subject.groups:
        hit = np.isfinite(checks.right[checks.among(group), 0])
        if group == "beside":
            assert 0.4 < hit.mean() < 0.6
        elif group == "elsewhere":  # anything may be, and nothing counts
            assert 0 < hit.mean() < 0.1 and not checks.counts[checks.among(group)].any()
        else:
            assert (hit == (group in HITS)).all(), group
    _, directions, triangles = checks.given
    edges = triangles[:, 1:] - triangles[:, :1]
    slope = (np.cross(edges[:, 0], edges[:, 1]) * directions).sum(axis=1)
    assert (slope[checks.among("front")] < 0).all() and (slope[checks.among("back")] > 0).all()
    assert (slope[checks.among("parallel")] == 0).all()


def test_nothing_is_rounded_in_whole():
    o, d, p = groups()["whole"]
    hit, t, s = TESTS[Method.TEXTBOOK_LITERAL](Rays(o.T, d.T), *p.transpose(1, 2, 0))
    assert hit.all()
    pairs = o.T, d.T, p.transpose(1, 2, 0)
    found = intersect_pairs(*pairs)
    assert [found.t(k) for k in range(len(o))] == t.tolist()
    assert (barycentrics(*pairs)[0] == s).all()


@pytest.mark.parametrize("aspect", [1.0, 1e3, 1e6])
def test_known_is_true_and_bounds_hold(rng, aspect):
    """Needles, too: the truth against fractions, and unproven methods within bounds."""
    n = 300
    p = rng.normal(size=(n, 3, 3))
    p[:, 2] = p[:, 0] + (p[:, 1] - p[:, 0]) * 0.4 + (p[:, 2] - p[:, 0]) / aspect
    s = rng.dirichlet((1, 1, 1), n)
    o = rng.normal(size=(n, 3)) * 4
    d = (s[:, :, None] * p).sum(axis=1) - o
    truth = known(o, d, p)
    pairs = o.T, d.T, p.transpose(1, 2, 0)
    exact = [intersect_pairs(*pairs).t(k) for k in range(n)]
    assert (np.abs(rational(truth.t) - exact) <= rational(truth.t_allowed)).all()
    assert (
        np.abs(rational(truth.s.T) - barycentrics(*pairs)[0]) <= rational(truth.s_allowed)
    ).all()
    for method in (Method.TEXTBOOK, Method.MOLLER_TRUMBORE, Method.WATERTIGHT):
        _, t, weights = TESTS[method](Rays(o.T, d.T), *p.transpose(1, 2, 0))
        assert (np.abs(t - truth.t) <= truth.t_allowed).all(), method
        assert (np.abs(weights.T - truth.s) <= truth.s_allowed[:, None]).all(), method
