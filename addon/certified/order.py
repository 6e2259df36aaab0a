"""Decides which of two surfaces is nearer, for many rays at once.

Where a ray meets both, f = T1 D2 - T2 D1 has the sign of t1 - t2, times that of D1 D2. For rays
from one point, T is the same for all rays and D = d . n, so that

    f = d . w,  w = T1 n2 - T2 n1.

For rays along one direction, D is the same for all rays and T = T0 - (o - o0) . n, so that

    f = f0 - (o - o0) . v,  v = D2 n1 - D1 n2,  f0 = f for the origin o0.

w, or v and f0, belong to the two surfaces alone. Integers find them once. Rounded to float64, they
decide all rays for which |f| is above its rounding error, as in `bounds.py`. Where all of them are
zero, the surfaces lie in one plane. Theorem: `CodeOrder.code_order_right`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arrays import Index
from ..tracer.camera import Rays
from ..tracer.vector import dot
from .bounds import bound
from .exact import IntegerBatch

# How the first of two surfaces lies.
NEARER = -1
COPLANAR = 0
FARTHER = 1
UNDECIDED = 2


def applies(rays: Rays, start: float) -> bool:
    """Return whether :func:`order_of` can decide the order of hits with t >= start of rays."""
    return start >= 0 if rays.one_origin else rays.one_direction


def order_of(
    around: Rays, rays: Rays, batch: IntegerBatch, first: Index, second: Index
) -> NDArray[np.int8]:
    """Return how the first of two surfaces lies, for n rays that surely meet both.

    Parameters
    ----------
    around : Rays
        Rays for which the method :func:`applies`. They share what the n rays share; the origin of
        the first is o0.
    rays : Rays
        The n rays.
    batch : IntegerBatch
        The surfaces as integers, with the first of `around`.
    first, second : (n,) int
        The surfaces' numbers in the batch.

    Returns
    -------
    order : (n,) int8
        NEARER, COPLANAR (the two lie in one plane), FARTHER or UNDECIDED.
    """
    key = first * (np.max(second, initial=0) + 1) + second
    _, index, which = np.unique(key, return_index=True, return_inverse=True)
    shared = around.one_origin
    pairs = zip(first[index].tolist(), second[index].tolist(), strict=True)
    table = np.array([_difference(batch, *pair, shared) for pair in pairs]).reshape(-1, 5).T
    coplanar = ~table.any(axis=0)[which]
    columns = table[:, which]
    base = columns[0]
    v = columns[1:4]
    x = rays.directions if shared else rays.origins - around.origins[:, :1]
    size = np.abs(x)
    value = base + dot(x, v)
    error = bound(np.abs(base) + dot(size, np.abs(v)), size)
    known = np.abs(value) > error
    order = np.where(known, np.sign(value) * columns[4], UNDECIDED)
    return np.where(coplanar, COPLANAR, order).astype(np.int8)


def _difference(
    batch: IntegerBatch, first: int, second: int, shared_origin: bool
) -> tuple[float, ...]:
    """Return f0, v (or 0, w), and the sign of D1 D2, each rounded once; zeros for one plane.

    f0 and v are scaled by one power of two, so that the largest of them is near 1.
    """
    t1, d1, n1 = batch.of_first_ray(first)
    t2, d2, n2 = batch.of_first_ray(second)
    if shared_origin:  # both t are positive, so that D has the sign of T
        base = 0
        by1 = t1
        by2 = t2
    else:
        base = t1 * d2 - t2 * d1
        by1 = d1
        by2 = d2
    v = [by1 * b - by2 * a for a, b in zip(n1, n2, strict=True)]
    unit = 0 if shared_origin else batch.unit
    bits = max(base.bit_length() + unit, *(k.bit_length() for k in v))
    if not any((base, *v)):
        return 0.0, 0.0, 0.0, 0.0, 0.0
    sign = 1.0 if (by1 > 0) == (by2 > 0) else -1.0
    return (_scaled(base, unit - bits), *(_scaled(k, -bits) for k in v), sign)


def _scaled(value: int, exponent: int) -> float:
    """Return value * 2^exponent, at most 1, correctly rounded."""
    return value / (1 << -exponent) if exponent < 0 else float(value << exponent)
