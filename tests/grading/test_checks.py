"""The checks and the bounds: what they say is held against integers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.triangle import TESTS
from reference_tracer_grading.checks import SCALES, Group, make_checks
from reference_tracer_grading.known import known

from ..oracle import intersect_pairs

HITS = {Group.FRONT, Group.BACK, Group.WHOLE, Group.SCALED}


def exact(o, d, p):
    """t and barycentrics on the triangle's plane, as fractions."""
    o, d, p1, p2, p3 = ([Fraction(float(x)) for x in v] for v in (o, d, *p))

    def sub(a, b):
        return [x - y for x, y in zip(a, b, strict=True)]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

    def dot(a, b):
        return sum(x * y for x, y in zip(a, b, strict=True))

    n = cross(sub(p2, p1), sub(p3, p1))
    t = dot(sub(p1, o), n) / dot(d, n)
    x = [a + t * b for a, b in zip(o, d, strict=True)]
    corners = (p2, p3), (p3, p1), (p1, p2)
    return t, [dot(n, cross(sub(b, a), sub(x, a))) / dot(n, n) for a, b in corners]


def test_the_oracle_agrees_on_every_group(checks):
    for group in Group:
        rows = np.flatnonzero(checks.of(group))[::7]
        seen = intersect_pairs(
            checks.origins[rows].T,
            checks.directions[rows].T,
            checks.triangles[rows].transpose(1, 2, 0),
        )
        assert np.array_equal(seen.hit & seen.within(), checks.known.hit[rows]), group


def test_groups_are_what_they_are_called(checks):
    for group in Group:
        hit = checks.known.hit[checks.of(group)]
        expected = group in HITS
        if group == Group.BESIDE:
            assert 0.4 < hit.mean() < 0.6
        elif group == Group.ELSEWHERE:  # anything may be, and nothing counts
            assert 0 < hit.mean() < 0.1 and checks.known.doubt[checks.of(group)].all()
        else:
            assert (hit == expected).all(), group
    assert not checks.known.doubt[~checks.of(Group.EMPTY, Group.ELSEWHERE)].any()
    assert checks.known.doubt[checks.of(Group.EMPTY)].all()
    slope = np.cross(
        checks.triangles[:, 1] - checks.triangles[:, 0],
        checks.triangles[:, 2] - checks.triangles[:, 0],
    )
    slope = (slope * checks.directions).sum(axis=1)
    assert (slope[checks.of(Group.FRONT)] < 0).all() and (slope[checks.of(Group.BACK)] > 0).all()
    assert (slope[checks.of(Group.PARALLEL)] == 0).all()
    assert (checks.known.t[checks.of(Group.BEHIND)] < 0).all()


def test_scaled_pairs_are_exact_multiples(checks):
    scaled = np.flatnonzero(checks.of(Group.SCALED))
    twin = checks.twin[scaled]
    factor = np.repeat([2.0**k for k in SCALES], len(scaled) // len(SCALES))
    assert (checks.origins[scaled] == checks.origins[twin] * factor[:, None]).all()
    assert (checks.triangles[scaled] == checks.triangles[twin] * factor[:, None, None]).all()
    assert (checks.known.hit[twin]).all()


def test_nothing_is_rounded_in_whole(checks):
    rows = np.flatnonzero(checks.of(Group.WHOLE))
    hit, t, s = TESTS[Method.TEXTBOOK_LITERAL](
        Rays(checks.origins[rows].T, checks.directions[rows].T),
        *checks.triangles[rows].transpose(1, 2, 0),
    )
    assert hit.all()
    for k in range(0, len(rows), 9):
        row = rows[k]
        true_t, true_s = exact(checks.origins[row], checks.directions[row], checks.triangles[row])
        assert true_t == t[k] and true_s == list(s[:, k])


def test_same_seed_same_checks(checks):
    again = make_checks()
    assert (again.triangles == checks.triangles).all()
    assert not (make_checks(1).triangles == checks.triangles).all()


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
    for k in range(0, n, 10):
        t, weights = exact(o[k], d[k], p[k])
        assert abs(Fraction(float(truth.t[k])) - t) <= Fraction(float(truth.t_allowed[k]))
        for value, weight in zip(truth.s[k], weights, strict=True):
            assert abs(Fraction(float(value)) - weight) <= Fraction(float(truth.s_allowed[k]))
    for method in (Method.TEXTBOOK, Method.MOLLER_TRUMBORE, Method.WATERTIGHT):
        _, t, weights = TESTS[method](Rays(o.T, d.T), *p.transpose(1, 2, 0))
        assert (np.abs(t - truth.t) <= truth.t_allowed).all(), method
        assert (np.abs(weights.T - truth.s) <= truth.s_allowed[:, None]).all(), method


def test_float32_is_not_within_bounds(checks):
    rows = np.flatnonzero(checks.of(Group.FRONT))
    o, d, p = (a[rows].astype(np.float32) for a in (
        checks.origins, checks.directions, checks.triangles))  # fmt: skip
    _, t, s = TESTS[Method.MOLLER_TRUMBORE](Rays(o.T, d.T), *p.transpose(1, 2, 0))
    truth = checks.known
    assert (np.abs(t - truth.t[rows]) > truth.t_allowed[rows]).mean() > 0.99
    assert (np.abs(s.T - truth.s[rows]).max(axis=1) > truth.s_allowed[rows]).mean() > 0.99
