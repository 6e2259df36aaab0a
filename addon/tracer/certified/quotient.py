"""t = T / D of rays and surfaces that they surely hit, rounded to the nearest float64.

T = (p - o) . n and D = d . n are sums of three products each. Vectors are split into a high half of
25 digits and the rest (`halves`), so that what the high halves make is exact, and all
else is some 2^-25 of it: with its own roundings a scalar product v . n is off by at most

    V (N + 3 M) 2^-72

for powers of two V > |v|, N > |n|, in the largest component, and M, the product of those of the
two sides that n is the cross product of: 6 products of at most 2^-25 V N each, with at most 6
roundings; the rest of n, with one; and the error of n, which is likewise at most 2^-72 M.

The quotient is corrected by what is left of T - t D; then there is almost always a single float64
that it may be rounded to (Ziv's test), and it is.

Sums and products without error, as a float and the rest that it leaves, are at the end. They hold
as long as nothing under- or overflows; an overflow ends in NaN or inf. Source: Dekker, "A
floating-point technique for extending the available precision", Numerische Mathematik 18, 1971;
Knuth, "The art of computer programming", vol. 2, 4.2.2, theorem B.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..camera import Rays
from ..vector import Floats, Vectors, gather, largest, parts
from .bounds import U

_CHUNK = 1 << 13  # triangles prepared at a time: their temporaries stay in a core's cache
_DOT = 2.0**-72
_QUOTIENT = 32 * U * U  # of the correction's own roundings, relative to t
_LEAST = 2.0**-950  # of what T and D are made of: below, products lose digits to underflow
_LOOSE = 1 + 2.0**-40  # the bounds' own roundings

BITS = 25  # of the high halves that `halves` leaves
_SPLITTER = 2.0**27 + 1  # leaves halves of 26 digits, whose products are exact

Pair = tuple[Floats, Floats]  # high + low, |low| <= u |high|
Sum = tuple[Floats, Floats, Floats]  # high, low, error


class Quotients:
    """The planes of m surfaces, prepared for rays that share an origin, a direction, or nothing.

    Parameters
    ----------
    rays : Rays
        Of which the shared vector, and the first origin, are used.
    point : (3, m) float64
        A point of each plane.
    normal : Pair of (3, m) float64
        n, high and low.
    error : (m,) float64
        M; 0 where n has no error.
    """

    def __init__(self, rays: Rays, point: Vectors, normal: Pair, error: Floats) -> None:
        self._one_origin = rays.origins.shape[1] == 1
        self._one_direction = rays.directions.shape[1] == 1
        self._origin, self._point = rays.origins[:, :1], point
        high, low = normal
        unit = power_above(high)
        coarse, fine = halves(high, unit)
        self._normals = np.concatenate((coarse, fine + low, ((unit + 3 * error) * _DOT)[None]))
        every = np.arange(point.shape[1])
        self._fixed = np.zeros((0, len(every)))  # what is the same for all rays
        if self._one_origin or self._one_direction:
            numerator = self._dot(*two_sum(point, -self._origin), every)
            denominator = () if self._one_origin else self._along(rays, every)
            self._fixed = np.stack((*numerator, *denominator))

    @classmethod
    def of(cls, rays: Rays, corners: NDArray[np.float64], planes: Sequence = ()) -> Quotients:
        """Prepare infinite planes, (point, normal) each, then triangles, corners (3, 3, m)."""
        all_parts = []
        if planes:
            point, normal = (np.array(v, np.float64).T for v in zip(*planes, strict=True))
            nothing = np.zeros_like(normal)
            all_parts.append(cls(rays, point, (normal, nothing), nothing[0]))
        for part in parts(max(1, corners.shape[2]), _CHUNK):
            a, b, c = corners[..., part]
            normal, error = _cross(two_sum(b, -a), two_sum(c, -a))
            all_parts.append(cls(rays, a, normal, np.where(error > _LEAST, error, np.inf)))
        out = all_parts[0]
        for name in ("_point", "_normals", "_fixed"):
            setattr(out, name, np.concatenate([getattr(p, name) for p in all_parts], axis=1))
        return out

    def meet(self, rays: Rays, surface: NDArray[np.intp]) -> tuple[Floats, NDArray[np.bool_]]:
        """Return t of p rays with surfaces, and whether it surely is the nearest float64."""
        if self._one_origin:
            numerator = tuple(gather(self._fixed, surface))
            return _quotient(numerator, self._along(rays, surface))
        if not self._one_direction:
            point = gather(self._point, surface)
            numerator = self._dot(*two_sum(point, -rays.origins), surface)
            return _quotient(numerator, self._along(rays, surface))
        high, low, error, *denominator = gather(self._fixed, surface)
        moved = self._dot(*two_sum(rays.origins, -self._origin), surface)
        high, rest = two_sum(high, -moved[0])
        numerator = *two_sum(high, rest + (low - moved[1])), error + moved[2]
        return _quotient(numerator, tuple(denominator))

    def _along(self, rays: Rays, surface: NDArray[np.intp]) -> Sum:
        return self._dot(rays.directions, 0.0, surface)

    def _dot(self, v: Vectors, rest: Vectors | float, surface: NDArray[np.intp]) -> Sum:
        """Return (v + rest) . n."""
        unit = power_above(v)
        coarse, fine = halves(v, unit)
        fine = fine + rest
        nx, ny, nz, mx, my, mz, error = gather(self._normals, surface)
        exact = coarse[0] * nx + coarse[1] * ny + coarse[2] * nz
        small = (
            (coarse[0] * mx + fine[0] * (nx + mx))
            + (coarse[1] * my + fine[1] * (ny + my))
            + (coarse[2] * mz + fine[2] * (nz + mz))
        )
        error = error * unit
        error = np.where(error > _LEAST * _DOT, error, np.inf)
        return *two_sum(exact, small), error


def _cross(u: Pair, v: Pair) -> tuple[Pair, Floats]:
    """Return u x v as high + low, and M, the product of the powers of two above u and v."""
    units = power_above(u[0]), power_above(v[0])
    (uh, ul), (vh, vl) = (halves(w[0], unit) for w, unit in zip((u, v), units, strict=True))
    ul, vl = ul + u[1], vl + v[1]
    high, low = np.empty_like(uh), np.empty_like(uh)
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        exact = uh[i] * vh[j] - uh[j] * vh[i]
        small = (uh[i] * vl[j] + ul[i] * v[0][j]) - (uh[j] * vl[i] + ul[j] * v[0][i])
        high[k], low[k] = two_sum(exact, small)
    return (high, low), units[0] * units[1]


def _quotient(numerator: Sum, denominator: Sum) -> tuple[Floats, NDArray[np.bool_]]:
    """Return T / D as a float64, and whether no other is as near."""
    high, low, numerator_error = numerator
    under, rest, denominator_error = denominator
    first = high / under
    product, lost = two_product(first, under)
    left = ((high - product) - lost) + (low - first * rest)
    t, beyond = fast_two_sum(first, left / under)
    size = np.abs(first)
    error = (size * denominator_error + numerator_error) / (np.abs(under) - denominator_error)
    error = (error + _QUOTIENT * size) * _LOOSE
    sure = (np.abs(under) > 2 * denominator_error) & (np.abs(high) > _LEAST) & (size > _LEAST)
    sure &= (t + (beyond + error) == t) & (t + (beyond - error) == t)
    return t, sure


def two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b."""
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def fast_two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b, for |a| >= |b| or a = 0."""
    total = a + b
    return total, b - (total - a)


def two_product(a: Floats, b: Floats) -> Pair:
    """Return a * b."""
    product = a * b
    a_high, a_low = _split(a)
    b_high, b_low = _split(b)
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def power_above(v: Floats) -> Floats:
    """Return the power of two above the largest component of vectors (3, n)."""
    return np.ldexp(1.0, np.frexp(largest(*np.abs(v)))[1])


def halves(v: Floats, unit: Floats) -> Pair:
    """Return v as a multiple of unit * 2^-BITS and the rest, for |v| <= unit, a power of two.

    Three products of two such multiples, and sums of them, are exact: they have at most 52 digits.
    """
    shift = unit * (1.5 * 2.0 ** (52 - BITS))
    high = (v + shift) - shift
    return high, v - high


def _split(a: Floats) -> Pair:
    scaled = _SPLITTER * a
    high = scaled - (scaled - a)
    return high, a - high
