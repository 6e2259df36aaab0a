"""Tests rays with triangles: by the textbook, by it literally, Möller–Trumbore, watertight.

`nearest.py` calls these tests for the unproven methods; `certified` has its own, in `certified/`.
Each function takes n rays and n triangles, pair by pair, and returns
    hit : (n,) bool      whether the ray's line meets the triangle
    t   : (n,)           ray parameter where it does
    s   : (3, n)         barycentrics of p1, p2, p3: x = s1 p1 + s2 p2 + s3 p3
in the precision of its input. t may be negative: `nearest.py` tests the clip range.

The textbook (docs/glossary.md, "The exercise"):
    n = (p3 - p1) x (p2 - p1)                     t = -((o - p1) . n) / (d . n),  x = o + t d
    n_s1 = (p2 - p3) x (x - p3)   n_s2 = (p1 - p2) x (x - p2)   n_s3 = (p3 - p1) x (x - p1)
    s_i = n . n_si / |n|^2        a hit when 0 <= s_i <= 1 and s1 + s2 + s3 = 1

Two errata:
1. n_s2 vanishes on the edge p1 p2, and n_s3 on the edge p3 p1. So s2 as printed weighs p3 and s3
   weighs p2, the opposite of x = s1 p1 + s2 p2 + s3 p3. Constant shading never shows it;
   interpolation would. The functions here return them in the order of the corners.
2. The three always sum to 1: x cancels out of n_s1 + n_s2 + n_s3, and what is left is n, so that
   the sum is n . n / |n|^2 = 1, whatever x is. In exact arithmetic the last condition says nothing,
   not even that x lies in the plane. In floating point, `sum == 1` fails for about every second hit
   by a rounding error (measured: 49 % in float32, 52 % in float64). `textbook_literal` keeps the
   condition, to show the holes that it makes; `textbook` allows the sum SUM_TOLERANCE, so that it
   rejects only needles whose weights have lost their digits by cancelling.

Neither test gives the edge between two triangles to exactly one of them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import Bools, Floats
from ..methods import Method
from .camera import Rays
from .vector import Vectors, cross, dot

Intersection = tuple[Bools, Floats, Vectors]
Sheared = list[tuple[Floats, Floats, Floats]]  # x, y and depth of each corner

# How far s1 + s2 + s3 may be from 1, dimensionless. Ordinary rays stay within a few ulp of 1 (ulp:
# 1e-7 and 2e-16); weights whose sum is farther off have lost most of their digits.
SUM_TOLERANCE = {np.dtype(np.float32): 1e-6, np.dtype(np.float64): 1e-9}


def _textbook(rays: Rays, p1: Vectors, p2: Vectors, p3: Vectors) -> Intersection:
    o = rays.origins
    d = rays.directions
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        n = cross(p3 - p1, p2 - p1)
        t = -dot(o - p1, n) / dot(d, n)  # d . n = 0 gives inf or NaN, and every test below fails
        x = o + t * d
        area = dot(n, n)
        s1 = dot(n, cross(p2 - p3, x - p3)) / area
        s2 = dot(n, cross(p3 - p1, x - p1)) / area  # printed as n_s3: it weighs p2
        s3 = dot(n, cross(p1 - p2, x - p2)) / area  # printed as n_s2: it weighs p3
        s = np.stack((s1, s2, s3))
        inside = ((s >= 0) & (s <= 1)).all(axis=0)
    return inside, t, s


def textbook_literal(rays: Rays, p1: Vectors, p2: Vectors, p3: Vectors) -> Intersection:
    """Test as printed, with a sum that equals 1 (added as s1 + s3 + s2): loses half of all hits."""
    inside, t, s = _textbook(rays, p1, p2, p3)
    return inside & sum_is_1(s), t, s


def sum_is_1(s: Vectors) -> Bools:
    """Return where the barycentrics (3, n), added as printed, equal 1, (n,)."""
    with np.errstate(invalid="ignore", over="ignore"):
        return s[0] + s[1] + s[2] == 1


def textbook(rays: Rays, p1: Vectors, p2: Vectors, p3: Vectors) -> Intersection:
    """Test as printed, but with the sum equal to 1 within SUM_TOLERANCE."""
    inside, t, s = _textbook(rays, p1, p2, p3)
    with np.errstate(invalid="ignore", over="ignore"):
        sums = np.abs(s[0] + s[1] + s[2] - 1) <= SUM_TOLERANCE[s.dtype]
    return inside & sums, t, s


def moller_trumbore(rays: Rays, p1: Vectors, p2: Vectors, p3: Vectors) -> Intersection:
    """Solve o + t d = p1 + s2 e1 + s3 e2 by Cramer's rule, for e1 = p2 - p1 and e2 = p3 - p1.

    With q = (o - p1) x e1 and the determinant e1 . (d x e2),

        s2 = (o - p1) . (d x e2) / det,  s3 = d . q / det,  t = e2 . q / det

    Both faces are seen. There is no epsilon for the determinant: it would be a length to the third.

    References
    ----------
    .. [1] Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", JGT 2(1), 1997.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        e1 = p2 - p1
        e2 = p3 - p1
        across = cross(rays.directions, e2)
        scale = 1 / dot(e1, across)
        from_p1 = rays.origins - p1
        s2 = dot(from_p1, across) * scale
        q = cross(from_p1, e1)
        s3 = dot(rays.directions, q) * scale
        t = dot(e2, q) * scale
        hit = (s2 >= 0) & (s3 >= 0) & (s2 + s3 <= 1)
        return hit, t, np.stack((1 - s2 - s3, s2, s3))


def watertight(rays: Rays, p1: Vectors, p2: Vectors, p3: Vectors) -> Intersection:
    """Shear the ray onto an axis, and take the signs of three 2D edge functions.

    Two triangles compute their common edge from the same rounded numbers, so that no ray slips
    between them; a ray may hit both. In float32, edge functions that come out as zero are computed
    again in float64, as in the paper.

    References
    ----------
    .. [1] Woop, Benthin and Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013.
    """
    d = np.broadcast_to(rays.directions, np.broadcast_shapes(rays.directions.shape, p1.shape))
    z = np.abs(d).argmax(axis=0)
    order = np.stack(((z + 1) % 3, (z + 2) % 3, z))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        dx, dy, dz = np.take_along_axis(d, order, axis=0)
        shear_x = dx / dz
        shear_y = dy / dz
        sheared: Sheared = []
        for corner in (p1, p2, p3):
            x, y, depth = np.take_along_axis(corner - rays.origins, order, axis=0)
            sheared.append((x - shear_x * depth, y - shear_y * depth, depth))
        weights = _edge_functions(sheared)
        hit, t, s = _weighed(weights, sheared, dz)
        if d.dtype == np.float32 and (again := (weights == 0).any(axis=0)).any():
            some: Sheared = [(x[again], y[again], depth[again]) for x, y, depth in sheared]
            finer = _edge_functions(
                [(x.astype(float), y.astype(float), depth) for x, y, depth in some]
            )
            dz = np.broadcast_to(dz, again.shape)[again]
            hit[again], t[again], s[:, again] = _weighed(finer, some, dz)
        return hit, t, s


def _weighed(weights: Vectors, sheared: Sheared, dz: Floats) -> Intersection:
    """Return hit, t and barycentrics for edge functions, and depths along the ray's axis."""
    area = weights[0] + weights[1] + weights[2]
    hit = ((weights >= 0).all(axis=0) | (weights <= 0).all(axis=0)) & (area != 0)
    s = weights / area
    return hit, dot(s, np.stack([depth for _, _, depth in sheared])) / dz, s


def _edge_functions(sheared: Sheared) -> Vectors:
    """Return twice the areas of the triangles that the ray makes with each edge, (3, n)."""
    (ax, ay, _), (bx, by, _), (cx, cy, _) = sheared
    return np.stack((cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax))


# By method: the function that tests n rays with n triangles.
TESTS: dict[Method, Callable[[Rays, Vectors, Vectors, Vectors], Intersection]] = {
    Method.TEXTBOOK_LITERAL: textbook_literal,
    Method.TEXTBOOK: textbook,
    Method.MOLLER_TRUMBORE: moller_trumbore,
    Method.WATERTIGHT: watertight,
}
