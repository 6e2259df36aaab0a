"""Which of two surfaces is nearer, for many rays at once.

Of surfaces that both are hit, T1 D2 - T2 D1 has the sign of t1 - t2, times that of D1 D2. For rays
from one point, T is the same for all of them and D = d . n, so that it is

    d . w,  w = T1 n2 - T2 n1

and for rays along one direction, D is the same for all and T = T0 - (o - o0) . n, so that it is

    f0 - (o - o0) . v,  v = D2 n1 - D1 n2,  f0 its value for the origin o0

w, or v and f0, belong to the two surfaces alone: integers find them once, and their rounded
values decide all rays for which the result is above its rounding error, as in `bounds.py`. Where
all of them are zero the surfaces lie in one plane.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..tracer.camera import Rays
from ..tracer.vector import dot
from .bounds import bound
from .exact import IntegerBatch

NEARER, COPLANAR, FARTHER, UNDECIDED = -1, 0, 1, 2


def applies(rays: Rays, start: float) -> bool:
    """Return whether rays share what is needed here, hits being sought from t = start on."""
    from_one_point, parallel = rays.origins.shape[1] == 1, rays.directions.shape[1] == 1
    return start >= 0 if from_one_point else parallel


def order_of(
    around: Rays, rays: Rays, batch: IntegerBatch, first: NDArray[np.intp], second: NDArray[np.intp]
) -> NDArray[np.int8]:
    """Return how the first of two surfaces lies, of n rays that surely hit both.

    Parameters
    ----------
    around : Rays
        To which the above :func:`applies`: they say what the rays share, and the first of them
        has o0.
    batch : IntegerBatch
        The surfaces as integers, with the first of the rays around.
    first, second : (n,) int
        Surfaces, as the batch numbers them.

    Returns
    -------
    order : (n,) int8
        NEARER, COPLANAR (the two lie in one plane), FARTHER or UNDECIDED.
    """
    key = first * (second.max(initial=0) + 1) + second
    _, index, which = np.unique(key, return_index=True, return_inverse=True)
    shared = around.origins.shape[1] == 1
    pairs = zip(first[index].tolist(), second[index].tolist(), strict=True)
    table = np.array([_difference(batch, *pair, shared) for pair in pairs]).reshape(-1, 5).T
    coplanar = ~table.any(axis=0)[which]
    base, *v, sign = table[:, which]
    x = rays.directions if shared else rays.origins - around.origins[:, :1]
    value, size = base + dot(x, v), np.abs(x)
    error = bound(np.abs(base) + dot(size, np.abs(v)), size)
    known = np.abs(value) > error
    order = np.where(known, np.sign(value) * sign, UNDECIDED)
    return np.where(coplanar, COPLANAR, order).astype(np.int8)


def _difference(
    batch: IntegerBatch, first: int, second: int, shared_origin: bool
) -> tuple[float, ...]:
    """Return f0, v (or 0, w), and the sign of D1 D2, each rounded once; 0 all for one plane.

    One power of two scales f0 and v alike, so that the largest of them is near 1.
    """
    (t1, d1, n1), (t2, d2, n2) = map(batch.of_first_ray, (first, second))
    if shared_origin:  # both t are positive, so that D has the sign of T
        base, by1, by2, same = 0, t1, t2, (t1 > 0) == (t2 > 0)
    else:
        base = t1 * d2 - t2 * d1
        by1, by2, same = d1, d2, (d1 > 0) == (d2 > 0)
    v = [by1 * b - by2 * a for a, b in zip(n1, n2, strict=True)]
    unit = 0 if shared_origin else batch.unit
    bits = max(base.bit_length() + unit, *(k.bit_length() for k in v))
    if not any((base, *v)):
        return 0.0, 0.0, 0.0, 0.0, 0.0
    scaled = (_scaled(base, unit - bits), *(_scaled(k, -bits) for k in v))
    return (*scaled, 1.0 if same else -1.0)


def _scaled(value: int, exponent: int) -> float:
    """Return value * 2^exponent, correctly rounded; at most 1."""
    return value / (1 << -exponent) if exponent < 0 else float(value << exponent)
