"""What one ray sees of some triangles, decided with Python's whole numbers: no rounding anywhere.

Every float is a whole number times a power of two. Scaled by one power for all, the ray and the
corners become integers, and the signs that decide a hit are exact. Where a ray meets an edge or
two surfaces at once, the tracer's rule speaks of a ray moved infinitely little, from the direction
d to d + (e, e^2, e^3). Here that ray is really moved: e is a power of two, smaller than any
difference that numbers of this size can have. So nothing here is the tracer's own exact path: no
error bound, no symbolic rule, no culling. Some microseconds a triangle.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from ..tracer.hits import NOTHING

Whole = list[int]  # a vector of integers


@dataclass(frozen=True)
class Verdict:
    """What a ray sees: the triangle's index or NOTHING, its exact t, and how many it crosses."""

    triangle: int
    t: Fraction | None
    crossings: int


def judge_ray(
    origin: NDArray[np.float64],
    direction: NDArray[np.float64],
    corners: NDArray[np.float64],
    start: float = 0.0,
    end: float = np.inf,
) -> Verdict:
    """Return what the moved ray sees between `start` and `end`, both inclusive.

    Of coplanar triangles it sees the first. A triangle that has no area, whose plane holds the
    origin, or that the ray as it stands is parallel to, is never seen.

    Parameters
    ----------
    origin, direction : (3,) float64
    corners : (3 corners, 3 components, m) float64
    start, end : float
        As t, so in lengths of the direction.
    """
    (along,), fine = _integers(direction[None])
    flat = corners.transpose(2, 0, 1).reshape(-1, 3)
    points, coarse = _integers(np.concatenate((origin[None], flat)))
    o = points[0]
    points = [_sub(p, o) for p in points[1:]]
    moved = _moved(along, points)
    unit = Fraction(2) ** (coarse - fine)  # of t, where both are integers
    seen, found, crossings = None, Verdict(NOTHING, None, 0), 0
    for k, (a, b, c) in enumerate(zip(points[::3], points[1::3], points[2::3], strict=True)):
        towards = [_cross(p, _sub(q, p)) for p, q in ((a, b), (b, c), (c, a))]
        edges = [_dot(along, m) for m in towards]
        if min(edges) < 0 < max(edges):
            continue  # and however little it is moved
        n = _cross(_sub(b, a), _sub(c, a))
        height, slope = _dot(a, n), _dot(along, n)
        if height == 0 or slope == 0:
            continue
        edges = [_dot(moved, m) for m in towards]
        t = height * unit / slope
        if min(edges) <= 0 <= max(edges) or not start <= t <= end:
            continue
        crossings += 1
        depth = Fraction(height, _dot(moved, n))  # of the moved ray, in units of its own
        if seen is None or depth < seen:
            seen, found = depth, Verdict(k, t, 0)
    return Verdict(found.triangle, found.t, crossings)


def _moved(along: Whole, points: list[Whole]) -> Whole:
    """Return along + (e, e^2, e^3), scaled to integers, with e small enough for all signs.

    With coordinates below 2^l, a corner's cross products stay below 2^(2 l + 1), a height below
    2^(3 l + 5), and what orders two triangles by their t below 2^(5 l + 8): an integer times e^k
    then never outweighs one that is not zero times e^(k - 1).
    """
    size = max((abs(x) for p in points for x in p), default=0).bit_length() + 1
    bits = 5 * size + 10
    return [(x << 3 * bits) + (1 << k * bits) for x, k in zip(along, (2, 1, 0), strict=True)]


def _integers(vectors: NDArray[np.float64]) -> tuple[list[Whole], int]:
    """Return floats (n, 3) as integers and an exponent e: each float is its integer times 2^e."""
    mantissa, exponent = np.frexp(vectors)
    whole = (mantissa * 2.0**53).astype(np.int64)
    least = int(exponent[whole != 0].min()) if whole.any() else 0
    shift = np.where(whole != 0, exponent - least, 0)
    return [
        [m << e for m, e in zip(row, by, strict=True)]
        for row, by in zip(whole.tolist(), shift.tolist(), strict=True)
    ], least - 53


def _sub(a: Whole, b: Whole) -> Whole:
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]


def _dot(a: Whole, b: Whole) -> int:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Whole, b: Whole) -> Whole:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
