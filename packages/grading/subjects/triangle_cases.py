"""Makes pairs of rays and triangles that show one thing each, in groups.

What a student's function makes of a group says what is wrong with it (`triangle_faults.py`), which
a picture alone would not: no camera has a triangle behind it, and a closed surface looks the same
without its back faces.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from reference_tracer.arrays import Bools, Floats

from ..programs import unit

SEED = 20240611
EACH = 400  # pairs of a group
SCALES = -30, -20, 20  # powers of two: what a float is multiplied by without rounding


Pairs = tuple[Floats, Floats, Floats]  # origins, directions, triangles


def groups(seed: int = SEED) -> dict[str, Pairs]:
    """Return pairs by their groups; the same for the same seed."""
    rng = np.random.default_rng(seed)
    front = _towards(rng, _triangles(rng), rng.dirichlet((2, 2, 2), EACH) * 0.85 + 0.05)
    o, d, p = front
    return {
        "front": front,
        "back": (o, d, p[:, [0, 2, 1]]),
        "whole": whole(rng),
        "scaled": _scaled(front),
        "outside": _towards(rng, _triangles(rng), _outside(rng)),
        "beside": _towards(rng, _triangles(rng), _beside(rng)),
        "behind": (o, -d, p),
        "parallel": _parallel(rng),
        "empty": _empty(rng),
        "elsewhere": _elsewhere(rng),
    }


def normals(p: Floats) -> Floats:
    """Return the normals of triangles (n, 3, 3), (n, 3)."""
    return np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])


def _drawn(draw: Callable[[], Floats], wanted: Callable[[Floats], Bools]) -> Floats:
    """Return the first EACH triangles that are wanted, (EACH, 3, 3)."""
    out = np.zeros((0, 3, 3))
    while len(out) < EACH:
        some = draw()
        out = np.concatenate((out, some[wanted(some)]))
    return out[:EACH]


def _triangles(rng: Generator) -> Floats:
    """Return triangles of an ordinary shape, (EACH, 3, 3)."""

    def ordinary(p: Floats) -> Bools:
        longest = np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2).max(axis=1)
        high = np.linalg.norm(normals(p), axis=1) > 0.3 * longest**2
        return high & (longest > 0.5)

    return _drawn(lambda: rng.normal(size=(EACH, 3, 3)), ordinary)


def _powers(base: float, exponents: Floats) -> Floats:
    """Return powers one by one: numpy's last digit depends on the processor's vector unit."""
    return np.array([base**e for e in exponents.ravel().tolist()]).reshape(exponents.shape)


def _towards(rng: Generator, p: Floats, s: Floats) -> Pairs:
    """Return rays towards points of triangles' planes, from the front, at no small angle."""
    away = unit(normals(p)) + 0.6 * unit(rng.normal(size=(len(p), 3)))
    length, speed = rng.uniform(2, 6, (len(p), 1)), _powers(2, rng.uniform(-2, 2, (len(p), 1)))
    point = (s[:, :, None] * p).sum(axis=1)
    return point + length * away, -speed * away, p


def _outside(rng: Generator) -> Floats:
    """Return barycentrics of which one or two are clearly negative."""
    s = rng.uniform(0.1, 1, (EACH, 3))
    which = np.arange(EACH)
    s[which, which % 3] *= -1
    two = which[1::2]
    s[two, (two + 1) % 3] *= -1
    total = s.sum(axis=1, keepdims=True)
    s += np.where(s > 0, 1.5 - total, 0) / (s > 0).sum(axis=1, keepdims=True)
    return s / s.sum(axis=1, keepdims=True)


def _elsewhere(rng: Generator) -> Pairs:
    """Return rays through points all around their triangles, half of them behind the origin."""
    s = rng.uniform(-1.5, 2, (EACH, 3))
    s[:, 0] = 1 - s[:, 1] - s[:, 2]
    o, d, p = _towards(rng, _triangles(rng), s)
    return np.tile(o, (2, 1)), np.concatenate((d, -d)), np.tile(p, (2, 1, 1))


def _beside(rng: Generator) -> Floats:
    """Return barycentrics of which one is nearly 0, on either side."""
    s = rng.uniform(0.2, 0.8, (EACH, 3))
    which = np.arange(EACH)
    s[which, which % 3] = 0
    s /= s.sum(axis=1, keepdims=True)
    by = np.where(which % 2, 1, -1) * _powers(10, rng.uniform(-9, -4, EACH))
    s[which, which % 3] = by
    s[which, (which + 1) % 3] -= by
    return s


def whole(rng: Generator) -> Pairs:
    """Return hits whose every product, sum and quotient is a float: legs are powers of two."""
    legs = 2.0 ** rng.integers(0, 4, (EACH, 2))
    s2 = rng.integers(1, 8, EACH) / 16
    s3 = rng.integers(1, 8, EACH) / 16
    p1 = rng.integers(-8, 9, (EACH, 3)).astype(float)
    p = np.repeat(p1[:, None], 3, axis=1)
    p[:, 1, 0] += legs[:, 0]
    p[:, 2, 1] += legs[:, 1]
    d = np.stack(
        (*(rng.integers(-2, 3, (2, EACH))), np.where(rng.random(EACH) < 0.5, 1, -1)), axis=1
    ) * 2.0 ** rng.integers(-2, 3, (EACH, 1))
    point = p1 + s2[:, None] * (p[:, 1] - p1) + s3[:, None] * (p[:, 2] - p1)
    o = point - 4 * d
    turn = rng.integers(0, 3, EACH)  # which axis the triangle is across
    order = (np.arange(3) + turn[:, None]) % 3
    return (
        np.take_along_axis(o, order, axis=1),
        np.take_along_axis(d, order, axis=1),
        np.take_along_axis(p, order[:, None], axis=2),
    )


def _scaled(front: Pairs) -> Pairs:
    o, d, p = front
    scales = [2.0**k for k in SCALES]
    return (
        np.concatenate([o * k for k in scales]),
        np.concatenate([d for _ in scales]),
        np.concatenate([p * k for k in scales]),
    )


def _parallel(rng: Generator) -> Pairs:
    """Return rays along the plane of a triangle of integers, beside it, over its middle."""
    p = _drawn(
        lambda: rng.integers(-9, 10, (EACH, 3, 3)).astype(float),
        lambda some: np.abs(normals(some)).sum(axis=1) > 20,
    )
    e, f = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    d = rng.integers(1, 4, (EACH, 1)) * e + rng.integers(-3, 4, (EACH, 1)) * f
    return p[:, 0] - 2 * d + np.sign(normals(p)), d, p


def _empty(rng: Generator) -> Pairs:
    """Return rays through the middle of triangles whose corners are in a line, or one point."""
    first = rng.integers(-9, 10, (EACH, 3)).astype(float)
    e = rng.integers(-4, 5, (EACH, 3)).astype(float)
    e[::4] = 0
    p = np.stack((first, first + 2 * e, first + 4 * e), axis=1)
    d = rng.integers(-4, 5, (EACH, 3)) + 0.5
    return first + e - 2 * d, d, p
