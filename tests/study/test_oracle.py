"""The study's judge of one ray, against fractions worked out here in another way."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import trimesh
from reference_tracer.study.oracle import judge_ray
from reference_tracer.tracer.hits import NOTHING


def det(a, b, c):
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def fractions(vector):
    return [Fraction(float(x)) for x in vector]


def cramer(o, d, p1, p2, p3):
    """t and whether the line is within the triangle, in fractions; None if parallel."""
    e1, e2, q = ([a - b for a, b in zip(v, p1, strict=True)] for v in (p2, p3, o))
    against = [-x for x in d]
    whole = det(e1, e2, against)
    if whole == 0:
        return None
    u, v, t = (n / whole for n in (det(q, e2, against), det(e1, q, against), det(e1, e2, q)))
    return t, min(u, v, 1 - u - v) >= 0


LITTLE = Fraction(1, 2**4000)


def expected(o, d, corners, start, end):
    """Nearest triangle, its t, and how many are crossed: by the ray d + (x, x^2, x^3)."""
    o, d = fractions(o), fractions(d)
    moved = [a + LITTLE ** (k + 1) for k, a in enumerate(d)]
    hits = []
    for k in range(corners.shape[2]):
        points = [fractions(p) for p in corners[:, :, k]]
        still, there = cramer(o, d, *points), cramer(o, moved, *points)
        if still and there and there[1] and still[0] != 0 and start <= still[0] <= end:
            hits.append((there[0], k, still[0]))
    if not hits:
        return NOTHING, None, 0
    _, k, t = min(hits)
    return k, t, len(hits)


def check(o, d, corners, start=0.0, end=np.inf):
    verdict = judge_ray(np.asarray(o, float), np.asarray(d, float), corners, start, end)
    found = verdict.triangle, verdict.t, verdict.crossings
    assert found == expected(o, d, corners, start, end)
    return verdict


def as_corners(vertices, triangles):
    return np.asarray(vertices, float)[np.asarray(triangles)].transpose(1, 2, 0)


@pytest.mark.parametrize("exponent", [0, -150, 120, 300, -320])
def test_any_triangles_at_any_scale(rng, exponent):
    seen = 0
    for _ in range(8):
        corners = rng.normal(size=(3, 3, 12)) * 2.0**exponent
        corners[0, 0, 0] = 0.0
        o = rng.normal(size=3) * 2.0**exponent
        d = (corners[:, :, 5].mean(axis=0) - o) * 10.0 ** rng.integers(-6, 6)
        seen += check(o, d, corners).crossings
    assert seen >= 8


def test_corners_and_edges_of_a_cube(rng):
    """Whole numbers: every ray meets a corner, an edge or a diagonal, and crosses one triangle."""
    box = trimesh.creation.box((4, 4, 4))
    corners = as_corners(box.vertices, box.faces)
    for target in [*box.vertices, *(box.vertices[box.faces].mean(axis=1)), (2, 0, 0), (2, 2, 0)]:
        assert check((0, 0, 0), target, corners).crossings == 1
    for target in box.vertices:
        assert check((1, 0, 1), target - (1, 0, 1), corners).crossings == 1


def test_an_outline_is_crossed_twice_or_not_at_all(rng):
    box = trimesh.creation.box((4, 4, 4))
    corners = as_corners(box.vertices, box.faces)
    for x in (-2, 0, 2):
        for y in (-2, 1, 2):
            assert check((x, y, 9), (0, 0, -1), corners).crossings in (0, 2)


def test_the_first_of_coplanar_ones_and_the_nearer_of_others():
    one = [[-9, -9, 5], [9, -9, 5], [0, 9, 5]]
    other = [[-9, 9, 5], [9, 9, 5], [0, -9, 5]]
    near = [[-9, -9, np.nextafter(5, 4)], [9, -9, np.nextafter(5, 4)], [0, 9, np.nextafter(5, 4)]]
    stack = np.array([one, other, near], float).transpose(1, 2, 0)
    assert check((0, 0, 0), (0, 0, 1), stack).triangle == 2
    assert check((0, 0, 0), (0, 0, 1), stack[:, :, :2]).triangle == 0
    assert check((0, 0, 0), (0, 0, 1), stack[:, :, 1::-1]).triangle == 0


def test_two_that_meet_at_the_ray_are_ordered_by_the_moved_one():
    """Two planes through one point of the ray: to the side it is moved to, one is nearer."""
    slopes = [[[-9, -9, 5 + s * -9], [9, -9, 5 + s * 9], [0, 9, 5]] for s in (1, -1)]
    stack = np.array(slopes, float).transpose(1, 2, 0)
    assert check((0, 0, 0), (0, 0, 1), stack).triangle == 1
    assert check((0, 0, 0), (0, 0, 1), stack[:, :, ::-1]).triangle == 0


def test_what_is_never_seen():
    empty = [[0, 0, 5], [1, 1, 5], [2, 2, 5]]
    edge_on = [[0, -1, 4], [0, 1, 4], [0, 0, 9]]
    at_origin = [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]
    stack = np.array([empty, edge_on, at_origin], float).transpose(1, 2, 0)
    assert check((0, 0, 0), (0, 0, 1), stack).triangle == NOTHING


def test_clip_range_is_inclusive_and_exact():
    wall = np.array([[[-9, -9, 3], [9, -9, 3], [0, 9, 3]]], float).transpose(1, 2, 0)
    for start, end, seen in (
        (3, 4, True),
        (2, 3, True),
        (np.nextafter(3, 4), 4, False),
        (2, np.nextafter(3, 2), False),
        (-5, -1, False),
    ):
        verdict = check((0.1, 0, 0), (0, 0, 1), wall, start, end)
        assert (verdict.triangle == 0) == seen
    assert check((0.1, 0, 4), (0, 0, 1), wall, -2, 2).t == -1  # behind, where that is allowed
