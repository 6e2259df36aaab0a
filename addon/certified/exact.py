"""Intersects rays and surfaces in Python's integers: nothing is rounded.

Every float is an integer times a power of two. With one power for all lengths of a batch, and
one for all directions, rays and corners become integers, and so does everything below. With the
corners a, b, c relative to the ray's origin o:

    m_ab = a x b,  m_bc = b x c,  m_ca = c x a     normals of the planes of o and each edge
    e_ab = d . m_ab, ...                           on which side of each edge the ray passes
    D = e_ab + e_bc + e_ca = d . n,  n = m_ab + m_bc + m_ca = (b - a) x (c - a)
    T = a . m_bc = a . n,            t = T / D

The ray meets the triangle where no two of the e have opposite signs. Where one of them is zero, the
ray is moved infinitesimally, to the direction d + (x, x^2, x^3) for an infinitesimal x: the sign of
e is then that of the first of e, m_x, m_y, m_z that is not zero. As that is *one* real ray for all
triangles, a surface without gaps is crossed exactly once. Two hits at the same t are ordered by the
same ray. If they tie even then, they lie in one plane, and the lower name is seen.

Where m itself is zero, the ray begins on the line of an edge, and no direction moves it away. A ray
does not meet what it begins on, unless an orthographic camera sees behind itself. Then o is moved
as well, infinitely less: m_ab becomes y (1, y, y^2) x (a - b), and its sign is that of
((a - b) x d)_x, and so on. Two hits at t = 0 are ordered in the same way.

References: Edelsbrunner and Mücke, "Simulation of simplicity", ACM TOG 9(1), 1990, for the moved
direction. Theorems: `Hits.crossed_rule_all`, `Hits.order_rule`, `Clip.seen_exact`,
`Clip.t_rounded`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Array, Floats
from ..tracer.camera import Rays
from .integers import ZERO, Integers, cross, dot, integers, scaled, sub

Triple = tuple[Integers, Integers, Integers]  # one vector for each of the edges ab, bc, ca
# How a ray is moved: infinitesimally along the first, infinitely less along the second, ...
Moves = Sequence[Integers]

PERTURBATION: Moves = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


class Hit(NamedTuple):
    """The hit of a ray's line on a triangle, its edges included, or on an infinite plane."""

    numerator: int  # T
    denominator: int  # D, not zero
    normal: Integers  # n
    edges: tuple[int, ...]  # e_ab, e_bc, e_ca; empty for a plane
    sides: tuple[Integers, ...]  # m_ab, m_bc, m_ca
    spans: tuple[Integers, ...]  # a - b, b - c, c - a
    direction: Integers  # of the ray

    @property
    def on_edge(self) -> bool:
        """Whether the ray, not moved, meets an edge or a corner."""
        return 0 in self.edges

    @property
    def weights(self) -> tuple[float, ...]:
        """The barycentrics, each correctly rounded; zeros for a plane."""
        ab, bc, ca = self.edges or (0, 0, 0)
        return bc / self.denominator, ca / self.denominator, ab / self.denominator

    def is_crossed(self, moves: Moves = PERTURBATION) -> bool:
        """Return whether the moved ray crosses the surface."""
        if not self.on_edge:
            return True
        parts = zip(self.edges, self.sides, self.spans, strict=True)
        signs = {_sign(*part, self.direction, moves) for part in parts}
        return signs in ({1}, {-1})


def sign_of_difference(first: Hit, second: Hit, moves: Moves = PERTURBATION) -> int:
    """Return the sign of t1 - t2 for the moved ray; 0 only for what lies in one plane."""
    apart = first.numerator * second.denominator - second.numerator * first.denominator
    sign = _sign(apart, *intersection(first, second), first.direction, moves)
    return sign if (first.denominator > 0) == (second.denominator > 0) else -sign


def intersection(first: Hit, second: Hit) -> tuple[Integers, Integers]:
    """Return T1 n2 - T2 n1 and, at t = 0, n1 x n2: where the two intersect, as m and span."""
    w = sub(scaled(second.normal, first.numerator), scaled(first.normal, second.numerator))
    return w, ZERO if first.numerator else cross(first.normal, second.normal)


class IntegerBatch:
    """Rays, triangles and planes as integers. Planes are numbered first, then triangles.

    Parameters
    ----------
    rays : Rays
        Finite; in float64, or fractions with powers of two as denominators.
    corners : (3, 3, m)
        Corner, component, triangle; finite, of the same kind.
    planes : sequence of ((3,), (3,))
        Point, of the same kind, and normal, float64, of each infinite plane.
    start, end : float
        The clip range. Hits with start <= t <= end are seen, but none with t = 0 if `start` is 0,
        as a ray does not meet what it begins on. `end` may be inf.
    """

    def __init__(
        self,
        rays: Rays,
        corners: Array,
        planes: Sequence[tuple[Array, Floats]] = (),
        start: float = 0.0,
        end: float = np.inf,
    ) -> None:
        count = corners.shape[2]
        points = np.array([p for p, _ in planes]).reshape(-1, 3).T
        at = rays.origins.shape[1]
        lengths, exponent = integers(np.hstack((rays.origins, *corners, points)))
        self.origins = lengths[:at]
        self.corners = [lengths[at + k * count : at + (k + 1) * count] for k in range(3)]
        self.directions, direction_exponent = integers(rays.directions)
        self.planes = [
            (point, integers(np.asarray(normal, np.float64)[:, None])[0][0])
            for point, (_, normal) in zip(lengths[at + 3 * count :], planes, strict=True)
        ]
        self.unit = exponent  # of lengths: an integer times 2^unit is metres
        self._shift = exponent - direction_exponent  # t = T / D 2^shift
        self._start = self._limit(start)
        self._end = self._limit(end)
        self._open = start == 0
        self._known: dict[int, tuple[int, Integers, Triple, Triple]] = {}

    def hit(self, ray: int, surface: int) -> Hit | None:
        """Return a ray's hit on a surface within the clip range, or None."""
        d = self.directions[ray if len(self.directions) > 1 else 0]
        o = self.origins[ray if len(self.origins) > 1 else 0]
        if surface < len(self.planes):
            numerator, n = self._plane(o, surface)
            return self._clipped(Hit(numerator, dot(d, n), n, (), (), (), d))
        numerator, n, sides, spans = self._triangle(o, surface)
        ab, bc, ca = sides
        edges = dot(d, ab), dot(d, bc), dot(d, ca)
        if min(edges) < 0 < max(edges):
            return None
        return self._clipped(Hit(numerator, sum(edges), n, edges, sides, spans, d))

    def of_first_ray(self, surface: int) -> tuple[int, int, Integers]:
        """Return T, D and n of a surface for the first ray, which may miss it."""
        o = self.origins[0]
        if surface < len(self.planes):
            numerator, n = self._plane(o, surface)
        else:
            numerator, n, _, _ = self._triangle(o, surface)
        return numerator, dot(self.directions[0], n), n

    def _triangle(self, o: Integers, surface: int) -> tuple[int, Integers, Triple, Triple]:
        """Return T, n, and m and span of each edge; computed once if all rays share o."""
        if known := self._known.get(surface):
            return known
        k = surface - len(self.planes)
        a, b, c = (sub(corners[k], o) for corners in self.corners)
        ab = cross(a, b)
        bc = cross(b, c)
        ca = cross(c, a)
        spans = sub(a, b), sub(b, c), sub(c, a)
        normal = ab[0] + bc[0] + ca[0], ab[1] + bc[1] + ca[1], ab[2] + bc[2] + ca[2]
        found = dot(a, bc), normal, (ab, bc, ca), spans
        if len(self.origins) == 1:
            self._known[surface] = found
        return found

    def _plane(self, o: Integers, surface: int) -> tuple[int, Integers]:
        """Return T and n."""
        point, n = self.planes[surface]
        return dot(sub(point, o), n), n

    def t(self, hit: Hit) -> float:
        """Return t, correctly rounded; inf if it overflows."""
        numerator = hit.numerator
        denominator = hit.denominator
        if self._shift >= 0:
            numerator <<= self._shift
        else:
            denominator <<= -self._shift
        try:
            return numerator / denominator
        except OverflowError:
            return np.inf if (numerator > 0) == (denominator > 0) else -np.inf

    def _limit(self, value: float) -> tuple[int, int] | None:
        """Return a clip limit as (n, s) so that t >= limit where T 2^s >= n D, for D > 0.

        None if there is no limit.
        """
        if np.isinf(value):
            return None
        mantissa, power = value.as_integer_ratio()
        shift = self._shift + power.bit_length() - 1
        return (mantissa, shift) if shift >= 0 else (mantissa << -shift, 0)

    def _clipped(self, hit: Hit) -> Hit | None:
        """Return the hit if its t exists and lies within the clip range, else None."""
        denominator = hit.denominator
        if not denominator:
            return None
        numerator = hit.numerator if denominator > 0 else -hit.numerator
        if not numerator and self._open:
            return None
        for limit, side in ((self._start, 1), (self._end, -1)):
            if limit is not None:
                end, shift = limit
                if side * ((numerator << shift) - end * abs(denominator)) < 0:
                    return None
        return hit


def gap(first: Hit, second: Hit) -> int:
    """Return a number with the sign of t1 - t2 for the ray that is not moved."""
    apart = first.numerator * second.denominator - second.numerator * first.denominator
    return apart if (first.denominator > 0) == (second.denominator > 0) else -apart


def _sign(value: int, m: Integers, span: Integers, d: Integers, moves: Moves) -> int:
    """Return the sign of value + x m . moves[0] + ..., for an infinitesimal x > 0.

    Where value and m are zero, it is that of (span x d) . moves[0] + ...: then o is moved.
    """
    for move in moves:
        if value:
            break
        value = dot(m, move)
    if not value and m == ZERO:
        for move in moves:
            for along in (d, *moves):
                value = value or dot(cross(span, along), move)
    return (value > 0) - (value < 0)


def turning(m: Integers, span: Integers, d: Integers) -> Integers:
    """Return a vector: its product with a move decides where the ray, not moved, does not."""
    return cross(span, d) if m == ZERO else m
