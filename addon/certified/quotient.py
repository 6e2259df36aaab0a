"""Computes t = T / D of rays and surfaces that they surely meet, rounded to the nearest float64.

T = (p - o) . n and D = d . n are sums of three products each. Vectors are split into a high half of
25 digits and the rest (`halves`), so that what the high halves make is exact, and all else is some
2^-25 of it: a scalar product v . n is the sum of two floats, the second of them at most
6 V N 2^-26, but for an error of at most

    e = V (N + 3 M) 2^-72

for powers of two V > |v|, N > |n|, in the largest component, and M, the product of those of the
two sides that n is the cross product of: 6 products of at most 2^-26 V N each, with at most 6
roundings, and 9 of the rests of v and n, and of their sums, make 2^-73.5 V N; and the error of n,
which is likewise at most 2^-72 M. V may be that of all the rays.

Let T = T1 + T2 and D = D1 + D2, but for their errors, b = |T2 / T| + |D2 / D| < 1/8, q the 26
highest digits of (T1 + T2) / (D1 + D2), and D1 = d1 + d2, of 26 and 27 digits. Then

    t = q + c,   c = (((T1 - q d1) - q d2) + (T2 - q D2)) / (D1 + D2)

with both products of q exact, as is the first difference (Sterbenz): q d1 is T1 but for a share of
b + 2^-24. The others are at most |T| (2 b + 2^-24); with their roundings, those of the division and
of c +- E below, c is off by less than

    |t| (2^-51 b + 2^-75)  <  |t| 2^-72.7 V N (1 / |D| + 1 / |T|),

each with its own V, as |T2| and |D2| are at most 6 V N 2^-26, and |D| at most 3.1 V N. With their
own 2^-73.5 that is still within the e above: t is off by at most E = |t| (e_D / |D| + e_T / |T|).
Where q + (c - E) and q + (c + E) are the same float, that is the nearest to t, as addition is
monotone (Ziv's test). It takes an E < 2^-52 |t|: so V N (1 / |D| + 1 / |T|) < 2^20, and b < 1/8.

This holds as long as nothing under- or overflows; where it might, e is inf.

References: Dekker, "A floating-point technique for extending the available precision", Numerische
Mathematik 18, 1971. Ziv, "Fast evaluation of elementary mathematical functions with correctly
rounded last bit", ACM TOMS 17, 1991. Knuth, "The art of computer programming", vol. 2, 4.2.2,
theorem B. Theorems: `QuotientBinary.binary_from_point`, and so on.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Bools, Floats, Index, parts
from ..tracer.camera import Rays
from ..tracer.vector import Vectors, cross, gather, largest

_CHUNK = 1 << 13  # triangles prepared at a time: their temporaries stay in a core's cache
_DOT = 2.0**-72
_LEAST = 2.0**-950  # products of smaller numbers may lose digits to underflow
_MOST = 2.0**1000  # a smaller number has not overflown, and its inverse has all digits
_LOOSE = 1.01  # covers the roundings of the bounds themselves

BITS = 25  # of the high halves that `halves` leaves
_TOP = np.int64(-1 << 27)  # of a float's bits: sign, exponent, and the 26 highest digits
_EXPONENT = np.int64(0x7FF << 52)

Pair = tuple[Floats, Floats]  # high + low
Sum = tuple[Floats, Floats, Floats]  # T or D: high + low, and the bound e on its error


class Quotients:
    """The planes of m surfaces, for rays that share an origin, a direction, or nothing.

    Parameters
    ----------
    rays : Rays
        Rays that share the same, and enclose all others by component.
    count : int
        m.
    """

    def __init__(self, rays: Rays, count: int) -> None:
        self._one_origin = rays.one_origin
        self._one_direction = rays.one_direction
        self._origin = rays.origins[:, :1]
        self._direction = rays.directions[:, :1]
        apart = rays.directions if self._one_origin else rays.origins - self._origin
        self._unit = power_above(np.abs(apart).max(axis=1))
        # The halves of n; then high, low and e of T and D, as far as all rays share them.
        folded = self._one_direction and not self._one_origin
        self._table = np.empty((12 if folded else 10, count))

    @classmethod
    def of(
        cls, rays: Rays, corners: Vectors, planes: Sequence[tuple[Floats, Floats]] = ()
    ) -> Quotients:
        """Prepare infinite planes, (point, normal) each, then triangles, corners (3, 3, m)."""
        first = len(planes)
        out = cls(rays, first + corners.shape[2])
        if planes:
            points = np.array([point for point, _ in planes], np.float64).T
            normals = np.array([normal for _, normal in planes], np.float64).T
            out._enter(out._table[:, :first], points, (normals, np.zeros_like(normals)), 0.0)
        for part in parts(corners.shape[2], _CHUNK):
            a, b, c = corners[..., part]
            normal, error = _cross(two_sum(b, -a), two_sum(c, -a))
            error = np.where(error > _LEAST, error, np.inf)
            out._enter(out._table[:, first:][:, part], a, normal, error)
        return out

    def _enter(self, table: Floats, point: Vectors, normal: Pair, error: Floats | float) -> None:
        """Fill the columns of k planes, with a point (3, k), the normal and M of each."""
        unit = power_above(normal[0])
        both = np.empty((6, len(unit)))
        both[:3], both[3:] = halves(normal[0], unit)
        both[3:] += normal[1]
        table[:6] = both
        size = unit + 3 * error
        if not (self._one_origin or self._one_direction):
            table[6] = size
            table[7:] = point
            return
        arm, rest = two_sum(point, -self._origin)
        reach = power_above(arm)
        table[6], table[7] = two_sum(*_dot(arm, rest, reach, both))
        table[8] = _error(reach, size)
        if self._one_origin:
            table[9] = _error(self._unit, size)
        else:
            table[8] += _error(self._unit, size)
            along = power_above(self._direction)
            table[9], table[10] = _dot(self._direction, 0.0, along, table[:6].copy())
            table[11] = _error(along, size)

    def meet(self, rays: Rays, surface: Index) -> tuple[Floats, Bools]:
        """Return t of p rays with surfaces, and whether it surely is the nearest float64."""
        table = gather(self._table, surface)
        normal = table[:6]
        rest = table[6:]
        if self._one_origin:
            under = _dot(rays.directions, 0.0, self._unit, normal)
            return _quotient((rest[0], rest[1], rest[2]), (*under, rest[3]))
        if self._one_direction:
            exact, small = _dot(*two_sum(rays.origins, -self._origin), self._unit, normal)
            high, low = two_sum(rest[0], -exact)
            over = high, low + (rest[1] - small)
            return _quotient((*over, rest[2]), (rest[3], rest[4], rest[5]))
        arm, low = two_sum(rest[1:], -rays.origins)
        reach = power_above(arm)
        along = power_above(rays.directions)
        over = _dot(arm, low, reach, normal.copy())
        under = _dot(rays.directions, 0.0, along, normal)
        return _quotient((*over, _error(reach, rest[0])), (*under, _error(along, rest[0])))


def _dot(v: Vectors, rest: Vectors | float, unit: Floats, normal: Vectors) -> Pair:
    """Return (v + rest) . n for |v| < `unit`; `normal` (6, k), the halves of n, is overwritten."""
    high = normal[:3]
    low = normal[3:]
    coarse, fine = halves(v, unit)
    fine += rest
    x, y, z = coarse * high
    x += y
    x += z
    high += low
    high *= fine
    low = low * coarse
    low += high
    small = low[0] + low[1]
    small += low[2]
    return x, small


def _error(unit: Floats, size: Floats) -> Floats:
    """Return e of scalar products, given V and N + 3 M; inf where digits may be lost."""
    error = unit * size
    return np.where((error > _LEAST) & (error < _MOST), error * _DOT, np.inf)


def _cross(u: Pair, v: Pair) -> tuple[Pair, Floats]:
    """Return u x v as high + low, and M, the product of the powers of two above u and v."""
    units = power_above(u[0]), power_above(v[0])
    (uh, ul), (vh, vl) = (halves(w[0], unit) for w, unit in zip((u, v), units, strict=True))
    ul += u[1]
    vl += v[1]
    small = cross(uh, vl)
    small += cross(ul, v[0])
    return two_sum(cross(uh, vh), small), units[0] * units[1]


def _quotient(numerator: Sum, denominator: Sum) -> tuple[Floats, Bools]:
    """Return T / D, rounded, and whether it surely is the nearest float64."""
    high, low, high_error = numerator
    under, rest, under_error = denominator
    inverse = under + rest
    np.divide(1.0, inverse, out=inverse)
    first = high + low
    first *= inverse
    near = highest(first)
    top = highest(under)
    left = high - near * top
    left -= near * (under - top)
    left += low - near * rest
    left *= inverse
    size = np.abs(first, out=first)
    error = size * under_error
    error += high_error
    error *= np.abs(inverse, out=inverse)
    error *= _LOOSE
    least = left - error
    least += near
    left += error
    left += near
    return left, (least == left) & (size > _LEAST)


def two_sum(a: Floats, b: Floats) -> Pair:
    """Return a + b exactly, as the rounded sum and its rounding error."""
    total = a + b
    part = total - a
    rest = total - part
    np.subtract(a, rest, out=rest)
    np.subtract(b, part, out=part)
    rest += part
    return total, rest


def power_above(v: Floats) -> Floats:
    """Return the power of two above the largest |component| of vectors (3, n); 0 for zero."""
    size = largest(*np.abs(v))
    return (size.view(np.int64) & _EXPONENT).view(np.float64) * 2.0


def halves(v: Floats, unit: Floats) -> Pair:
    """Split v into a multiple of unit * 2^-BITS and the rest, for |v| <= unit, a power of two.

    Three products of two such multiples, and sums of them, are exact: they have at most 52 digits.
    """
    shift = unit * (1.5 * 2.0 ** (52 - BITS))
    high = v + shift
    high -= shift
    return high, v - high


def highest(a: Floats) -> Floats:
    """Return floats with their 26 highest digits; the rest has 27."""
    return (a.view(np.int64) & _TOP).view(np.float64)
