"""Ray and triangle in Python's integers: no rounding anywhere.

Every float is an integer times a power of two. With one power for all lengths of a batch, and
one for all directions, rays and corners become integers, and so does everything below. With the
corners a, b, c relative to the ray's origin o:

    m_ab = a x b,  m_bc = b x c,  m_ca = c x a     normals of the planes of o and each edge
    e_ab = d . m_ab, ...                           on which side of each edge the ray passes
    D = e_ab + e_bc + e_ca = d . n,  n = m_ab + m_bc + m_ca = (b - a) x (c - a)
    T = a . m_bc = a . n,            t = T / D

The ray meets the triangle where the three e have one sign. Where one of them is zero, the ray is
taken to pass infinitesimally beside itself, along d + (x, x^2, x^3) for an infinitesimal x: the
sign of e is then that of the first of e, m_x, m_y, m_z that is not zero. As that is *one* real ray
for all triangles, a surface without gaps is met exactly once. Two hits at the same t are ordered by
the same ray; where even that ties, they lie in one plane, and the lower name is seen.

Where m itself is zero, the ray begins on the line of an edge, and no direction takes it off. A ray
does not meet what it begins on, unless an orthographic camera sees behind itself. Then o is moved
as well, infinitely less: m_ab becomes y (1, y, y^2) x (a - b), and its sign is that of
((a - b) x d)_x, and so on. Two hits at t = 0 are ordered alike.

Source: Edelsbrunner and Mücke, "Simulation of simplicity", 1990, for the direction of a ray.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..tracer.camera import Rays

Integers = tuple[int, int, int]
# Where a ray is moved to, infinitesimally: along the first, infinitely less along the second, ...
Moves = Sequence[Integers]

PERTURBATION: Moves = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
ZERO: Integers = (0, 0, 0)
_Triangle = tuple[int, Integers, tuple[Integers, ...], tuple[Integers, ...]]


class Hit(NamedTuple):
    """Where the line of a ray hits a triangle's closed area, or an infinite plane."""

    numerator: int  # T
    denominator: int  # D, not zero
    normal: Integers  # n
    edges: tuple[int, ...]  # e_ab, e_bc, e_ca; none of a plane
    sides: tuple[Integers, ...]  # m_ab, m_bc, m_ca
    spans: tuple[Integers, ...]  # a - b, b - c, c - a
    direction: Integers  # of the ray

    @property
    def on_edge(self) -> bool:
        """Whether the ray as it is meets an edge or a corner."""
        return 0 in self.edges

    @property
    def weights(self) -> tuple[float, ...]:
        """The barycentrics, each correctly rounded; zeros of a plane."""
        ab, bc, ca = self.edges or (0, 0, 0)
        return bc / self.denominator, ca / self.denominator, ab / self.denominator

    def is_hit(self, moves: Moves = PERTURBATION) -> bool:
        """Return whether the ray that is infinitesimally moved meets it."""
        if not self.on_edge:
            return True
        parts = zip(self.edges, self.sides, self.spans, strict=True)
        signs = {_sign(*part, self.direction, moves) for part in parts}
        return signs in ({1}, {-1})


def sign_of_difference(first: Hit, second: Hit, moves: Moves = PERTURBATION) -> int:
    """Return the sign of t1 - t2 for the moved ray; 0 only for what lies in one plane."""
    apart = first.numerator * second.denominator - second.numerator * first.denominator
    sign = _sign(apart, *crossing(first, second), first.direction, moves)
    return sign if (first.denominator > 0) == (second.denominator > 0) else -sign


def crossing(first: Hit, second: Hit) -> tuple[Integers, Integers]:
    """Return T1 n2 - T2 n1 and, at t = 0, n1 x n2: how the order depends on the moved ray."""
    w = tuple(
        first.numerator * n2 - second.numerator * n1
        for n1, n2 in zip(first.normal, second.normal, strict=True)
    )
    return w, ZERO if first.numerator else _cross(first.normal, second.normal)


class IntegerBatch:
    """Rays, triangles and planes as integers. Surfaces are the planes, then the triangles.

    Parameters
    ----------
    rays
        Finite, float64.
    corners : (3, 3, m) float64
        Corner, component, triangle; finite.
    planes : sequence of ((3,), (3,)) float64
        Point and normal of each infinite plane.
    start, end
        Hits with start <= t <= end are seen, but for t = 0 where `start` is 0 (a ray does not meet
        what it begins on); `end` may be inf.
    """

    def __init__(
        self,
        rays: Rays,
        corners: NDArray[np.float64],
        planes: Sequence[tuple[NDArray, NDArray]] = (),
        start: float = 0.0,
        end: float = np.inf,
    ) -> None:
        count = corners.shape[2]
        points = np.array([p for p, _ in planes]).reshape(-1, 3).T
        at = rays.origins.shape[1]
        lengths, exponent = integers(np.hstack((rays.origins, *corners, points)))
        self._origins = lengths[:at]
        self._corners = [lengths[at + k * count : at + (k + 1) * count] for k in range(3)]
        self._directions, direction_exponent = integers(rays.directions)
        self._planes = [
            (point, integers(np.asarray(normal, np.float64)[:, None])[0][0])
            for point, (_, normal) in zip(lengths[at + 3 * count :], planes, strict=True)
        ]
        self.unit = exponent  # of lengths: an integer times 2^unit is metres
        self._shift = exponent - direction_exponent  # t = T / D 2^shift
        self._start, self._end = (self._limit(value) for value in (start, end))
        self._open = start == 0
        self._known: dict[int, _Triangle] = {}

    def hit(self, ray: int, surface: int) -> Hit | None:
        """Return a ray's hit on a surface within the clip range; None where there is none."""
        d = self._directions[ray if len(self._directions) > 1 else 0]
        o = self._origins[ray if len(self._origins) > 1 else 0]
        if surface < len(self._planes):
            numerator, n = self._plane(o, surface)
            return self._seen(Hit(numerator, _dot(d, n), n, (), (), (), d))
        numerator, n, sides, spans = self._triangle(o, surface)
        edges = tuple(_dot(d, m) for m in sides)
        if min(edges) < 0 < max(edges):
            return None
        return self._seen(Hit(numerator, sum(edges), n, edges, sides, spans, d))

    def of_first_ray(self, surface: int) -> tuple[int, int, Integers]:
        """Return T, D and n of a surface, whether or not the first ray meets it."""
        find = self._plane if surface < len(self._planes) else self._triangle
        numerator, n, *_ = find(self._origins[0], surface)
        return numerator, _dot(self._directions[0], n), n

    def _triangle(self, o: Integers, surface: int) -> _Triangle:
        """Return T, n, and of each edge m and span; found once where all rays share o."""
        if known := self._known.get(surface):
            return known
        k = surface - len(self._planes)
        ox, oy, oz = o
        a, b, c = ((x - ox, y - oy, z - oz) for x, y, z in (v[k] for v in self._corners))
        sides = _cross(a, b), _cross(b, c), _cross(c, a)
        spans = _sub(a, b), _sub(b, c), _sub(c, a)
        found = _dot(a, sides[1]), tuple(map(sum, zip(*sides, strict=True))), sides, spans
        if len(self._origins) == 1:
            self._known[surface] = found
        return found

    def _plane(self, o: Integers, surface: int) -> tuple[int, Integers]:
        """Return T and n."""
        point, n = self._planes[surface]
        return sum((p - x) * k for p, x, k in zip(point, o, n, strict=True)), n

    def t(self, hit: Hit) -> float:
        """Return t, correctly rounded; inf where no float is as large."""
        numerator, denominator = hit.numerator, hit.denominator
        if self._shift >= 0:
            numerator <<= self._shift
        else:
            denominator <<= -self._shift
        try:
            return numerator / denominator
        except OverflowError:
            return np.inf if (numerator > 0) == (denominator > 0) else -np.inf

    def _limit(self, value: float) -> tuple[int, int] | None:
        """Return a clip limit as (n, s) so that t >= limit where T 2^s >= n D, for D > 0."""
        if np.isinf(value):
            return None
        [[mantissa]], exponent = integers(np.array([[value]]))
        shift = self._shift - exponent
        return (mantissa, shift) if shift >= 0 else (mantissa << -shift, 0)

    def _seen(self, hit: Hit) -> Hit | None:
        """Return the hit if its t exists and lies within the clip range."""
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
    """Return a number with the sign of t1 - t2, of the ray as it is."""
    gap = first.numerator * second.denominator - second.numerator * first.denominator
    return gap if (first.denominator > 0) == (second.denominator > 0) else -gap


def _sign(value: int, m: Integers, span: Integers, d: Integers, moves: Moves) -> int:
    """Return the sign of value + x m . moves[0] + ..., for an infinitesimal x > 0.

    Where value and m are zero it is that of (span x d) . moves[0] + ..., as above.
    """
    for move in moves:
        if value:
            break
        value = _dot(m, move)
    if not value and m == ZERO:
        for move in moves:
            for along in (d, *moves):
                value = value or _dot(_cross(span, along), move)
    return (value > 0) - (value < 0)


def turning(m: Integers, span: Integers, d: Integers) -> Integers:
    """Return what a move is multiplied by where the ray as it is decides nothing."""
    return _cross(span, d) if m == ZERO else m


def integers(vectors: NDArray[np.float64]) -> tuple[list[tuple[int, ...]], int]:
    """Return vectors (k, n) as n tuples of k integers, and an exponent e: float = integer * 2^e."""
    if vectors.dtype == object:  # fractions whose denominators are powers of two
        unit = max((v.denominator for v in vectors.flat), default=1)
        return [tuple(int(v * unit) for v in row) for row in vectors.T], 1 - unit.bit_length()
    mantissa, exponent = np.frexp(vectors)
    zero = mantissa == 0
    least = int(exponent[~zero].min()) if not zero.all() else 0
    exponent[zero] = least
    digits = (mantissa * 2.0**53).astype(np.int64)  # exact: a mantissa has 53 digits
    columns = zip(digits.T.tolist(), (exponent - least).T.tolist(), strict=True)
    return [tuple(m << e for m, e in zip(row, by, strict=True)) for row, by in columns], least - 53


def _sub(a: Integers, b: Integers) -> Integers:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _dot(a: Integers, b: Integers) -> int:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Integers, b: Integers) -> Integers:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
