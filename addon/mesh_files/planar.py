"""A polygon in space, seen along its own normal: on which side of a line a corner lies, exactly.

Each question is asked in float64 first, with a bound on what rounding can do, and in integers where
that does not decide.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from ..arrays import Floats

Triple = tuple[int, int, int]

_UNIT = 2.0**-53  # half the distance from 1 to the next float64
# Of a cross product whose corners are correctly rounded and at most 1: a difference is off by
# 4 units, of at most 2; its product with another by 16 + 4 units, and two of them and their own
# difference by 48 units and less than 1 of second order. The slack is for gradual underflow.
_BOUND = 64 * _UNIT + 2.0**-1060


def sign(value: int | float) -> int:
    """Return 1, 0 or -1."""
    return (value > 0) - (value < 0)


def integers(points: Floats) -> list[Triple]:
    """Return finite points (n, 3) as integers, multiplied by one power of two."""
    mantissas, exponents = np.frexp(points.astype(np.float64))
    whole = np.ldexp(mantissas, 53).astype(np.int64)
    shifts = np.where(whole == 0, 0, exponents - exponents[whole != 0].min(initial=9999))
    rows = zip(whole.tolist(), shifts.tolist(), strict=True)
    return [(a << i, b << j, c << k) for (a, b, c), (i, j, k) in rows]


def cross(a: Triple, b: Triple) -> Triple:
    """Return the cross product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def minus(a: Triple, b: Triple) -> Triple:
    """Return the difference of two points."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def dot(a: Triple, b: Triple) -> int:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


class Planar:
    """The corners of a polygon as they are seen along its normal, wound to the left on the whole.

    The normal is Newell's: the sum of the cross products of neighbours, twice the area. Where it is
    zero, Z is looked along, as in Blender.

    Parameters
    ----------
    points : (n, 3) float
        The corners, finite.
    """

    def __init__(self, points: Floats) -> None:
        corners = integers(points)
        local = [minus(corner, corners[0]) for corner in corners]
        crossed = [cross(a, b) for a, b in pairwise(local)]
        normal = tuple(map(sum, zip(*crossed, strict=True)))
        x, y, z = self.normal = normal if any(normal) else (0, 0, 1)
        # The axis nearest to the normal is dropped from corners that are slid along the normal.
        if abs(z) >= max(abs(x), abs(y)):
            seen = [(p * z - r * x, q * z - r * y) for p, q, r in local]
            along = z
        elif abs(x) >= abs(y):
            seen = [(q * x - p * y, r * x - p * z) for p, q, r in local]
            along = x
        else:
            seen = [(r * y - q * z, p * y - q * x) for p, q, r in local]
            along = y
        self.exact = [(u if along > 0 else -u, v) for u, v in seen]
        largest = max(max(abs(u), abs(v)) for u, v in self.exact) or 1
        self.flat = [(u / largest, v / largest) for u, v in self.exact]  # correctly rounded
        self.has_area = any(normal)
        far = next(filter(any, local), (0, 0, 0))
        self.is_line = not any(any(cross(far, corner)) for corner in local)

    def turn(self, a: int, b: int, c: int) -> int:
        """Return 1 where the corners a, b, c turn left, -1 where they turn right, 0 on a line."""
        (p, q), (r, s), (t, u) = self.flat[a], self.flat[b], self.flat[c]
        value = (r - p) * (u - q) - (s - q) * (t - p)
        if abs(value) > _BOUND:
            return 1 if value > 0 else -1
        (i, j), (k, m), (n, o) = self.exact[a], self.exact[b], self.exact[c]
        return sign((k - i) * (o - j) - (m - j) * (n - i))

    def distance(self, a: int, b: int, c: int) -> float:
        """Return how far the corner c is from the line through a and b, about."""
        (p, q), (r, s), (t, u) = self.flat[a], self.flat[b], self.flat[c]
        length = math.hypot(r - p, s - q)
        return abs((r - p) * (u - q) - (s - q) * (t - p)) / length if length else 0.0

    def is_turned_over(self, a: int, b: int, c: int, reach: float) -> bool:
        """Return whether a triangle turns right, and is more than `reach` wide everywhere."""
        if self.turn(a, b, c) >= 0:
            return False
        corners = (a, b, c), (b, c, a), (c, a, b)
        return not reach or min(self.distance(*three) for three in corners) > reach
