"""What rays cross and where points lie, in fractions: by a ray that is really moved.

It shares with the tracer what `moved_rays.py` does: nothing. Where points lie is counted along
directions at random, until one of them meets no edge.
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

import numpy as np

from ..moved_rays import THE_RULE, Surface, crosses, dot, in_integers, meet, moved, sub


class Hit(NamedTuple):
    """A hit: t of the moved ray, then the triangle's number; t of the ray as it is."""

    moved_t: Fraction
    triangle: int
    t: Fraction
    enters: bool


def _t(o, d, surface):
    return Fraction(dot(sub(surface.points[0], o), surface.normal), dot(d, surface.normal))


def every_hit(origin, direction, triangles, start=0.0, end=np.inf):
    """Return the hits of a ray in their order; triangles (n, 3, 3)."""
    found = []
    for number, corners in enumerate(triangles):
        o, d, [surface] = in_integers(origin, direction, [Surface((0, number), list(corners))])
        way, inside, _ = _met(o, d, surface)
        if inside >= 0:
            rows = ([Fraction(float(x)) for x in v] for v in (origin, direction, *corners))
            start_at, along, *points = rows
            t = _t(start_at, along, Surface((0, number), points))
            if start <= t <= end and not t == start == 0:
                found.append((number, t, way < 0))
    given = [Surface((0, number), list(triangles[number])) for number, _, _ in found]
    o, d, surfaces = moved(*in_integers(origin, direction, given), THE_RULE)
    each = zip(found, surfaces, strict=True)
    return sorted(Hit(_t(o, d, s), *own) for own, s in each if crosses(o, d, s))


def place(point, triangles):
    """Return 2 for a point on a triangle with an area, else its parity; and how often they wind."""
    given = [Surface((0, k), list(corners)) for k, corners in enumerate(triangles)]
    o, _, surfaces = in_integers(point, (1, 0, 0), given)
    if any(_met(o, s.normal, s)[1:] in ((0, 0), (1, 0)) for s in surfaces):
        return 2, 0
    for seed in range(99):
        d = np.random.default_rng(seed).integers(-(10**6), 10**6, 3).tolist()
        ahead = [met for s in surfaces if (met := _met(o, d, s))[2] > 0 <= met[1]]
        if all(inside for _, inside, _ in ahead):  # else this direction meets an edge
            winding = sum(way for way, _, _ in ahead)
            return len(ahead) % 2, winding
    raise AssertionError("every direction meets an edge")


def _met(o, d, surface):
    """Return 1 where a line leaves by a triangle; if it is inside, 0 at an edge; the sign of t."""
    det, u, v, t = meet(o, d, *surface.points)
    way = -1 if det > 0 else 1
    least = min(w * -way for w in (u, v, det - u - v)) if det else -1
    return way, (least > 0) - (least < 0), (t * det > 0) - (t * det < 0)
