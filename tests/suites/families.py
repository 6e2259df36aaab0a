"""Families of n pairs of a ray and a triangle, each hard in its own way.

Each is a function of (rng, n) and returns origins, directions (3, n) or (3, 1), and corners
(3, 3, n). `at_any_size` scales them by powers of two, which changes no digit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def on_sphere(rng: np.random.Generator, count: int, radius: float = 1.0) -> NDArray[np.float64]:
    """Return points (3, count) evenly distributed on a sphere."""
    points = rng.normal(size=(3, count))
    return radius * points / np.sqrt((points**2).sum(axis=0))


def generic(rng, n):
    """Nothing special; about a third hit."""
    corners = rng.normal(size=(3, 3, n))
    weights = rng.uniform(-0.4, 1, (3, n))
    o = rng.normal(size=(3, n)) * 4
    return o, (weights / weights.sum(axis=0) * corners.transpose(1, 0, 2)).sum(axis=1) - o, corners


def near_coplanar(rng, n):
    """Origin, end and triangle in one plane but for rounding, and a few ulp more."""
    a, b, c = corners = rng.normal(size=(3, 3, n))
    u, v = rng.uniform(-1, 2, (2, n))
    p, q = rng.uniform(-3, 3, (2, n))
    o, end = a + p * (b - a) + q * (c - a), a + u * (b - a) + v * (c - a)
    o = o * (1 + rng.integers(-4, 5, (3, n)) * 2.0**-52)
    return o, end - o, corners


def at_edges(rng, n):
    """At a point of an edge, as near as floats come to it."""
    a, b, _ = corners = rng.normal(size=(3, 3, n))
    o = rng.normal(size=(3, n)) * 3
    return o, a + rng.uniform(-0.1, 1.1, n) * (b - a) - o, corners


def at_vertices(rng, n):
    """At a corner: exactly where the difference happens to be exact."""
    corners = np.round(rng.normal(size=(3, 3, n)) * 2.0**20) / 2.0**20
    o = rng.normal(size=(3, n))
    o[:, ::2] = np.round(o[:, ::2] * 2.0**20) / 2.0**20
    return o, corners[rng.integers(3, size=n), :, np.arange(n)].T - o, corners


def slivers(rng, n):
    """Needles, one ulp wide to a thousandth, and such without any area."""
    a, b, _ = corners = rng.normal(size=(3, 3, n))
    width = 10.0 ** rng.uniform(-17, -3, n)
    corners[2] = a + rng.uniform(-0.2, 1.2, n) * (b - a) + width * rng.normal(size=(3, n))
    s = rng.uniform(-0.1, 1.1, n)
    o = rng.normal(size=(3, n)) * 3
    target = a + s * (b - a) + width * rng.uniform(-0.5, 1, n) * rng.normal(size=(3, n))
    return o, target - o, corners


def from_far(rng, n):
    """All from one point, up to 10^15 times as far as the triangle is large."""
    corners = rng.normal(size=(3, 3, n))
    o = on_sphere(rng, 1, 10.0 ** rng.uniform(0, 15))
    return o, corners.mean(axis=0) + rng.normal(size=(3, n)) * 0.5 - o, corners


def parallel(rng, n):
    """All along one direction of few digits, at points of edges and corners too."""
    corners = np.round(rng.normal(size=(3, 3, n)) * 64) / 64
    d = rng.integers(-8, 9, (3, 1)) / 8 + np.array([[0], [0], [2.0]])
    u, v = rng.integers(-1, 6, (2, n)) / 4
    a, b, c = corners
    o = a + u * (b - a) + v * (c - a) - d * rng.integers(-2, 5, n)
    return o, d, corners


def whole_numbers(rng, n):
    """Small integers: every third ray meets an edge, a corner, or nothing that has an area."""
    o, d = rng.integers(-3, 4, (2, 3, n)).astype(float)
    d[2, ~d.any(axis=0)] = 1
    return o, d, rng.integers(-3, 4, (3, 3, n)).astype(float)


FAMILIES = (
    generic,
    near_coplanar,
    at_edges,
    at_vertices,
    slivers,
    from_far,
    parallel,
    whole_numbers,
)

SIZES = ("as it is", "all", "each", "mixed", "smallest", "largest")


def at_any_size(rng, o, d, corners, how):
    """Scale lengths and directions: as they are, by one power of two for all, by one for each.

    "mixed" gives some coordinates of the corners one of their own. The smallest lengths have few
    digits left below 2^-1022; the differences of the largest overflow.
    """
    if how == "as it is":
        return o, d, corners
    if how in ("smallest", "largest"):
        most = max(np.abs(o).max(), np.abs(corners).max())
        lengths = 2.0 ** (1023 - np.ceil(np.log2(most))) if how == "largest" else 2.0**-1060
        directions = 2.0 ** rng.integers(-900, 901)
        return o * lengths, d * directions, corners * lengths
    if how == "all":
        lengths, directions = 2.0 ** rng.integers(-500, 501, 2)
        return o * lengths, d * directions, corners * lengths
    n = corners.shape[2]
    lengths, directions = 2.0 ** rng.integers(-500, 501, (2, n))
    o, d = (np.broadcast_to(v, (3, n)) for v in (o, d))
    if how == "each":
        return o * lengths, d * directions, corners * lengths
    powers = 2.0 ** rng.integers(-500, 501, (3, 3, n))
    few = rng.random((3, 3, n)) < 0.8
    return o * lengths, d * directions, corners * np.where(few, lengths, powers)
