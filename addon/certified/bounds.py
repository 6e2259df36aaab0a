"""Computes edge functions, T and D of rays and triangles in float64, and bounds their errors.

With the corners a, b, c, the normal n = (b - a) x (c - a), and for each edge a function of the ray:

    e_ab = d . ((a - o) x (b - a)),  ...     T = (a - o) . n,   D = d . n,   t = T / D

The sign of a computed value is right where its magnitude is above E = BOUND P + SLACK (1 + |w|_1).
P is the expression itself with | | on every product and + in place of -; w is the vector that the
cross product is multiplied by. BOUND is 12 roundings, 2^-53 each: at most 8 occur along the longest
path, and with what P and E may lose to theirs it is less than 9. SLACK covers gradual underflow. In
this form of e the error is relative to the length of an edge, not to the distance of the origin
from it.

What depends on the triangle alone is computed once for all rays: for rays from one origin
(`FromPoint`), or of one direction (`Parallel`). The bound is that of the ray with the largest. So a
pair of a ray and a triangle costs little more than three scalar products. Both classes have `edges`
and `fractions`, which differ in what is summed last.

References: Higham, "Accuracy and stability of numerical algorithms", 2nd ed., 2002, chapter 3, for
bounds of this kind. Theorems: `Forms.from_point_e` and so on, `Pairs.interval_right`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Index
from ..tracer.camera import Rays
from ..tracer.vector import Vectors, cross, dot, largest

U = 2.0**-53  # the relative error of one rounding
BOUND = 12 * U
SLACK = 2.0**-1060
_LOOSE = 1 + 2.0**-48  # covers the roundings of the bound on t itself


def bound(magnitude: Floats, w: Vectors) -> Floats:
    """Return E for a sum of products with the magnitude P and the vector w, (3, n)."""
    return BOUND * magnitude + SLACK * (1 + w[0] + w[1] + w[2])


def cross_magnitude(a: Vectors, b: Vectors) -> Vectors:
    """Return the magnitude of a x b for a, b >= 0, (3, n)."""
    return np.stack(
        (a[1] * b[2] + a[2] * b[1], a[2] * b[0] + a[0] * b[2], a[0] * b[1] + a[1] * b[0])
    )


@dataclass(frozen=True, eq=False)
class Fractions:
    """T and D of p pairs, (p,) each or shared, and bounds on their errors."""

    numerator: Floats
    numerator_error: Floats
    denominator: Floats
    denominator_error: Floats

    def interval(self) -> tuple[Floats, Floats]:
        """Return the ends of intervals, (p,) each, that contain t if it exists and is not negative.

        Where D may be zero, the lower end is the least |T| / |D|, and the upper end is inf.
        """
        size = np.abs(self.denominator)
        own = self.denominator_error
        t = self.numerator / self.denominator
        error = (np.abs(t) * own + self.numerator_error) / (size - own)
        error = (error + U * np.abs(t)) * _LOOSE + SLACK
        known = (size > own) & np.isfinite(error)
        least = (np.abs(self.numerator) - self.numerator_error) / (size + own)
        least = np.where(least > 0, least * (2 - _LOOSE) - SLACK, 0.0)  # 0 of NaN, too
        low = np.where(known, np.nextafter(t - error, -np.inf), least)
        return low, np.where(known, np.nextafter(t + error, np.inf), np.inf)


class FromPoint:
    """Triangles for rays from one origin; or from as many origins as triangles, pair by pair.

    Parameters
    ----------
    origins : (3, 1) or (3, m) float64
    reach : (3, 1) or (3, m) float64
        The largest |d| of all rays, by component.
    corners : (3, 3, m) float64
        Corner, component, triangle.
    """

    def __init__(self, origins: Vectors, reach: Vectors, corners: Vectors) -> None:
        a, b, c = corners
        arms = [corner - origins for corner in (a, b, c)]
        sides = (b - a, c - b, a - c)
        pairs = list(zip(arms, sides, strict=True))
        normals = [cross(*pair) for pair in pairs]
        sizes = [cross_magnitude(*np.abs(pair)) for pair in pairs]
        error = bound(dot(reach, largest(*sizes)), reach)
        self._edges = np.vstack((*normals, error))
        n, size = _normal(corners)
        arm = np.abs(arms[0])
        bounds = bound(dot(reach, size), reach), bound(dot(arm, size), arm)
        self._fractions = np.vstack((n, bounds[0], dot(arms[0], n), bounds[1]))

    def edges(self, rows: Index, rays: Rays) -> tuple[Vectors, Floats]:
        """Return e_ab, e_bc, e_ca, (3, p), of p rays with p triangles, and their bound, (p,)."""
        m = self._edges.take(rows, axis=1)
        x, y, z = rays.directions
        return np.stack([m[k] * x + m[k + 1] * y + m[k + 2] * z for k in (0, 3, 6)]), m[9]

    def fractions(self, rows: Index, rays: Rays) -> Fractions:
        """Return T and D of p rays with p triangles."""
        m = self._fractions.take(rows, axis=1)
        return Fractions(m[4], m[5], dot(rays.directions, m[:3]), m[3])


class Parallel:
    """Triangles for rays of one direction, with origins in a box.

    e_ab = (a - o) . ((b - a) x d): the same product, with what the rays share multiplied first.

    Parameters
    ----------
    direction : (3, 1) float64
    low, high : (3, 1) float64
        The corners of the box.
    corners : (3, 3, m) float64
        Corner, component, triangle.
    """

    def __init__(self, direction: Vectors, low: Vectors, high: Vectors, corners: Vectors) -> None:
        a, b, c = corners
        size = np.abs(direction)
        arms = [np.maximum(np.abs(v - low), np.abs(v - high)) for v in (a, b, c)]
        sides = (b - a, c - b, a - c)
        normals = [cross(side, direction) for side in sides]
        errors = [
            bound(dot(arm, cross_magnitude(np.abs(side), size)), arm)
            for arm, side in zip(arms, sides, strict=True)
        ]
        self._edges = np.vstack((a, b, c, *normals, largest(*errors)))
        n, magnitude = _normal(corners)
        bounds = bound(dot(arms[0], magnitude), arms[0]), bound(dot(size, magnitude), size)
        self._fractions = np.vstack((a, n, bounds[0], dot(direction, n), bounds[1]))

    def edges(self, rows: Index, rays: Rays) -> tuple[Vectors, Floats]:
        """Return e_ab, e_bc, e_ca, (3, p), of p rays with p triangles, and their bound, (p,)."""
        m = self._edges.take(rows, axis=1)
        edges = [dot(m[k : k + 3] - rays.origins, m[9 + k : 12 + k]) for k in (0, 3, 6)]
        return np.stack(edges), m[18]

    def fractions(self, rows: Index, rays: Rays) -> Fractions:
        """Return T and D of p rays with p triangles."""
        m = self._fractions.take(rows, axis=1)
        return Fractions(dot(m[:3] - rays.origins, m[3:6]), m[6], m[7], m[8])


def plane_fractions(rays: Rays, point: Vectors, normal: Vectors) -> Fractions:
    """Return T = (p - o) . n and D = d . n of rays and an infinite plane, p and n (3, 1)."""
    arm = point - rays.origins
    sizes = [np.abs(v) for v in (arm, rays.directions, normal)]
    return Fractions(
        dot(arm, normal),
        bound(dot(sizes[0], sizes[2]), sizes[0]),
        dot(rays.directions, normal),
        bound(dot(sizes[1], sizes[2]), sizes[1]),
    )


def _normal(corners: Vectors) -> tuple[Vectors, Vectors]:
    """Return n = (b - a) x (c - a) and its magnitude, (3, m) each."""
    a, b, c = corners
    ab = b - a
    ac = c - a
    return cross(ab, ac), cross_magnitude(np.abs(ab), np.abs(ac))
