"""A second tie rule: which pixels are ambiguous, found by really moving rays over an exact image.

Written apart from `addon/certified`, of which it imports nothing, and in other terms. The
surfaces are seen in coordinates of the stored ray itself, where it is the point (0, 0) of an image.
There every edge is a line, and t is a quotient: c + x gx + y gy each, in integers. A ray is moved
to the side by a number that is small enough for nothing to change but what is zero; in the
directions just beside each line through (0, 0), so that there is one between every two of them.
What the moved ray meets is then simply looked at.

A pixel is ambiguous if those rays and the stored one, for which an edge belongs to the surface, do
not all have the same surface nearest, and that one alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, inf, lcm
from typing import NamedTuple

import numpy as np
from reference_tracer.scene import Camera, Scene
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.frame import Frame

Name = tuple[int, int]
Answer = frozenset[Name]
NOWHERE: Name = (-1, -1)
AMBIGUOUS = 3
Whole = tuple[int, int, int]
Affine = Whole  # c, gx, gy
_DOUBT = 1e-9  # of a product's size: far above what float64 rounds, to see what is surely missed


class Seen(NamedTuple):
    """A surface in the image: a ray at (x, y) meets it at t = above / below, if inside."""

    name: Name
    edges: tuple[Affine, ...]  # all of one sign inside; a plane has none
    above: Affine
    below: Affine

    def t(self) -> Fraction:
        return Fraction(self.above[0], self.below[0])

    def is_closed_hit(self) -> bool:
        signs = [e[0] for e in self.edges]
        return self.below[0] != 0 and not (min(signs, default=0) < 0 < max(signs, default=0))

    def is_inside(self) -> bool:
        return all(e[0] for e in self.edges)


def possible(scene: Scene, unrounded: bool = False) -> list[set[Answer]]:
    """Return for every pixel of the camera's region all that may be said to be seen.

    Of each ray that is asked, the names of all that is nearest: several, where they lie in one
    plane. More than one name in all: the pixel is ambiguous. Rays and corners are the stored ones,
    or `unrounded` those of the camera and the matrices, in fractions.
    """
    camera = scene.camera
    rays = camera_rays(camera, *film_positions(camera.region))
    shape = 3, camera.region.width * camera.region.height
    origins, directions = (np.broadcast_to(v, shape).T for v in (rays.origins, rays.directions))
    names, corners = _triangles(scene)
    planes = [
        ((len(scene.instances) + k, -1), plane.point.tolist(), plane.normal.tolist())
        for k, plane in enumerate(scene.planes)
    ]
    clip = camera.clip_start, camera.clip_end
    out = []
    for pixel, (o, d) in enumerate(zip(origins, directions, strict=True)):
        near = np.flatnonzero(_may_meet(o, d, corners)).tolist()
        if unrounded:
            o, d = camera_ray(camera, pixel)
            triangles = [(names[k], placed(scene, names[k])) for k in near]
        else:
            o, d = o.tolist(), d.tolist()
            triangles = [(names[k], corners[k].tolist()) for k in near]
        out.append(_of_ray(o, d, triangles, planes, clip, camera.projection))
    return out


def camera_ray(camera: Camera, pixel: int) -> tuple[list[Fraction], list[Fraction]]:
    """Return origin and direction of a region's ray, as the camera has it, without rounding."""
    y, x = divmod(pixel, camera.region.width)
    w = {name: Fraction(value) for name, value in vars(camera.window).items()}
    u = (
        w["left"]
        + (w["right"] - w["left"]) * Fraction(2 * (x + camera.region.x0) + 1, 2) / camera.width
    )
    v = (
        w["bottom"]
        + (w["top"] - w["bottom"]) * Fraction(2 * (y + camera.region.y0) + 1, 2) / camera.height
    )
    right, up, back, eye = (
        [Fraction(c) for c in column] for column in camera.world_from_camera.T[:, :3].tolist()
    )
    aside = [u * a + v * b for a, b in zip(right, up, strict=True)]
    if camera.projection.shares_direction:
        return [e + a for e, a in zip(eye, aside, strict=True)], [-b for b in back]
    return eye, [a - b for a, b in zip(aside, back, strict=True)]


def placed(scene: Scene, name: Name) -> list[list[Fraction]]:
    """Return where a triangle's corners are, without rounding."""
    instance = scene.instances[name[0]]
    mesh = scene.meshes[instance.mesh]
    rows = [[Fraction(x) for x in row] for row in instance.world_from_object[:3].tolist()]
    vertices = mesh.vertices[mesh.triangles[name[1]]].astype(np.float64).tolist()
    local = [[Fraction(x) for x in v] + [1] for v in vertices]
    return [[sum(a * b for a, b in zip(row, v, strict=True)) for row in rows] for v in local]


def compared(scene: Scene, frame: Frame) -> list[tuple[int, str]]:
    """Return the pixels of a certified frame of which this rule says otherwise, and what.

    Of surfaces in one plane the frame's rule sees that with the lowest name, and it need not name
    the others where the stored ray itself meets something nearer.
    """
    out = []
    for pixel, answers in enumerate(possible(scene)):
        owner = int(frame.instance_index.flat[pixel]), int(frame.triangle_index.flat[pixel])
        every, lowest = frozenset().union(*answers), {min(answer) for answer in answers}
        is_tie, tied = len(every) > 1, frame.ties.get(pixel, frozenset())
        if (frame.certainty.flat[pixel] == AMBIGUOUS) != is_tie:
            out.append((pixel, f"{'a tie' if is_tie else 'no tie'}: {sorted(every)}"))
        elif owner not in lowest:
            out.append((pixel, f"{owner} is seen, not one of {sorted(lowest)}"))
        elif is_tie and not lowest <= tied <= every:
            out.append((pixel, f"ties {sorted(tied)}, not {sorted(every)}"))
    return out


def _triangles(scene: Scene) -> tuple[list[Name], np.ndarray]:
    """Return names and corners (m, 3, 3) of the triangles that are finite in world space."""
    names, corners = [], [np.zeros((0, 3, 3))]
    for i, instance in enumerate(scene.instances):
        mesh, m = scene.meshes[instance.mesh], instance.world_from_object
        x, y, z = mesh.vertices.T.astype(np.float64)
        with np.errstate(all="ignore"):
            world = np.stack([m[k, 0] * x + m[k, 1] * y + m[k, 2] * z + m[k, 3] for k in range(3)])
        own = world.T[mesh.triangles]
        finite = np.isfinite(own).all(axis=(1, 2))
        names += [(i, k) for k in np.flatnonzero(finite).tolist()]
        corners.append(own[finite])
    return names, np.concatenate(corners)


def _may_meet(o: np.ndarray, d: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return which triangles the ray does not surely miss."""
    if not len(corners):
        return np.zeros(0, bool)
    with np.errstate(all="ignore"):
        arms = corners - o
        sizes = np.abs(corners) + np.abs(o)
        turned = np.roll(arms, -1, axis=1)
        e = (np.cross(arms, turned) * d).sum(axis=2)
        size = np.abs(sizes).max(axis=(1, 2)) ** 2 * np.abs(d).max() * _DOUBT
        missed = (e.min(axis=1) < -size) & (e.max(axis=1) > size)
    return ~(missed & np.isfinite(e).all(axis=1))


def _of_ray(o, d, triangles, planes, clip, projection) -> set[Answer]:
    points = [p for _, corners in triangles for p in corners] + [p for _, p, _ in planes]
    (o, *points), length = _integers([o, *points])
    [d], direction = _integers([d])
    image, count = _Image(o, d, projection.shares_direction), 3 * len(triangles)
    found = [
        image.triangle(name, points[3 * k : 3 * k + 3]) for k, (name, _) in enumerate(triangles)
    ]
    for (name, _, normal), point in zip(planes, points[count:], strict=True):
        found.append(image.plane(name, point, _integers([normal])[0][0]))
    unit = Fraction(direction, length)  # of t
    hits = [s for s in found if s.is_closed_hit() and _in_range(s.t() * unit, *clip)]
    if not hits:
        return {frozenset((NOWHERE,))}
    sure = min((s.t() for s in hits if s.is_inside()), default=inf)
    hits = [s for s in hits if s.t() <= sure]  # what lies behind is not seen by any of these rays
    first = min(s.t() for s in hits)
    seen = {frozenset(s.name for s in hits if s.t() == first)}
    edges = [e for s in hits for e in s.edges]
    orders = [
        _linear(one.above, other.below, other.above, one.below)
        for k, one in enumerate(hits)
        for other in hits[:k]
    ]
    lines = {_least(*f[1:]) for f in (*edges, *orders) if f[0] == 0 and any(f[1:])}
    fixed = [f for f in (*edges, *orders, *(s.below for s in hits)) if f[0] != 0]
    for x, y in _beside(lines):
        size = 1 + max((2 * abs(gx * x + gy * y) // abs(c) for c, gx, gy in fixed), default=0)
        seen.add(_nearest(hits, x, y, size))
    return seen


def _integers(vectors: Sequence[Sequence[float]]) -> tuple[list[Whole], int]:
    """Return vectors times a number that makes them whole, and that."""
    ratios = [[x.as_integer_ratio() for x in v] for v in vectors]
    unit = lcm(*(below for v in ratios for _, below in v))
    return [tuple(above * (unit // below) for above, below in v) for v in ratios], unit


def _in_range(t: Fraction, start: float, end: float) -> bool:
    return start <= t <= end and not (t == 0 and start == 0)


def _nearest(hits: Sequence[Seen], x: int, y: int, size: int) -> Answer:
    """Return what is nearest to the ray at (x, y) / size; NOWHERE for nothing."""
    best, names = inf, {NOWHERE}
    for s in hits:
        if len({_at(e, x, y, size) > 0 for e in s.edges}) > 1:
            continue
        t = Fraction(_at(s.above, x, y, size), _at(s.below, x, y, size))
        if t < best:
            best, names = t, {s.name}
        elif t == best:
            names.add(s.name)
    return frozenset(names)


def _at(f: Affine, x: int, y: int, size: int) -> int:
    return f[0] * size + f[1] * x + f[2] * y


def _linear(a: Affine, b: Affine, c: Affine, d: Affine) -> Affine:
    """Return a b - c d where one factor of each is constant."""
    assert not (any(a[1:]) and any(b[1:])) and not (any(c[1:]) and any(d[1:]))
    x, y = (a[0] * b[k] + a[k] * b[0] - c[0] * d[k] - c[k] * d[0] for k in (1, 2))
    return a[0] * b[0] - c[0] * d[0], x, y


def _beside(lines: set[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return directions to both sides of both ends of each line, given by its gradient.

    Between a line and such a direction there is no other line: of two whole gradients of at most B
    the lines are at least 1 / (2 B^2) apart, as an angle.
    """
    far = 16 * max((abs(v) for g in lines for v in g), default=1) ** 2
    return [
        (r * far * -gy + s * gx, r * far * gx + s * gy)
        for gx, gy in lines
        for r in (1, -1)
        for s in (1, -1)
    ]


def _least(x: int, y: int) -> tuple[int, int]:
    """Return the least integers that have the same direction."""
    unit = gcd(x, y)
    return x // unit, y // unit


class _Image:
    """What one ray sees: X and Y are zero on it, W grows along it.

    Along an axis k of the world, of which the direction has most, v - o has X = v_i d_k - v_k d_i,
    Y alike, W = v_k d_k: so that o + t d has (0, 0, t d_k^2).
    """

    def __init__(self, o: Whole, d: Whole, parallel: bool) -> None:
        k = max(range(3), key=lambda axis: abs(d[axis]))
        self._axes, self._o, self._d, self._parallel = ((k + 1) % 3, (k + 2) % 3, k), o, d, parallel
        self._unit = d[k] ** 2

    def _point(self, p: Whole) -> Whole:
        i, j, k = self._axes
        v, d = [x - own for x, own in zip(p, self._o, strict=True)], self._d
        return v[i] * d[k] - v[k] * d[i], v[j] * d[k] - v[k] * d[j], v[k] * d[k]

    def triangle(self, name: Name, corners: Sequence[Whole]) -> Seen:
        points = [self._point(p) for p in corners]
        pairs = list(zip(points, points[1:] + points[:1], strict=True))
        planes = [_cross(*pair) for pair in pairs]
        if self._parallel:
            edges = [(a[0] * b[1] - a[1] * b[0], a[1] - b[1], b[0] - a[0]) for a, b in pairs]
        else:
            edges = [(m[2] * self._unit, m[0], m[1]) for m in planes]
        return Seen(
            name, tuple(edges), *self._depth([sum(m) for m in zip(*planes, strict=True)], points[0])
        )

    def plane(self, name: Name, point: Whole, n: Whole) -> Seen:
        i, j, k = self._axes
        along = sum(a * b for a, b in zip(n, self._d, strict=True))
        n = n[i] * self._d[k], n[j] * self._d[k], along
        return Seen(name, (), *self._depth(n, self._point(point)))

    def _depth(self, n: Sequence[int], point: Whole) -> tuple[Affine, Affine]:
        """Return above and below of a plane n . p = n . point, where p is what a ray meets.

        That is (x, y, t unit) for parallel rays, else t (x, y, unit).
        """
        level, along = sum(a * b for a, b in zip(n, point, strict=True)), n[2] * self._unit
        if self._parallel:
            return (level, -n[0], -n[1]), (along, 0, 0)
        return (level, 0, 0), (along, n[0], n[1])


def _cross(a: Whole, b: Whole) -> Whole:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
