"""The truth about pairs of a ray and a triangle, and how far a sound float64 answer may be off.

Whether a ray meets its triangle is decided by the certified tracer. How far a student's numbers may
be off is a bound, so that nobody is blamed for rounding: with arm = p1 - o, the edges' product
N = |p2 - p1| x |p3 - p1| (all terms with +), the longest edge L, n the normal and k = L^2 / |n|,

    e  = K u (|arm| . N + |t| |d| . N) / |d . n|        of t, from the plane
    dx = |d| e + 4 u (|o| + |t d| + |p|)                of the point
    dv = K u |d| . (|a| x |b| + |b| x |c| + |c| x |a|) / |d . n|, a b c the corners less o
    ds = K u k^2 + k dx / L + dv
    dt = e + (K u k^2 + dv) L / |d|

These are the textbook's formulas, term by term, each term's size times some roundings u = 2^-53: n
carries an error of some u N; t that of two products with n; x = o + t d that of t; and s_i is
n . n_si / |n|^2, whose n_si has the error of x times an edge, and which cancels once more where the
triangle is a needle. Möller and Trumbore's is of a lower degree, so that the bound holds for it.
dv is for barycentrics as signed volumes, s_1 = d . (c x b) / (d . n): by backward analysis each
volume, of degree 3, is that of corners which are moved by some roundings of their own distance from
o, each volume by others. A change of b by u |b| moves d . (c x b) by u |d| . (|c| x |b|): that is
the condition of the pair, and no formula from these data can be held to less.
The last term of dt is for formulas that find t between the corners' depths: t d is the sum of the
s_i times the arms, so that errors whose sum is 0 move it by theirs times what the arms differ by,
at most L; one component of t d, the largest, is not below |d| / sqrt 3, which K has room for.
K is not small: it stands for every order of summation, and for formulas that are somewhat worse.
Where n . n leaves float64's range there is no bound at all.
What is nearer to an edge than ds is *in doubt*: float64 may say either.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from reference_tracer.arrays import Floats
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.bounds import FromPoint, U, cross_magnitude
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.vector import cross, dot

ROUNDINGS = 16  # K
LEAST = 2.0**-960  # of n . n: below it, products have lost digits at float64's lower end

# A student's function: origins, directions, triangles -> t, barycentrics.
Ask = Callable[..., tuple[Floats, ...]]


@dataclass(frozen=True, eq=False)
class Known:
    """The truth of n pairs.

    `t` (n,) and `s` (n, 3) are those of the triangle's plane, also where the ray passes beside the
    triangle; NaN where it is parallel to it.
    """

    hit: NDArray[np.bool_]  # (n,) the certified ray meets the triangle, in the clip range
    doubt: NDArray[np.bool_]  # (n,) sound float64 may say otherwise
    t: Floats
    t_allowed: Floats  # (n,) how far an answer may be off; NaN or inf: as far as it likes
    s: Floats
    s_allowed: Floats


def known(
    origins: Floats,
    directions: Floats,
    triangles: Floats,
    start: float = 0.0,
    end: float = np.inf,
) -> Known:
    """Return the truth of n pairs, seen with start <= t <= end, and t > 0.

    Parameters
    ----------
    origins, directions : (n, 3) float64
    triangles : (n, 3, 3) float64
        Pair, corner, component.
    start, end : float
    """
    rays = Rays(origins.T, directions.T)
    corners = triangles.transpose(1, 2, 0)
    hit = decide(rays, corners, start, end).crossed
    with np.errstate(all="ignore"):  # what over- or underflows is in doubt
        t, s = plane_hits(rays, corners)
        t_allowed, s_allowed = allowed(rays, corners, t)
        near_edge = (np.abs(s) <= s_allowed).any(axis=0) & (s >= -s_allowed).all(axis=0)
        near_end = (np.abs(t - start) <= t_allowed) | (np.abs(t - end) <= t_allowed)
        doubt = near_edge | near_end | ~np.isfinite(s_allowed)
    return Known(hit, doubt, t, t_allowed, s.T, s_allowed)


def plane_hits(rays: Rays, corners: Floats) -> tuple[Floats, Floats]:
    """Return t (n,) and barycentrics (3, n) where rays meet their triangles' planes."""
    count = corners.shape[2]
    prepared = FromPoint(rays.origins, np.abs(rays.directions), corners)
    edges, _ = prepared.edges(np.arange(count), rays)
    fractions = prepared.fractions(np.arange(count), rays)
    towards = np.where(fractions.denominator == 0, np.nan, fractions.denominator)
    return fractions.numerator / towards, edges[[1, 2, 0]] / towards


def allowed(rays: Rays, corners: Floats, t: Floats) -> tuple[Floats, Floats]:
    """Return how far t and barycentrics may be off, (n,) each: see the head of this file."""
    a, b, c = corners
    o, d = rays.origins, rays.directions
    sides = np.abs(np.stack((b - a, c - a, c - b)))
    product = cross_magnitude(sides[0], sides[1])
    n = cross(b - a, c - a)
    square = dot(n, n)
    size, longest = np.sqrt(square), np.sqrt((sides * sides).sum(axis=1).max(axis=0))
    terms = dot(np.abs(a - o), product) + np.abs(t) * dot(np.abs(d), product)
    of_t = ROUNDINGS * U * terms / np.abs(dot(d, n))
    far = (
        np.abs(o).sum(axis=0) + np.abs(t * d).sum(axis=0) + np.abs(corners).max(axis=0).sum(axis=0)
    )
    point = np.abs(d).sum(axis=0) * of_t + 4 * U * far
    shape = longest * longest / size
    arms = np.abs(corners - o)
    volumes = [dot(np.abs(d), cross_magnitude(arms[k - 1], arms[k])) for k in range(3)]
    of_volumes = np.sum(volumes, axis=0) / np.abs(dot(d, n))
    of_s = ROUNDINGS * U * (shape * shape + of_volumes)
    s_allowed = of_s + shape * point / longest
    t_allowed = of_t + of_s * longest / np.sqrt(dot(d, d))
    bounded = (square >= LEAST) & np.isfinite(square)
    return np.where(bounded, t_allowed, np.inf), np.where(bounded, s_allowed, np.inf)
