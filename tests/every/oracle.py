"""What rays cross and where points lie, in fractions: it shares nothing with the tracer.

The ray is really moved, by powers of two that are small beside all that occurs; where it meets a
plane is a point, and whether that is in the triangle is seen in two coordinates. A point is counted
about along directions that no other part of this project uses, until one meets no edge.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import NamedTuple

import numpy as np


class Hit(NamedTuple):
    """A hit: of the moved ray t, then the triangle's number; t of the ray as it is."""

    moved_t: Fraction
    triangle: int
    t: Fraction
    enters: bool


def exact(values):
    """Return floats as lists of fractions."""
    return [[Fraction(float(x)) for x in row] for row in np.asarray(values).reshape(-1, 3)]


def _minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def _times(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def _across(a, b):
    return [a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)]


def _whole(rows):
    """Return rows of floats in whole numbers, as fractions, and what they were multiplied by."""
    rows = [row for v in rows for row in exact(v)]
    numbers = [x for row in rows for x in row if x]
    by = Fraction(max(x.denominator for x in numbers))
    by /= min((x * by).numerator & -(x * by).numerator for x in numbers)
    return [[x * by for x in row] for row in rows], by


def side(point, corners, normal):
    """Return 1, 0 or -1 for a point of the plane inside of a triangle, at its edge, outside."""
    away = max(range(3), key=lambda k: abs(normal[k]))
    x, y = (away + 1) % 3, (away + 2) % 3
    areas = [
        (b[x] - a[x]) * (point[y] - a[y]) - (b[y] - a[y]) * (point[x] - a[x])
        for a, b in pairwise([*corners, corners[0]])
    ]
    if min(areas) < 0 < max(areas):
        return -1
    return int(0 not in areas)


def every_hit(origin, direction, triangles, start=0.0, end=np.inf):
    """Return the hits of a ray in their order; triangles (n, 3, 3)."""
    (o, *points), lengths = _whole([origin, triangles])
    (d,), by = _whole([direction])
    small = Fraction(1, 1 << 10 * max(abs(int(x)) for v in (o, d, *points) for x in v).bit_length())
    moved = [x + small**k for k, x in enumerate(d, 1)]
    found = []
    for number, (a, b, c) in enumerate(zip(points[::3], points[1::3], points[2::3], strict=True)):
        normal = _across(_minus(b, a), _minus(c, a))
        along = _times(d, normal)
        arm = _times(_minus(a, o), normal)
        if along == 0 or side(_at(o, arm / along, d), (a, b, c), normal) < 0:
            continue
        t = arm / along * by / lengths
        if not start <= t <= end or t == start == 0:
            continue
        moved_t = arm / _times(moved, normal)
        if side(_at(o, moved_t, moved), (a, b, c), normal) == 1:
            found.append(Hit(moved_t, number, t, along < 0))
    return sorted(found)


def _at(origin, t, direction):
    return [x + t * y for x, y in zip(origin, direction, strict=True)]


def place(point, triangles):
    """Return whether a point is on a triangle with an area; else None, and how often they wind."""
    (o, *points), _ = _whole([point, triangles])
    meshes = list(zip(points[::3], points[1::3], points[2::3], strict=True))
    seed = 0
    while True:
        rng = np.random.default_rng(seed)
        d = [Fraction(int(k)) for k in rng.integers(-(10**6), 10**6, 3)]
        winding = 0
        for a, b, c in meshes:
            normal = _across(_minus(b, a), _minus(c, a))
            along, arm = _times(d, normal), _times(_minus(a, o), normal)
            if any(normal) and arm == 0 and side(o, (a, b, c), normal) >= 0:
                return "on", 0
            if not along or arm / along <= 0:
                continue
            at = side(_at(o, arm / along, d), (a, b, c), normal)
            if at == 0:
                break  # this direction meets an edge
            winding += (1 if along > 0 else -1) * (at == 1)
        else:
            return None, winding
        seed += 1
