"""Decides in fractions which faces a camera sees, and how much of each: the oracle.

Every face is cut to the clip range, projected and cut to the region; then what nearer faces cover
is cut away. Nothing is rounded, and nothing is shared with the package that is tested.
"""

from __future__ import annotations

from fractions import Fraction
from typing import NamedTuple

import numpy as np

Point = tuple[Fraction, ...]
Line = tuple[Fraction, Fraction, Fraction]  # a + b x + c y


class Surface(NamedTuple):
    """A surface on the film: its convex polygon, which way it turns, and its nearness."""

    polygon: list[Point]
    nearness: Line | None  # None for what is seen edge-on


def seen_areas(scene) -> list[Fraction]:
    """Return how much of each face of each instance is seen, in square pixels."""
    film = _Film(scene.camera)
    faces = [film.face(corners) for corners in world_faces(scene)]
    planes = [film.plane(plane) for plane in scene.planes]
    found = []
    for number, face in enumerate(faces):
        pieces = [face.polygon] if face.nearness and len(face.polygon) > 2 else []
        for other, occluder in enumerate([*faces, *planes]):
            if pieces and other != number and occluder.nearness:
                pieces = _without(pieces, face, occluder, other < number)
        found.append(sum(map(_area, pieces), Fraction(0)))
    return found


def _without(pieces, face, occluder, wins_ties):
    """Return what is left of a face's pieces where another surface is nearer."""
    nearer = tuple(a - b for a, b in zip(occluder.nearness, face.nearness, strict=True))
    if not any(nearer):
        covering = occluder.polygon if wins_ties else []
    else:
        covering = _cut(occluder.polygon, nearer)
    if len(covering) < 3 or not _area(covering):
        return pieces
    left = []
    for piece in pieces:
        inside = piece
        for line in _sides(covering):
            left.append(_cut(inside, tuple(-v for v in line)))
            inside = _cut(inside, line)
    return [piece for piece in left if len(piece) > 2 and _area(piece)]


class _Film:
    """A camera in fractions."""

    def __init__(self, camera) -> None:
        self.camera = camera
        axes = [[Fraction(v) for v in axis] for axis in (camera.right, camera.up, camera.forward)]
        crossed = [_cross(axes[k - 2], axes[k - 1]) for k in range(3)]
        det = _dot(axes[0], crossed[0])
        self.dual = [[v / det for v in row] for row in crossed]
        w = camera.window
        self.left, self.bottom = Fraction(w.left), Fraction(w.bottom)
        # As the camera's rays have it: a pixel's size is a float.
        self.width = Fraction((w.right - w.left) / camera.width)
        self.height = Fraction((w.top - w.bottom) / camera.height)
        self.parallel = camera.projection.shares_direction

    def view(self, point):
        q = [Fraction(v) - Fraction(o) for v, o in zip(point, self.camera.origin, strict=True)]
        return tuple(_dot(d, q) for d in self.dual)

    def place(self, xyz):
        x, y, depth = xyz
        scale = 1 if self.parallel else depth
        return (x / scale - self.left) / self.width, (y / scale - self.bottom) / self.height

    def face(self, corners) -> Surface:
        points = [self.view(corner) for corner in corners]
        a, b, c = points
        normal = _cross(_minus(b, a), _minus(c, a))
        nearness = self._nearness(normal, _dot(a, normal))
        start, end = (Fraction(v) for v in (self.camera.clip_start, self.camera.clip_end))
        for sign, limit in ((1, start), (-1, end)):
            points = _cut_by(points, [sign * (p[2] - limit) for p in points])
        return Surface(self._in_region([self.place(p) for p in points]), nearness)

    def plane(self, plane) -> Surface:
        point = self.view(plane.point)
        axes = (self.camera.right, self.camera.up, self.camera.forward)
        normal = [
            _dot([Fraction(v) for v in axis], [Fraction(v) for v in plane.normal]) for axis in axes
        ]
        nearness = self._nearness(normal, _dot(point, normal))
        polygon = self._in_region(None)
        start, end = (Fraction(v) for v in (self.camera.clip_start, self.camera.clip_end))
        if nearness:
            near, far = (-start, -end) if self.parallel else (1 / start, 1 / end)
            a, b, c = nearness
            polygon = _cut(_cut(polygon, (near - a, -b, -c)), (a - far, b, c))
        return Surface(polygon, nearness)

    def _nearness(self, n, t) -> Line | None:
        """Return 1 / t or -t of the plane n . x = t as a function of the film position."""
        x = (self.left, self.width, Fraction(0))
        y = (self.bottom, Fraction(0), self.height)
        along = [n[0] * u + n[1] * v for u, v in zip(x, y, strict=True)]
        if self.parallel:
            if not n[2]:
                return None
            along[0] -= t
            return tuple(v / n[2] for v in along)
        if not t:
            return None
        along[0] += n[2]
        return tuple(v / t for v in along)

    def _in_region(self, polygon):
        r = self.camera.region
        x0, y0, x1, y1 = (Fraction(v) for v in (r.x0, r.y0, r.x1, r.y1))
        zero, one = Fraction(0), Fraction(1)
        if polygon is None:
            return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        for line in ((-x0, one, zero), (x1, -one, zero), (-y0, zero, one), (y1, zero, -one)):
            polygon = _cut(polygon, line)
        return polygon


def world_faces(scene):
    """Yield the corners of each face of each instance, as the definition has them."""
    for instance in scene.instances:
        mesh = scene.meshes[instance.mesh]
        m = instance.world_from_object
        x, y, z = mesh.vertices.T.astype(np.float64)
        world = np.stack([((m[i, 0] * x + m[i, 1] * y) + m[i, 2] * z) + m[i, 3] for i in range(3)])
        for triangle in mesh.triangles:
            yield [world[:, corner].tolist() for corner in triangle]


def _cut(polygon, line):
    """Return the part of a convex polygon where a line's function is not negative."""
    a, b, c = line
    return _cut_by(polygon, [a + b * p[0] + c * p[1] for p in polygon])


def _cut_by(polygon, values):
    out = []
    for k, (point, value) in enumerate(zip(polygon, values, strict=True)):
        before, other = polygon[k - 1], values[k - 1]
        if (value > 0 > other) or (value < 0 < other):
            share = other / (other - value)
            pairs = zip(before, point, strict=True)
            out.append(tuple(p + share * (q - p) for p, q in pairs))
        if value >= 0:
            out.append(point)
    return out


def _sides(polygon):
    """Return the functions of a convex polygon's sides, positive within."""
    sign = 1 if _twice(polygon) > 0 else -1
    for k, (x1, y1) in enumerate(polygon):
        x0, y0 = polygon[k - 1]
        if (x0, y0) != (x1, y1):
            b, c = -sign * (y1 - y0), sign * (x1 - x0)
            yield -(b * x0 + c * y0), b, c


def _twice(polygon):
    return sum(polygon[k - 1][0] * y - polygon[k - 1][1] * x for k, (x, y) in enumerate(polygon))


def _area(polygon) -> Fraction:
    return abs(_twice(polygon)) / 2


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def _minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
