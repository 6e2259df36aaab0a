"""Moves a ray by less than anything can tell, in Python's integers.

Where a stored ray meets an edge or two surfaces at once, the tracer's rule speaks of a ray that is
moved infinitesimally, from d to d + (x, x^2, x^3). Here x is a power of two, 2^-k, with k above the
number of digits of all numbers that occur. So it is a real ray, and whatever was not zero keeps its
sign. Where a ray begins on a surface, something stays zero however the ray turns, so the origin is
moved alike, by a y that is as small beside all that.

For triangles, with e1 = p2 - p1, e2 = p3 - p1, q = o - p1, P = d x e2, Q = q x e1,

    o + t d = p1 + u e1 + v e2:   det = e1 . P,  u det = q . P,  v det = d . Q,  t det = e2 . Q

(Cramer's rule.)

References
----------
T. Möller and B. Trumbore, "Fast, minimum storage ray-triangle intersection", 1997: the same before
its division.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

from numpy.typing import NDArray
from reference_tracer.tracer.hits import NOWHERE
from reference_tracer.tracer.ties import Name

Vector = Sequence[Any] | NDArray[Any]  # three integers, or three arrays of them
THE_RULE: tuple[Vector, ...] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))  # d + (x, x^2, x^3)


class Surface(NamedTuple):
    """A triangle by its three corners, or an infinite plane by one point and its normal."""

    name: Name
    points: Sequence[Vector]
    own_normal: Vector | None = None  # of a plane

    @property
    def normal(self) -> Vector:
        """The plane's normal, of any length."""
        if self.own_normal is not None:
            return self.own_normal
        return cross(sub(self.points[1], self.points[0]), sub(self.points[2], self.points[0]))


def meet(o: Vector, d: Vector, p1: Vector, p2: Vector, p3: Vector) -> tuple[Any, Any, Any, Any]:
    """Return det, u det, v det, t det of a line and a triangle."""
    e1, e2, q = sub(p2, p1), sub(p3, p1), sub(o, p1)
    p, r = cross(d, e2), cross(q, e1)
    return dot(e1, p), dot(q, p), dot(d, r), dot(e2, r)


def crosses(o: Vector, d: Vector, surface: Surface) -> bool:
    """Return whether a moved line passes through the surface's inside."""
    if surface.own_normal is not None:
        return True
    det, u, v, _ = meet(o, d, *surface.points)
    return min(u, v, det - u - v) > 0 or max(u, v, det - u - v) < 0


def nearest_of_moved(
    o: Vector, d: Vector, surfaces: Sequence[Surface], by: Sequence[Vector]
) -> Name:
    """Return what a ray that is moved along `by` sees first; of equals, the lowest name."""
    o, d, surfaces = moved(o, d, surfaces, by)
    met = []
    for surface in surfaces:
        if crosses(o, d, surface):
            n = surface.normal
            met.append((Fraction(dot(sub(surface.points[0], o), n), dot(d, n)), surface.name))
    return min(met)[1] if met else NOWHERE


def moved(
    o: Vector, d: Vector, surfaces: Sequence[Surface], by: Sequence[Vector]
) -> tuple[Vector, Vector, list[Surface]]:
    """Return o, d and the surfaces with the ray moved, all lengths times one power of two.

    o is moved only if the ray begins on one of them: otherwise it would change nothing.
    """
    beside = [v for s in surfaces for v in (*s.points, s.own_normal) if v is not None]
    begins = any(dot(sub(s.points[0], o), s.normal) == 0 for s in surfaces)
    d = move(d, by, [o, d, *by, *beside])
    if not begins:
        return o, d, list(surfaces)
    k = _digits([o, d, *by, *beside])
    grown = [s._replace(points=[[x << k * len(by) for x in p] for p in s.points]) for s in surfaces]
    return move(o, by, [], k), d, grown


def move(v: Vector, by: Sequence[Vector], beside: Sequence[Vector], k: int = 0) -> Vector:
    """Return (v + x by[0] + x^2 by[1] + ...) / x^len(by), x = 2^-k small beside all of these."""
    k = k or _digits(beside)
    for step in by:
        v = [(a << k) + b for a, b in zip(v, step, strict=True)]
    return v


def _digits(vectors: Sequence[Vector]) -> int:
    digits = max(abs(x) for v in vectors for x in v).bit_length()
    return 8 * digits + 64  # a comparison of two t has products of six of them


def in_integers(
    o: Vector, d: Vector, surfaces: Sequence[Surface]
) -> tuple[list[int], list[int], list[Surface]]:
    """Return a ray and surfaces of floats or fractions in integers, one scale for all lengths.

    The direction and a plane's normal have scales of their own, which cancel.
    """
    o, *points = _common([o, *(p for s in surfaces for p in s.points)])
    rest = iter(points)
    whole = [
        Surface(s.name, [next(rest) for _ in s.points], s.own_normal and _common([s.own_normal])[0])
        for s in surfaces
    ]
    return o, _common([d])[0], whole


def _common(vectors: Sequence[Vector]) -> list[list[int]]:
    """Return vectors of floats or fractions as integers, all times one power of two."""
    exact = [[Fraction(x) for x in v] for v in vectors]
    scale = max((x.denominator for v in exact for x in v), default=1)
    return [[int(x * scale) for x in v] for v in exact]


def sub(a: Vector, b: Vector) -> list[Any]:
    """Return a - b."""
    return [x - y for x, y in zip(a, b, strict=True)]


def dot(a: Vector, b: Vector) -> Any:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> list[Any]:
    """Return a x b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
