"""Checks that a certificate holds the certified picture of its scene: python verify.py FILE.

It needs numpy alone, knows nothing of the tracer, and can be run by itself. The file has the scene
and what each pixel sees (docs/certificate.md), and nothing that helps to check it: no hierarchy, no
list of candidates. What is not in the file cannot be wrong in it. What a pixel sees is found anew:

1. `Certificate`: corners and rays, rounded as docs/certificate.md says.
2. `candidates`: squares of pixels are halved, from the whole picture down to pixels. A surface is
   dropped from a square once float64, with a bound on its errors, shows that none of its rays meets
   it between clip start and the farthest t that the file has there. A square is the box around its
   very rays, so that this holds for every camera.
3. `Exact`, `sees`: the definition, in integers, of what is left. The result must be the file's.

Where the file says that a pixel clearly sees something at t, 2 leaves all that is met up to t, so
that 3 decides as if it had all surfaces. Where the file has ties, or nothing is seen, 2 leaves all
up to clip end. Floats drop and never decide.

Both have one rule: where a ray meets a surface between two values of t, the values of its edges, T
less the first t times D, and the second t times D less T, are 0 or have the sign of D.

Weighed and left: a hierarchy of boxes in the file, with the planes that cut them off. To check it
needs the same signs; and a format, and a check that each triangle is in its box.
"""

from __future__ import annotations

import argparse
import random
import re
import warnings
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache, lru_cache, reduce
from typing import Any, NamedTuple

import numpy as np

Floats = np.ndarray[Any, np.dtype[np.float64]]
Vector = tuple[int, int, int]
Name = tuple[int, int]  # instance and triangle

ARRAYS = {  # type and shape of each
    "world_from_camera": "f8 4 4",
    "window": "f8 2 2",
    "pixels": "i8 2 3",
    "clip": "f8 2",
    "vertices": r"f8 \d+ 3",
    "triangles": r"i8 \d+ 3",
    "instances": r"i8 \d+ 2",
    "world_from_object": r"f8 \d+ 4 4",
    "planes": r"f8 \d+ 2 3",
    "seen": r"i8 \d+ \d+ 2",
    "t": r"f8 \d+ \d+",
    "ties": r"i8 \d+ 3",
}
NOWHERE: Name = (-1, -1)
# How much is in memory together: pixels with their rays; pairs of a square and a surface.
PIXELS, PAIRS = 1 << 18, 1 << 13


class RefusedError(Exception):
    """The certificate is wrong, or has what this program does not know: the message says what."""


def only(what: str, found: Any, known: Any) -> None:
    """Refuse what is not known."""
    # numpy makes texts of a file that are none: `ascii` takes those, too
    if unknown := [ascii(str(each))[1:-1] for each in found if each not in known]:
        raise RefusedError(f"not covered: {what} {', '.join(unknown[:9])}")


def demand(true: Any, otherwise: str) -> None:
    """Refuse what is not so."""
    if not true:
        raise RefusedError(otherwise)


def shown(line: str) -> str:
    """Return a line that neither steers a terminal nor fills it, whatever a file says."""
    if len(line) > 2000:
        line = f"{line[:1000]} ... {line[-1000:]}"
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in line)


class Certificate:
    """A file's scene in world space, and its answers."""

    @np.errstate(all="ignore")  # what overflows is looked at, or is not
    def __init__(self, path: str) -> None:
        with warnings.catch_warnings(action="ignore"), np.load(path, allow_pickle=False) as file:
            length = file.zip.fp.seek(0, 2)
            size = sum(each.file_size for each in file.zip.infolist())
            demand(size <= max(2**28, 100 * length), "it unpacks to far more than itself")
            only("schema", [str(file["certificate"])], ["reference_tracer.certificate/2"])
            only("array", file.files, ["certificate", "camera", *ARRAYS])
            demand(len(file.files) == len(set(file.files)), "an array is in the file twice")
            self.kind = str(file["camera"])
            arrays = [file[name] for name in ARRAYS]
        only("camera", [self.kind], ["perspective", "orthographic", "equirectangular"])
        for found, (name, known) in zip(arrays, ARRAYS.items(), strict=True):
            is_of = " ".join(map(str, (found.dtype.str[1:], *found.shape)))
            demand(re.fullmatch(known, is_of), f"{name} is of {is_of}, not {known}")
        camera, window, pixels, clip, *surfaces, self.seen, self.t, ties = arrays
        demand(sum(map(len, (*surfaces, ties))) <= 2**20 + length, "more rows than its length has")
        self.right, self.up, self.back, self.eye = camera[:3].T[..., None]
        self.aside = self.right + 0.4 * self.up  # few edges are parallel to this
        self.clip = clip.tolist()
        demand(-np.inf < self.clip[0] < self.clip[1] < np.inf, "the clip range is empty or endless")
        for begin, end, count in pixels.tolist():
            demand(0 <= begin < end <= count, "the region is empty, or not within the picture")
        size = tuple(pixels[::-1, 1] - pixels[::-1, 0])  # before so many pixels are made
        only("answers", [self.t.shape, self.seen.shape[:2]], [size])
        is_far = self.kind == "equirectangular" and np.abs(window).max() > 2**20
        demand(not is_far, "an angle is beyond 2^20 radians")  # `sine` would be none
        self.x, self.y = (film(*side, *part) for side, part in zip(window, pixels, strict=True))
        self.set_surfaces(*surfaces)
        self.ties: dict[int, set[Any]] = {}
        for pixel, *name in ties.tolist():
            self.ties.setdefault(pixel, set()).add(tuple(name))
        only("tie of pixel", self.ties, range(self.t.size))

    def set_surfaces(self, vertices: Any, triangles: Any, *placed: Any) -> None:
        """Set names, and corners (3 corners, 3 components, n); of planes, the last, point, normal.

        How many are triangles is `triangles`.
        """
        instances, matrices, planes = placed
        only("vertex", np.unique(triangles).tolist(), range(len(vertices)))
        only("triangle", np.unique(instances).tolist(), range(len(triangles) + 1))
        demand((instances[:, 0] <= instances[:, 1]).all(), "an instance ends before it begins")
        demand(np.diff(instances).sum() <= 2**24, "not covered: more than 16,777,216 triangles")
        self.names, corners = [], []
        for number, (m, (begin, end)) in enumerate(zip(matrices, instances.tolist(), strict=True)):
            x, y, z = vertices[triangles[begin:end].T].transpose(2, 0, 1)
            world = [m[k, 0] * x + m[k, 1] * y + m[k, 2] * z + m[k, 3] for k in range(3)]
            found = np.stack(world, axis=1)
            finite = np.flatnonzero(np.isfinite(found).all(axis=(0, 1)))  # others do not count
            self.names += [(number, k) for k in finite.tolist()]
            corners.append(found[..., finite])
        self.triangles = len(self.names)
        self.names += [(len(matrices) + k, -1) for k in range(len(planes))]
        corners.append(planes[:, [0, 1, 1]].transpose(1, 2, 0))
        self.corners = np.concatenate(corners, axis=2)

    def rays(self, rows: Any) -> tuple[Floats, Floats]:
        """Return origins and directions of the pixels of some rows, (3, n) or (3, 1) each."""
        x, y = np.tile(self.x, len(rows)), np.repeat(self.y[rows], len(self.x))
        along = np.ones_like(x)
        if self.kind == "equirectangular":
            level = sine(y, 1)
            x, y, along = level * sine(x), sine(y), level * sine(x, 1)
        place = x * self.right + y * self.up
        if self.kind == "orthographic":
            return self.eye + place, -self.back
        return self.eye, place - along * self.back


def film(low: Any, high: Any, begin: Any, end: Any, count: Any) -> Floats:
    """Return the middles of some of the pixels from `low` to `high`."""
    return low + (np.arange(begin, end) + 0.5) * ((high - low) / count)


def sine(angle: Floats, quarters: int = 0) -> Floats:
    """Return the sine of angles plus so many right angles, in the roundings of stored rays."""
    turns = np.floor(angle * (2 / np.pi) + 0.5)
    for part in (1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21):
        angle = angle - turns * part
    square = angle * angle
    odd = even = np.ones_like(angle)
    for k in range(18, 0, -2):
        odd = 1 - square / ((k - 1) * k) * odd
        even = 1 - square / (k * (k + 1)) * even
    turns = (turns + quarters) % 4
    found = np.where(turns % 2 == 1, odd, angle * even)
    return np.where(turns < 2, found, -found)


def dot(a: Any, b: Any) -> Any:
    """Return a . b, of integers or floats."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Any, b: Any) -> Any:
    """Return a x b, of integers or floats."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def most(v: Any) -> Any:
    """Return the largest absolute value of a component."""
    return np.abs(v).max(axis=0)


def forms(of: Certificate, is_parallel: bool, largest: float) -> Floats:
    """Return eight functions of a ray r, for each of n surfaces: constant + slope . r +- error.

    r is the ray's direction; or, of parallel rays, its origin less the camera's. `largest` is the
    largest component of any r. With A, B, C the corners less the ray's origin, n the normal, and
    any q, the functions are

        T = A . n, D = d . n                                       t = T / D
        d . (A x (B - A)), d . (B x (C - B)), d . (C x (A - C))    the edges
        d . (A x q), d . (B x q), d . (C x q)                      beside the plane of ray and q

    each (point + times r) . (v x w), of terms whose absolute values add up to 6 times `size`, the
    product of the largest components, at most. With u = 2^-53, the value in the middle of a box is
    off by 60 u of `size`, the slopes, over the box, by 144 u, the range's ends by 192 u, what
    becomes of T and D by 48 u; `error` is 512 u. Each of some fifty products may lose 2^-1075 to
    underflow; `error` has 2^-1040. What overflows is infinite or NaN, and is not asked for its
    sign. The proof, of these very operations: proofs/checker/Room.v and Dropping.v.

    Returns
    -------
    (5, 8, n) : the constant, the slope's three components and the error of each function
    """
    ahead = -of.back if is_parallel else np.zeros((3, 1))
    plane = slice(of.triangles, None)
    sides = np.roll(of.corners, -1, axis=0) - of.corners
    normal = np.array(cross(sides[0], -sides[2]))
    size = most(sides[0]) * most(sides[2])
    normal[:, plane] = of.corners[1][:, plane]
    size[plane] = most(normal[:, plane])
    a = of.corners - of.eye
    terms = [(a[0], -is_parallel, normal, size), (ahead, 1 - is_parallel, normal, size)]
    for p, side in zip([*a, *a], [*sides, *[of.aside] * 3], strict=True):
        point, times, v, w = (p, -1, side, ahead) if is_parallel else (ahead, 1, p, side)
        terms.append((point, times, cross(v, w), most(v) * most(w)))
    found = np.empty((5, 8, len(size)))
    for k, (point, times, vector, size) in enumerate(terms):
        reach = most(point) + abs(times) * largest
        found[0, k] = dot(point, vector)
        found[1:4, k] = np.multiply(times, np.broadcast_arrays(*vector))
        found[4, k] = 2.0**-44 * (reach * size) + 2.0**-1040 * (1 + reach)
    found[4, 2:, plane] = np.inf  # a plane has no edges
    return found


def levels(r: Floats, far: Floats) -> list[Floats]:
    """Return squares of 2^k x 2^k pixels, from pixels to one square, of rays r (3, h, w).

    Of each level, (7, h, w): three components of the middles of the boxes around their rays; three
    halves, which no ray is farther from there; and the farthest t of `far` (h, w).
    """
    low = high = r
    out: list[Floats] = []
    while not out or out[-1][0].size > 1:
        middle = low + (high - low) / 2
        half = np.maximum(high - middle, middle - low) * (1 + 2.0**-50)
        out.append(np.concatenate((middle, half, far[None])))
        for axis in (-1, -2):
            pairs = np.arange(0, far.shape[axis], 2)
            low = np.minimum.reduceat(low, pairs, axis)
            high, far = (np.maximum.reduceat(v, pairs, axis) for v in (high, far))
    return out


def candidates(of: Floats, squares: Sequence[Floats], start: float, pairs: Any) -> Iterator[Any]:
    """Yield y, x and surface, (3, n), of which floats do not show that they do not meet.

    `pairs` (3, n) are of the last of `squares`, and what is left of them is looked at in the ones
    before. `of` are the surfaces' `forms`. Surely they do not meet where two of T - start D,
    t D - T and the edges have different signs; or all corners are on one side of the ray and q.
    """
    place = pairs[0] * squares[-1].shape[2] + pairs[1]
    *box, far = squares[-1].reshape(7, -1).take(place, axis=1)
    constant, *slope, error = of.take(pairs[2], axis=2)
    value = constant + dot(slope, box[:3])
    reach = error + dot(np.abs(slope), box[3:])
    value[:2] = value[0] - start * value[1], far * value[1] - value[0]
    reach[:2] = reach[0] + abs(start) * reach[1], np.abs(far) * reach[1] + reach[0]
    known = np.isfinite(value - reach)  # an infinite sum may be on its way to the other sign
    above, below = known & (value > reach), known & (value < -reach)
    gone = above[5:].all(axis=0) | below[5:].all(axis=0)
    gone |= above[:5].any(axis=0) & below[:5].any(axis=0)
    pairs = pairs[:, ~gone]
    if len(squares) == 1:
        yield pairs
        return
    quarters = [pairs * [[2], [2], [1]] + [[y], [x], [0]] for y in (0, 1) for x in (0, 1)]
    pairs = np.concatenate(quarters, axis=1)
    pairs = pairs[:, (pairs[:2].T < squares[-2][0].shape).all(axis=1)]
    for part in np.split(pairs, range(PAIRS, pairs.shape[1], PAIRS), axis=1):
        yield from candidates(of, squares[:-1], start, part)


class Hit(NamedTuple):
    """Where a ray meets a surface, in integers: t = top / bottom."""

    name: Name
    top: int
    bottom: int
    normal: Vector
    edges: Sequence[tuple[int, Vector, Vector]]  # e = d . m, m, and the edge; none of a plane
    d: Vector

    @property
    def at(self) -> Fraction:
        """The exact t."""
        return Fraction(self.top, self.bottom)

    def is_crossed(self, moves: Sequence[Vector]) -> bool:
        """Return whether the moved ray crosses the surface."""
        return all(self.bottom * moved(*edge, self.d, moves) > 0 for edge in self.edges)

    def line(self, other: Hit) -> tuple[Vector, Vector]:
        """Return where two surfaces intersect, as m and edge."""
        a, b = self.top, other.top
        x, y, z = (a * v - b * u for u, v in zip(self.normal, other.normal, strict=True))
        return (x, y, z), ((0, 0, 0) if a else cross(self.normal, other.normal))

    def is_before(self, other: Hit, moves: Sequence[Vector]) -> bool:
        """Return whether the moved ray meets this first; in one plane, the lower name is first."""
        apart = self.top * other.bottom - other.top * self.bottom
        order = moved(apart, *self.line(other), self.d, moves) * self.bottom * other.bottom
        return order < 0 or (order == 0 and self.name < other.name)


def moved(e: int, m: Vector, edge: Vector, d: Vector, moves: Sequence[Vector]) -> int:
    """Return what has the sign of e + x m . moves[0] + x^2 m . moves[1] ..., x infinitely small.

    Where a ray begins on an edge's line, m is 0, and its origin is moved, infinitely less.
    """
    terms = [e, *(dot(m, move) for move in moves)]
    if not any(m):
        terms += [dot(cross(edge, along), move) for move in moves for along in (d, *moves)]
    return next(filter(None, terms), 0)


def minus(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def integers(values: Floats, exponent: int) -> list[Vector]:
    """Return vectors (3, n), multiples of 2^exponent, as integers times that."""
    demand(np.isfinite(values).all(), "a ray or a plane is not finite")
    mantissa, power = np.frexp(values)
    digits = (mantissa * 2.0**53).astype(np.int64).tolist()
    by = np.maximum(power - 53 - exponent, 0).tolist()  # a zero's power says nothing
    return [(x << i, y << j, z << k) for x, y, z, i, j, k in zip(*digits, *by, strict=True)]


class Exact:
    """Rays and surfaces as integers, all times the same power of two."""

    def __init__(self, of: Certificate, origins: Floats, directions: Floats) -> None:
        """Take rays, (3, n) or (3, 1) each."""
        every = np.concatenate([v.ravel() for v in (of.corners, origins, directions)])
        self.unit = int(np.frexp(every[every != 0])[1].min(initial=0)) - 53
        self.origins, self.directions = (integers(v, self.unit) for v in (origins, directions))
        self.clip = [limit.as_integer_ratio() for limit in of.clip]
        self.of = of
        self.corners = cache(lambda number: integers(of.corners[..., number].T, self.unit))
        self.surface = lru_cache(1 << 14)(self.surface_from)

    def surface_from(self, origin: int, number: int) -> Any:
        """Return T, n, and m and edge of each edge, of a surface from an origin."""
        a, b, c = (minus(p, self.origins[origin]) for p in self.corners(number))
        if number >= self.of.triangles:
            return dot(a, self.corners(number)[1]), self.corners(number)[1], []
        edges = [(cross(p, q), minus(p, q)) for p, q in ((a, b), (b, c), (c, a))]
        normal = cross(edges[0][1], edges[1][1])
        return dot(a, normal), normal, edges

    def hit(self, pixel: int, number: int) -> Hit | None:
        """Return where a pixel's ray meets a surface within the clip range; None if nowhere."""
        top, normal, sides = self.surface(pixel % len(self.origins), number)
        d = self.directions[pixel % len(self.directions)]
        bottom = dot(d, normal)
        edges = [(dot(d, m), m, side) for m, side in sides]
        (start, below), (end, above) = self.clip
        signs = [e for e, _, _ in edges]
        signs += [top * below - start * bottom, end * bottom - top * above]
        if not bottom or min(signs) < 0 < max(signs) or top == start == 0:
            return None  # at 0 a ray begins, if clip start is 0
        return Hit(self.of.names[number], top, bottom, normal, edges, d)


def sees(hits: Sequence[Hit]) -> tuple[Hit | None, set[Name]]:
    """Return what a ray sees, and if it is ambiguous all that it may see: docs/certificate.md."""
    inside = [hit for hit in hits if all(e for e, _, _ in hit.edges)]
    front = [h for h in hits if len(hits) == 1 or all(h.at <= other.at for other in inside)]
    if len(front) <= min(1, len(inside)):
        return next(iter(front), None), set()
    seen = first(hits, ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
    least = min(hit.at for hit in front)
    may = [seen, *(hit for hit in front if hit.at == least)]
    may += [first(front, [way]) for way in ways(front)]
    return seen, {hit.name if hit else NOWHERE for hit in may}


def first(hits: Sequence[Hit], moves: Sequence[Vector]) -> Hit | None:
    """Return what the moved ray crosses first."""
    crossed = [hit for hit in hits if hit.is_crossed(moves)]
    return reduce(lambda a, b: b if b.is_before(a, moves) else a, crossed) if crossed else None


def ways(hits: Sequence[Hit]) -> Iterator[Vector]:
    """Yield ways to move a ray, to both sides of every line at which what it sees may change.

    Seen along the ray, these are edges and intersections of surfaces: lines through one point. Two
    of them, of integers up to B, are at least 1 / (2 B^2) apart, and none comes between.
    """
    d = hits[0].d
    z = max(range(3), key=lambda axis: abs(d[axis]))
    lines = [(m, edge) for hit in hits for e, m, edge in hit.edges if not e]
    lines += [h.line(g) for k, h in enumerate(hits) for g in hits[:k] if h.at == g.at]
    flat = [m if any(m) else cross(edge, d) for m, edge in lines]
    far = 4 * max((abs(v) for m in flat for v in m), default=0) ** 2
    for x, y in {(m[z - 2], m[z - 1]) for m in flat if m[z - 2] or m[z - 1]}:
        for along, across in ((far, 1), (far, -1), (-far, 1), (-far, -1)):
            move = {z: 0, (z - 2) % 3: across * x - along * y, (z - 1) % 3: across * y + along * x}
            yield move[0], move[1], move[2]


def left(of: Certificate, origins: Floats, directions: Floats, far: Floats) -> dict[int, list[int]]:
    """Return the surfaces that floats do not drop, of each pixel."""
    is_parallel = of.kind == "orthographic"  # one pixel has one direction, too
    whole = np.outer((0, 0, 1), np.arange(len(of.names)))  # all surfaces, in the one square
    r = origins - of.eye if is_parallel else directions
    squares = levels(r.reshape(3, *far.shape), far)
    found: dict[int, list[int]] = {}
    every = forms(of, is_parallel, np.abs(r).max())
    for pairs in candidates(every, squares, of.clip[0], whole):
        for y, x, surface in zip(*pairs.tolist(), strict=True):
            found.setdefault(y * far.shape[1] + x, []).append(surface)
    return found


@np.errstate(all="ignore")
def check(of: Certificate, rows: Sequence[int]) -> None:
    """Check rows of the picture; raise a RefusedError that names the first pixel that is wrong."""
    far = np.nextafter(np.minimum(of.t, of.clip[1]), np.inf)
    np.put(far, list(of.ties), of.clip[1])  # row by row, in whichever order the file has them
    told = np.arange(far.size).reshape(far.shape), of.seen[..., 0], of.seen[..., 1], of.t
    parts = min(len(rows), 1 + len(rows) * far.shape[1] // PIXELS)  # of a row at least
    for part in np.array_split(rows, parts):
        rays = of.rays(part)
        exact = Exact(of, *rays)
        near = left(of, *rays, far[part])
        here = zip(*(v[part].ravel().tolist() for v in told), strict=True)
        for k, (number, instance, triangle, t) in enumerate(here):
            seen, ties = sees([hit for s in near.get(k, ()) if (hit := exact.hit(k, s))])
            found = (seen.name, seen.top / seen.bottom, ties) if seen else (NOWHERE, np.inf, ties)
            said = (instance, triangle), t, of.ties.get(number, set())
            if found != said:
                at = number % far.shape[1], number // far.shape[1]
                raise RefusedError(f"pixel {at}: the file says {said}; it sees {found}")


def check_arithmetic() -> None:
    """Refuse to check where float64 is not rounded to nearest, or loses its least numbers."""
    steps, least = np.array([1, 1.5, -0.5, -0.75]) * 2.0**-53, np.full(4, 2.0**-1022)
    is_near = np.ones(4) + steps - 1 == np.array([0, 2, 0, -1]) * 2.0**-53
    demand(all(is_near & (least / 4 * 4 == least)), "floats here are not those of IEEE 754")


def verified(file: str, sample: int | None = None) -> str:
    """Check a certificate, or so many rows, drawn at random; return what was checked, in words.

    Raises
    ------
    RefusedError
        If a pixel is wrong, something is not covered, or the file cannot be read.
    """
    demand(sample is None or sample > 0, "a sample has at least one row")
    check_arithmetic()
    try:
        of = Certificate(file)
    except RefusedError:
        raise
    except Exception as error:  # zip, zlib, numpy: each has its own ways to say no
        say = f"'{file}' is damaged, or not of `reftrace trace --certificate`: {error!r}"
        raise RefusedError(say) from error
    height, width = of.t.shape
    rows = sorted(random.SystemRandom().sample(range(height), min(sample or height, height)))
    check(of, rows)
    what = "all" if len(rows) == height else f"a sample, {len(rows)} of {height} rows:"
    return f"{what} {len(rows) * width:,} pixels see what it says"


def main() -> None:
    """Run `python verify.py FILE [--sample ROWS]`; its exit code is 0 for yes, 2 for no."""
    parser = argparse.ArgumentParser(description="Check a certificate of `reftrace trace`.")
    parser.add_argument("file")
    parser.add_argument("--sample", type=int, metavar="ROWS", help="check so many, at random")
    try:
        print(shown(verified(**vars(parser.parse_args()))))
    except RefusedError as error:
        parser.exit(2, shown(f"refused: {error}") + "\n")


if __name__ == "__main__":
    main()
