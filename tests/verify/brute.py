"""What certificates should say, by brute force in fractions: written from docs/certificate.md.

Rays and corners are computed with Python's floats, and no code is shared with the checker or with
the tracer; the series of sines is that page's, which any program must follow. What an ambiguous ray
sees is found with whole polynomials in two infinitely small numbers: x moves the ray's direction,
and y, smaller than any power of x, its origin.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

Name = tuple[int, int]
Polynomial = dict[tuple[int, int], Fraction]  # factors of y^j x^i, by (j, i)
NOWHERE: Name = (-1, -1)


class Seen(NamedTuple):
    """What a pixel sees; an ambiguous one has ties."""

    name: Name
    t: float
    ties: set[Name]


class Met(NamedTuple):
    """A surface that a ray meets within the clip range."""

    name: Name
    t: Fraction
    inside: bool  # not at an edge
    points: list[list[Fraction]]  # three corners, or a plane's point
    normal: list[Fraction]


def minus(a, b) -> list:
    return [p - q for p, q in zip(a, b, strict=True)]


def cross(a, b) -> list:
    return [a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)]


def dot(a, b):
    return sum((p * q for p, q in zip(a, b, strict=True)), start=Fraction(0))


def is_finite(numbers) -> bool:
    return all(map(math.isfinite, numbers))


def sine(angle: float, quarters: int) -> float:
    """The sine of an angle and so many right angles, in the page's operations."""
    if not math.isfinite(angle * (2 / math.pi)):
        return math.nan
    turns = float(math.floor(angle * (2 / math.pi) + 0.5))
    for part in (1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21):
        angle = angle - turns * part
    odd = even = 1.0
    for k in range(18, 0, -2):
        odd = 1 - angle * angle / ((k - 1) * k) * odd
        even = 1 - angle * angle / (k * (k + 1)) * even
    turn = (turns + quarters) % 4
    found = odd if turn in (1, 3) else angle * even
    return found if turn < 2 else -found


def ray(arrays: dict[str, Any], column: int, row: int) -> tuple[list[float], list[float]]:
    """The origin and the direction of a pixel of the region."""
    right, up, back, position = arrays["world_from_camera"][:3].T.tolist()
    ends = zip(arrays["window"].tolist(), arrays["pixels"].tolist(), (column, row), strict=True)
    x, y = (low + (at + k + 0.5) * ((high - low) / n) for (low, high), (at, _, n), k in ends)
    kind, z = str(arrays["camera"]), 1.0
    if kind == "equirectangular":
        x, y, z = sine(y, 1) * sine(x, 0), sine(y, 0), sine(y, 1) * sine(x, 1)
    place = [x * a + y * b for a, b in zip(right, up, strict=True)]
    if kind == "orthographic":
        return [a + b for a, b in zip(position, place, strict=True)], [-a for a in back]
    return position, [a + z * -b for a, b in zip(place, back, strict=True)]


def surfaces(arrays: dict[str, Any]) -> list[tuple[Name, list[list[Fraction]], Any]]:
    """Name, points and normal (None of triangles) of each surface."""
    found = []
    matrices = arrays["world_from_object"].tolist()
    for number, (begin, end) in enumerate(arrays["instances"].tolist()):
        for k, triangle in enumerate(arrays["triangles"][begin:end].tolist()):
            places = arrays["vertices"][triangle].tolist()
            rows = matrices[number][:3]
            corners = [[m[0] * x + m[1] * y + m[2] * z + m[3] for m in rows] for x, y, z in places]
            if all(map(is_finite, corners)):
                found.append(((number, k), [list(map(Fraction, c)) for c in corners], None))
    for k, (point, normal) in enumerate(arrays["planes"].tolist()):
        plane = list(map(Fraction, point)), list(map(Fraction, normal))
        found.append(((len(matrices) + k, -1), [plane[0]], plane[1]))
    return found


def met_by(o, d, every, clip) -> list[Met]:
    """All surfaces that a ray meets within the clip range."""
    found = []
    for name, points, normal in every:
        n = normal or cross(minus(points[1], points[0]), minus(points[2], points[0]))
        if not (bottom := dot(d, n)):
            continue
        t = dot(minus(points[0], o), n) / bottom
        if not clip[0] <= t <= clip[1] or t == clip[0] == 0:
            continue
        weights = [Fraction(1)]
        if normal is None:
            place = [a + t * b for a, b in zip(o, d, strict=True)]
            a, b, c = (minus(p, place) for p in points)
            weights = [dot(cross(p, q), n) for p, q in ((a, b), (b, c), (c, a))]
        if min(weights) >= 0:
            found.append(Met(name, t, min(weights) > 0, points, n))
    return found


def plus(a: Polynomial, b: Polynomial, times: int = 1) -> Polynomial:
    out = defaultdict(Fraction, a)
    for power, factor in b.items():
        out[power] += times * factor
    return out


def product(a: Polynomial, b: Polynomial) -> Polynomial:
    out: Polynomial = defaultdict(Fraction)
    for (j, i), p in a.items():
        for (k, m), q in b.items():
            out[j + k, i + m] += p * q
    return out


def determinant(a, b, c) -> Polynomial:
    """a . (b x c), of vectors of polynomials."""
    out: Polynomial = {}
    for k in range(3):
        one, two = product(b[k - 2], c[k - 1]), product(b[k - 1], c[k - 2])
        out = plus(out, product(a[k], plus(one, two, -1)))
    return out


def sign(of: Polynomial) -> int:
    known = [of[power] for power in sorted(of) if of[power]]
    return (known[0] > 0) - (known[0] < 0) if known else 0


class MovedRay:
    """A ray whose direction is d + x w1 + x^2 w2 ..., and its origin o + y w1 + y^2 w2 ..."""

    def __init__(self, o, d, ways: Sequence[Sequence[Any]]) -> None:
        self.d = [{(0, 0): d[k]} | {(0, n + 1): w[k] for n, w in enumerate(ways)} for k in range(3)]
        self.o = [{(0, 0): o[k]} | {(n + 1, 0): w[k] for n, w in enumerate(ways)} for k in range(3)]

    def edges(self, met: Met) -> list[Polynomial]:
        a = [[plus({(0, 0): p[k]}, self.o[k], -1) for k in range(3)] for p in met.points]
        return [determinant(self.d, a[k], a[k - 2]) for k in range(3)] if len(a) == 3 else []

    def fraction(self, met: Met) -> tuple[Polynomial, Polynomial]:
        top: Polynomial = {}
        bottom: Polynomial = {}
        for k, n in enumerate(met.normal):
            top = plus(top, product(plus({(0, 0): met.points[0][k]}, self.o[k], -1), {(0, 0): n}))
            bottom = plus(bottom, product(self.d[k], {(0, 0): n}))
        return top, bottom

    def apart(self, a: Met, b: Met) -> Polynomial:
        """What has the sign of a's t less b's t, or of the opposite."""
        (p, q), (r, s) = self.fraction(a), self.fraction(b)
        return plus(product(p, s), product(r, q), -1)

    def is_first(self, a: Met, b: Met) -> bool:
        order = sign(self.apart(a, b)) * sign(self.fraction(a)[1]) * sign(self.fraction(b)[1])
        return order < 0 or (order == 0 and a.name < b.name)

    def sees(self, every: Sequence[Met]) -> Met | None:
        crossed = [m for m in every if len({sign(e) for e in self.edges(m)} | {0}) < 3]
        crossed = [m for m in crossed if all(map(sign, self.edges(m)))]
        first = [a for a in crossed if all(a is b or self.is_first(a, b) for b in crossed)]
        assert len(first) == min(1, len(crossed))
        return first[0] if first else None


def other_ways(o, d, front: Sequence[Met]) -> list[list[Fraction]]:
    """Ways to move a ray, one at least between each two at which it meets a line."""
    still = next(k for k in range(3) if d[k])
    p, q = (k for k in range(3) if k != still)
    axes = [[Fraction(k == at) for k in range(3)] for at in (p, q)]
    along = [MovedRay(o, d, [axis]) for axis in axes]

    def functions(moved: MovedRay) -> list[Polynomial]:
        found = [e for m in front for e in moved.edges(m)]
        return found + [moved.apart(a, b) for a in front for b in front if a is not b]

    lines = []
    for of_p, of_q in zip(*map(functions, along), strict=True):
        if not of_p.get((0, 0)):
            powers = [k for k in sorted({*of_p, *of_q}) if of_p.get(k) or of_q.get(k)]
            if powers:
                lines.append((of_p.get(powers[0], 0), of_q.get(powers[0], 0)))
    rays = {(s * b / n, -s * a / n) for a, b in lines for n in [abs(a) + abs(b)] for s in (1, -1)}
    between = {(a + c, b + e) for a, b in rays for c, e in rays}
    between |= {(-b, a) for a, b in rays}
    free = [w for w in between if all(a * w[0] + b * w[1] for a, b in lines)]
    return [[u * w[0] + v * w[1] for u, v in zip(*axes, strict=True)] for w in free]


def seen_by(o, d, every, clip) -> Seen:
    """What one ray sees."""
    met = met_by(o, d, every, clip)
    if not met:
        return Seen(NOWHERE, math.inf, set())
    least = min(m.t for m in met)
    first = [m for m in met if m.t == least]
    if len(first) == 1 and first[0].inside:
        return Seen(first[0].name, float(least), set())
    moved = MovedRay(o, d, [[Fraction(k == at) for k in range(3)] for at in range(3)])
    seen = moved.sees(met)
    up_to = min((m.t for m in met if m.inside), default=math.inf)
    front = [m for m in met if m.t <= up_to]
    may = [seen, *first, *(MovedRay(o, d, [w]).sees(front) for w in other_ways(o, d, front))]
    ties = {m.name if m else NOWHERE for m in may}
    return Seen(seen.name, float(seen.t), ties) if seen else Seen(NOWHERE, math.inf, ties)


def picture(arrays: dict[str, Any]) -> list[Seen] | None:
    """What each pixel sees, row by row; None if some ray or plane is not finite."""
    (x0, x1, _), (y0, y1, _) = arrays["pixels"].tolist()
    rays = [ray(arrays, column, row) for row in range(y1 - y0) for column in range(x1 - x0)]
    if not is_finite([v for o, d in rays for v in (*o, *d)] + arrays["planes"].ravel().tolist()):
        return None
    every = surfaces(arrays)
    clip = list(map(Fraction, arrays["clip"].tolist()))
    return [seen_by(list(map(Fraction, o)), list(map(Fraction, d)), every, clip) for o, d in rays]
