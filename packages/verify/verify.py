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

Weighed and left: a hierarchy of boxes in the file, with the planes that cut them off. To check it
needs the same signs; and a format, and a check that each triangle is in its box.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import time
from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

Floats = np.ndarray[Any, np.dtype[np.float64]]
Vector = tuple[int, int, int]
Name = tuple[int, int]  # instance and triangle

SCHEMAS = ["reference_tracer.certificate/1", "reference_tracer.scene/2"]
SCENE = "schema camera objects background meshes instances planes unmodelled notes"
CAMERA = "world_from_camera window width height projection clip_start clip_end region name"
ANSWERS = "instance triangle t tie_pixel tie_instance tie_triangle"
ARRAYS = {
    "mesh": ("meshes", "vertices triangles slots corner_colors"),
    "instance": ("instances", "world_from_object colors"),
    "plane": ("planes", "point normal color"),
}
KINDS = "perspective", "orthographic", "equirectangular"
WINDOW, REGION = "left right bottom top", "x0 y0 x1 y1"
LISTS = {"meshes": "name corner_colors", "instances": "mesh object", "planes": "object"}
WHOLE, REAL, DOUBLE = "i1 i2 i4 i8 u1 u2 u4 u8", "f4 f8", "f8"  # numpy's types of numbers
NOWHERE: Name = (-1, -1)
AXES: Sequence[Vector] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
# How much is in memory together: pixels with their rays; surfaces; pairs of a square and a surface.
PIXELS, SURFACES, PAIRS = 1 << 18, 1 << 16, 1 << 15


class RefusedError(Exception):
    """The certificate is wrong, or has what this program does not know: the message says what."""


def only(what: str, found: Any, known: Any) -> None:
    """Refuse what is not known."""
    if unknown := [str(each) for each in found if each not in known]:
        raise RefusedError(f"not covered: {what} {', '.join(unknown)}")


def array(file: Any, name: str, types: str, *shape: int | None) -> Any:
    """Return an array; refuse one of other types or of another shape, where None is any length.

    With the types go the roundings: in float32 "up to clip end" could be less.
    """
    found = file[name]
    only(f"type of {name}", [found.dtype.str[1:]], types.split())
    if len(shape) != found.ndim or any(
        n not in (None, m) for n, m in zip(shape, found.shape, strict=True)
    ):
        raise RefusedError(f"{name} has the shape {found.shape}")
    return found


class Certificate:
    """A file's scene in world space, and its answers."""

    def __init__(self, path: str) -> None:
        with np.load(path, allow_pickle=False) as file:
            scene = json.loads(str(file["scene"]))
            self.camera = camera = scene["camera"]
            known = ["scene", "certificate", *ANSWERS.split()]
            for kind, (kinds, parts) in ARRAYS.items():
                known += [f"{kind}{k}_{p}" for k in range(len(scene[kinds])) for p in parts.split()]
            only("schema", [str(file["certificate"]), scene["schema"]], SCHEMAS)
            only("array", file.files, set(known))
            only("part of the scene", scene, SCENE.split())
            only("part of the camera", camera, CAMERA.split())
            only("camera", [camera["projection"]], KINDS)
            only("part of the window", camera["window"], WINDOW.split())
            only("part of the region", camera["region"], REGION.split())
            self.read_surfaces(file, scene)
            instance, triangle, t, *ties = ANSWERS.split()
            self.instance, self.triangle = (
                array(file, name, WHOLE, None, None) for name in (instance, triangle)
            )
            self.t = array(file, t, DOUBLE, None, None)
            told = [array(file, name, WHOLE, None).tolist() for name in ties]
        self.clip = float(camera["clip_start"]), float(camera["clip_end"])
        matrix = np.array(camera["world_from_camera"], np.float64)
        self.right, self.up, self.back, self.eye = matrix[:3].T[..., None]
        left, right, low, top = (float(camera["window"][k]) for k in WINDOW.split())
        x0, y0, x1, y1 = (int(camera["region"][k]) for k in REGION.split())
        if not (0 <= x0 < x1 <= camera["width"] and 0 <= y0 < y1 <= camera["height"]):
            raise RefusedError("the region is empty, or not within the picture")
        self.shape = y1 - y0, x1 - x0
        self.x = left + (np.arange(x0, x1) + 0.5) * ((right - left) / camera["width"])
        self.y = low + (np.arange(y0, y1) + 0.5) * ((top - low) / camera["height"])
        self.ties: dict[int, set[Name]] = {}
        for pixel, instance, triangle in zip(*told, strict=True):
            self.ties.setdefault(pixel, set()).add((instance, triangle))
        only("tie of pixel", self.ties, range(self.t.size))
        if {self.instance.shape, self.triangle.shape, self.t.shape} != {self.shape}:
            raise RefusedError(f"the answers are not those of {self.shape[1]} x {self.shape[0]}")
        if not (self.clip[0] < self.clip[1] and np.isfinite(self.corners).all()):
            raise RefusedError("the clip range is empty, or a plane is not finite")

    def read_surfaces(self, file: Any, scene: Any) -> None:
        """Set names, corners (3 corners, 3 components, n), and the normals of the last, planes."""
        meshes = []
        for part, known in LISTS.items():
            for each in scene[part]:
                only(f"part of {part}", each, known.split())
        for number in range(len(scene["meshes"])):
            vertices = array(file, f"mesh{number}_vertices", REAL, None, 3)
            triangles = array(file, f"mesh{number}_triangles", WHOLE, None, 3)
            only("vertex", np.unique(triangles).tolist(), range(len(vertices)))
            meshes.append((vertices.T.astype(np.float64), triangles))
        names, corners, count = [], [np.empty((3, 0, 3))], len(scene["instances"])
        for number, instance in enumerate(scene["instances"]):
            only("mesh", [instance["mesh"]], range(len(meshes)))
            (x, y, z), triangles = meshes[instance["mesh"]]
            m = array(file, f"instance{number}_world_from_object", REAL, 4, 4)
            with np.errstate(all="ignore"):
                world = [m[k, 0] * x + m[k, 1] * y + m[k, 2] * z + m[k, 3] for k in range(3)]
            corners.append(np.stack(world)[:, triangles])
            names += [(number, k) for k in range(len(triangles))]
        every = np.concatenate(corners, axis=1).transpose(2, 0, 1)
        finite = np.flatnonzero(np.isfinite(every).all(axis=(0, 1)))  # others do not count
        planes = range(len(scene["planes"]))
        points, self.normals = (
            np.array([array(file, f"plane{k}_{part}", REAL, 3) for k in planes], np.float64)
            .reshape(-1, 3)
            .T
            for part in ("point", "normal")
        )
        self.names = [names[k] for k in finite] + [(count + k, -1) for k in planes]
        self.corners = np.concatenate((every[..., finite], np.stack([points] * 3)), axis=2)
        self.triangles = len(finite)

    def rays(self, rows: Any) -> tuple[Floats, Floats]:
        """Return origins and directions of the pixels of some rows, (3, n) or (3, 1) each."""
        x, y = np.tile(self.x, len(rows)), np.repeat(self.y[rows], len(self.x))
        kind, right, up, ahead, eye = (
            self.camera["projection"],
            self.right,
            self.up,
            -self.back,
            self.eye,
        )
        if kind == "orthographic":
            rays = eye + (x * right + y * up), ahead
        elif kind == "perspective":
            rays = eye, x * right + y * up + ahead
        else:
            level = sine(y, 1)
            rays = eye, level * sine(x) * right + sine(y) * up + level * sine(x, 1) * ahead
        if not all(np.isfinite(v).all() for v in rays):
            raise RefusedError("a ray is not finite")
        return rays


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


class Forms:
    """Eleven functions of a ray for each of n surfaces: `constant` + `slope` . r, but for `error`.

    r is the ray's direction; or, where all rays share that, its origin less the camera's. With A,
    B, C the corners less the ray's origin, and q = right, up of the camera, the functions are

        d . (q x A), d . (q x B), d . (q x C)    one sign: beside the plane through the ray and q
        d . (A x (B - A)), ...                   two signs: the ray passes the triangle
        T = A . n, D = d . n                     t = T / D, n the normal

    each (point + r) . (v x w), of terms whose absolute values add up to 6 times `size`, the product
    of the largest components, at most. With u = 2^-53, A and sides are off by u, a component of a
    cross product by 5 u of its terms, a constant by 9 u, and r by u. The value in the middle of a
    square's box is off by 5 u more; its range over the box, at most twice as large, by 8 u; the
    range's ends by 3 u; what becomes of T and D by 11 u. These are 37 u of the terms, 222
    u of `size`; `error` is 512 u. Each of some fifty products may lose 2^-1075 to underflow, times
    1 + |r| + |A|; `error` has 2^-1040 of that. Overflow makes it infinite or NaN, and comparisons
    false, so that nothing is dropped.
    """

    def __init__(self, of: Certificate, part: slice, ahead: Floats | None, largest: float) -> None:
        """Take a part of the surfaces, the direction if all rays share it, and the largest |r|."""
        v = of.corners[..., part]
        a, none = v - of.eye, np.zeros((3, 1))
        sides = [v[(k + 1) % 3] - v[k] for k in range(3)]
        self.largest, count = largest, v.shape[2]
        self.constant, self.error = np.empty((2, 11, count))
        self.slope = np.empty((11, 3, count))
        pairs = [(q, p) for q in (of.right, of.up) for p in a] + list(zip(a, sides, strict=True))
        for k, (p, q) in enumerate(pairs):
            if ahead is None:
                self.put(k, none, 1, cross(p, q), most(p) * most(q))
            else:  # the same product in another order: (A - r) . (d x q), (A - r) . (side x d)
                p, q, point = (ahead, p, q) if k < 6 else (q, ahead, p)
                self.put(k, point, -1, cross(p, q), most(p) * most(q))
        normal, size = np.array(cross(sides[0], -sides[2])), most(sides[0]) * most(sides[2])
        planes = np.arange(part.start, part.start + count) - of.triangles
        own = planes >= 0
        normal[:, own] = of.normals[:, planes[own]]
        size[own] = most(normal[:, own])
        self.error[:9, own] = np.inf  # a plane has no edges
        self.put(9, a[0], 0 if ahead is None else -1, normal, size)
        self.put(10, none if ahead is None else ahead, int(ahead is None), normal, size)

    def put(self, k: int, point: Any, times: int, vector: Any, size: Any) -> None:
        """Make the k-th function (point + times r) . vector."""
        self.constant[k] = dot(point, vector)
        self.slope[k] = [times * each for each in vector]
        reach = most(point) + abs(times) * self.largest
        self.error[k] = 2.0**-44 * (reach * size) + 2.0**-1040 * (1 + reach)


def most(v: Any) -> Any:
    """Return the largest absolute value of a component."""
    return np.abs(v).max(axis=0)


def levels(r: Floats, far: Floats) -> list[Any]:
    """Return squares of 2^k x 2^k pixels, from pixels to one square, of rays r (3, h, w).

    Of each level: its shape; middles (3, squares) of the boxes around their rays; halves, which no
    ray is farther from there; and the farthest t, (squares,), of `far` (h, w).
    """
    low = high = r
    out: list[Any] = []
    while not out or len(out[-1][3]) > 1:
        middle = low + (high - low) / 2
        half = np.maximum(high - middle, middle - low) * (1 + 2.0**-50)
        out.append((far.shape, middle.reshape(3, -1), half.reshape(3, -1), far.ravel()))
        for axis in (-1, -2):
            pairs = np.arange(0, far.shape[axis], 2)
            low = np.minimum.reduceat(low, pairs, axis)
            high, far = (np.maximum.reduceat(v, pairs, axis) for v in (high, far))
    return out


def candidates(forms: Forms, squares: Sequence[Any], start: float) -> Iterator[Any]:
    """Yield pixels and surfaces, (n,) each, of which floats do not show that they do not meet."""
    count = forms.error.shape[1]
    work = [(len(squares) - 1, np.zeros(count, np.intp), np.arange(count))]
    while work:
        k, square, surface = work.pop()
        shape, middle, half, far = squares[k]
        for rows in (slice(0, 3), slice(3, 6), slice(6, 9), slice(9, 11)):
            slope = forms.slope[rows].take(surface, axis=2).swapaxes(0, 1)
            value = forms.constant[rows].take(surface, axis=1) + dot(slope, middle.take(square, 1))
            reach = forms.error[rows].take(surface, axis=1)
            if k:
                reach += dot(np.abs(slope), half.take(square, 1))
            if rows.start == 9:  # T - t D: linear in t, so of one sign from t to t if at both
                t = np.stack(np.broadcast_arrays(start, far.take(square)))
                value, reach = value[0] - t * value[1], reach[0] + np.abs(t) * reach[1]
            above, below = value - reach > 0, value + reach < 0
            gone = above.all(axis=0) | below.all(axis=0)
            if rows.start == 6:
                gone = above.any(axis=0) & below.any(axis=0)
            square, surface = square[~gone], surface[~gone]
        if not k:
            yield square, surface
            continue
        (height, width), (y, x) = squares[k - 1][0], np.divmod(square, shape[1])
        y, x = 2 * y + [[0], [0], [1], [1]], 2 * x + [[0], [1], [0], [1]]
        inside = (y < height) & (x < width)
        square, surface = (y * width + x)[inside], np.tile(surface, (4, 1))[inside]
        for part in np.split(np.arange(len(square)), range(PAIRS, len(square), PAIRS)):
            work.append((k - 1, square[part], surface[part]))


class Hit(NamedTuple):
    """Where a ray meets a surface, in integers: t = top / bottom, the bottom above 0."""

    name: Name
    top: int
    bottom: int
    normal: Vector
    values: Sequence[int]  # of the edges: e = d . m; none of a plane
    edges: Sequence[tuple[Vector, Vector]]  # m, and the edge
    turn: int  # -1 where the edges are the other way round
    d: Vector

    @property
    def at(self) -> Fraction:
        """The exact t, but for a power of two."""
        return Fraction(self.top, self.bottom)

    def is_crossed(self, moves: Sequence[Vector]) -> bool:
        """Return whether the moved ray crosses the surface."""
        edges = zip(self.values, self.edges, strict=True)
        return all(self.turn * moved(e, *edge, self.d, moves) > 0 for e, edge in edges)

    def line(self, other: Hit) -> tuple[Vector, Vector]:
        """Return where two surfaces intersect, as m and edge."""
        a, b = self.top, other.top
        x, y, z = (a * v - b * u for u, v in zip(self.normal, other.normal, strict=True))
        return (x, y, z), ((0, 0, 0) if a else cross(self.normal, other.normal))

    def is_before(self, other: Hit, moves: Sequence[Vector]) -> bool:
        """Return whether the moved ray meets this first; in one plane, the lower name is first."""
        apart = self.top * other.bottom - other.top * self.bottom
        order = moved(apart, *self.line(other), self.d, moves)
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


def unit(*values: Floats) -> int:
    """Return the exponent of a power of two of which all values are multiples."""
    return min((int(np.frexp(v[v != 0])[1].min()) for v in values if v.any()), default=0) - 53


def integers(values: Floats, exponent: int) -> list[Vector]:
    """Return vectors (3, n) as integers times 2^exponent, see `unit`."""
    mantissa, power = np.frexp(values)
    digits = (mantissa * 2.0**53).astype(np.int64).tolist()
    by = np.maximum(power - 53 - exponent, 0).tolist()  # a zero's power says nothing
    return [(x << i, y << j, z << k) for x, y, z, i, j, k in zip(*digits, *by, strict=True)]


class Exact:
    """Rays and surfaces as integers."""

    def __init__(self, of: Certificate, origins: Floats, directions: Floats, some: Any) -> None:
        """Take rays, (3, n) or (3, 1) each, and the numbers of the surfaces that they may meet."""
        length, speed = unit(of.corners, origins), unit(directions)
        self.origins, self.directions = integers(origins, length), integers(directions, speed)
        corners = zip(*(integers(each, length) for each in of.corners[..., some]), strict=True)
        self.corners = dict(zip(some.tolist(), corners, strict=True))
        self.of, self.scale = of, Fraction(2) ** (length - speed)  # t = top / bottom * scale
        self.clip = [
            (Fraction(limit) / self.scale).as_integer_ratio()
            if abs(limit) < np.inf
            else (1 if limit > 0 else -1, 0)
            for limit in of.clip
        ]
        self.known: dict[int, Any] = {}

    def surface(self, pixel: int, number: int) -> Any:
        """Return T, n, and m and edge of each edge; computed once if all rays share an origin."""
        if found := self.known.get(number):
            return found
        o = self.origins[pixel if len(self.origins) > 1 else 0]
        a, b, c = (minus(p, o) for p in self.corners[number])
        edges = [(cross(p, q), minus(p, q)) for p, q in ((a, b), (b, c), (c, a))]
        normal = tuple(map(sum, zip(*(m for m, _ in edges), strict=True)))
        if number >= self.of.triangles:
            vector = self.of.normals[:, number - self.of.triangles, None]
            edges, [normal] = [], integers(vector, unit(vector))
        found = dot(a, normal), normal, edges
        if len(self.origins) == 1:
            self.known[number] = found
        return found

    def hit(self, pixel: int, number: int) -> Hit | None:
        """Return where a pixel's ray meets a surface within the clip range; None if nowhere."""
        top, normal, edges = self.surface(pixel, number)
        d = self.directions[pixel if len(self.directions) > 1 else 0]
        values = [dot(d, m) for m, _ in edges]
        bottom = sum(values) if values else dot(d, normal)
        if not bottom or (values and min(values) < 0 < max(values)):
            return None
        turn = 1 if bottom > 0 else -1
        if turn < 0:
            top, bottom, normal = -top, -bottom, minus((0, 0, 0), normal)
        (start, below), (end, above) = self.clip
        if top * below < start * bottom or top * above > end * bottom or top == start == 0:
            return None  # at 0 a ray begins, if clip start is 0
        return Hit(self.of.names[number], top, bottom, normal, values, edges, turn, d)

    def t(self, hit: Hit) -> float:
        """Return t, rounded once: Python divides integers so."""
        up, down = self.scale.as_integer_ratio()
        try:
            return (hit.top * up) / (hit.bottom * down)
        except OverflowError:
            return np.inf if hit.top > 0 else -np.inf


def sees(hits: Sequence[Hit]) -> tuple[Hit | None, set[Name]]:
    """Return what a ray sees, and if it is ambiguous all that it may see: docs/certificate.md."""
    if len(hits) == 1 and 0 not in hits[0].values:
        return hits[0], set()
    seen = first(hits, AXES)
    inside = [hit.at for hit in hits if 0 not in hit.values]
    front = [hit for hit in hits if not inside or hit.at <= min(inside)]
    if not front or (len(front) == 1 and inside):
        return seen, set()
    least = min(hit.at for hit in front)
    may = [seen, *(hit for hit in front if hit.at == least)]
    may += [first(front, [way]) for way in ways(front)]
    return seen, {hit.name if hit else NOWHERE for hit in may}


def first(hits: Sequence[Hit], moves: Sequence[Vector]) -> Hit | None:
    """Return what the moved ray crosses first."""
    best = None
    for hit in hits:
        if hit.is_crossed(moves) and (best is None or hit.is_before(best, moves)):
            best = hit
    return best


def ways(hits: Sequence[Hit]) -> Iterator[Vector]:
    """Yield ways to move a ray, to both sides of every line at which what it sees may change.

    Seen along the ray, these are edges and intersections of surfaces: lines through one point. Two
    of them, of integers up to B, are at least 1 / (2 B^2) apart, and none comes between.
    """
    d = hits[0].d
    z = max(range(3), key=lambda axis: abs(d[axis]))
    lines = [of for h in hits for e, of in zip(h.values, h.edges, strict=True) if not e]
    lines += [h.line(g) for k, h in enumerate(hits) for g in hits[:k] if h.at == g.at]
    flat = [m if any(m) else cross(edge, d) for m, edge in lines]
    far = 4 * max((abs(v) for m in flat for v in m), default=0) ** 2
    for x, y in {(m[z - 2], m[z - 1]) for m in flat if m[z - 2] or m[z - 1]}:
        for along, across in ((far, 1), (far, -1), (-far, 1), (-far, -1)):
            move = {z: 0, (z - 2) % 3: across * x - along * y, (z - 1) % 3: across * y + along * x}
            yield move[0], move[1], move[2]


def check(of: Certificate, rows: Sequence[int]) -> None:
    """Check rows of the picture; raise a RefusedError that names the first pixel that is wrong."""
    together = max(1, PIXELS // of.shape[1])
    for at in range(0, len(rows), together):
        check_together(of, np.array(rows[at : at + together]))


def check_together(of: Certificate, rows: Any) -> None:
    """Check rows whose rays are in memory together."""
    origins, directions = of.rays(rows)
    numbers = (rows[:, None] * of.shape[1] + np.arange(of.shape[1])).ravel().tolist()
    far = np.nextafter(np.minimum(of.t[rows], of.clip[1]), np.inf)
    far.ravel()[[k for k, number in enumerate(numbers) if number in of.ties]] = of.clip[1]
    with np.errstate(all="ignore"):
        pixel, surface = left(of, origins, directions, far)
    exact = Exact(of, origins, directions, np.unique(surface))
    ends = np.searchsorted(pixel, np.arange(len(numbers) + 1)).tolist()
    near = surface.tolist()
    told = (v[rows].ravel().tolist() for v in (of.instance, of.triangle, of.t))
    for k, (number, instance, triangle, t) in enumerate(zip(numbers, *told, strict=True)):
        hits = [hit for s in near[ends[k] : ends[k + 1]] if (hit := exact.hit(k, s))]
        seen, ties = sees(hits)
        found = (seen.name, exact.t(seen), ties) if seen else (NOWHERE, np.inf, ties)
        said = (instance, triangle), t, of.ties.get(number, set())
        if found != said:
            y, x = divmod(number, of.shape[1])
            is_said, is_found = ("{} at t = {!r}, ties {}".format(*each) for each in (said, found))
            raise RefusedError(f"pixel ({x}, {y}): the file says {is_said}; it sees {is_found}")


def left(of: Certificate, origins: Floats, directions: Floats, far: Floats) -> Any:
    """Return pixels, ascending, and the surfaces, (n,) each, that floats do not drop there."""
    ahead = directions if directions.shape[1] == 1 else None
    r = directions if ahead is None else origins - of.eye
    squares, count = levels(r.reshape(3, *far.shape), far), of.corners.shape[2]
    found = [(np.zeros(0, np.intp),) * 2]
    for at in range(0, count, SURFACES):
        part = slice(at, min(at + SURFACES, count))
        forms = Forms(of, part, ahead, np.abs(r).max())
        found += [(pixel, at + s) for pixel, s in candidates(forms, squares, of.clip[0])]
    pixel, surface = (np.concatenate(v) for v in zip(*found, strict=True))
    order = np.argsort(pixel, kind="stable")
    return pixel[order], surface[order]


def check_arithmetic() -> None:
    """Refuse to check where float64 is not rounded to nearest, or loses its least numbers."""
    steps, least = np.array([1, 1.5, -0.5, -0.75]) * 2.0**-53, np.full(4, 2.0**-1022)
    is_near = np.ones(4) + steps - 1 == np.array([0, 2, 0, -1]) * 2.0**-53
    if not is_near.all() or not (least / 4 * 4 == least).all():
        raise RefusedError("this process does not compute as IEEE 754 prescribes")


def verified(file: str, sample: int | None = None) -> str:
    """Check a certificate, or so many rows, drawn at random; return what was checked, in words.

    Raises
    ------
    RefusedError
        If a pixel is wrong, something is not covered, or the file cannot be read.
    """
    began = time.process_time()
    if sample is not None and sample < 1:
        raise RefusedError("a sample has at least one row")
    check_arithmetic()
    try:
        of = Certificate(file)
    except RefusedError:
        raise
    except Exception as error:  # zip, zlib, numpy, JSON: each has its own ways to say no
        say = "no certificate, or damaged: write it anew by reftrace trace --certificate"
        raise RefusedError(f"'{file}' is {say} ({type(error).__name__}: {error})") from error
    height, width = of.shape
    rows = sorted(random.SystemRandom().sample(range(height), min(sample or height, height)))
    check(of, rows)
    what = "all" if len(rows) == height else f"a sample, {len(rows)} of {height} rows:"
    seconds = time.process_time() - began
    return f"{what} {len(rows) * width:,} pixels see what it says; {seconds:.1f} CPU seconds"


def main() -> int:
    """Run `python verify.py FILE [--sample ROWS]`: 0 is yes, 2 is no."""
    parser = argparse.ArgumentParser(description="Check a certificate of `reftrace trace`.")
    parser.add_argument("file")
    parser.add_argument("--sample", type=int, metavar="ROWS", help="check so many, at random")
    try:
        print(verified(**vars(parser.parse_args())))
    except RefusedError as error:
        print(f"refused: {error}")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
