"""The shapes of the kit's scenes: vertices in float32, and polygons that are flat and convex."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike
from reference_tracer.arrays import Floats, Integers
from reference_tracer.scene import Mesh

Polygon = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Shape:
    """A mesh of polygons."""

    name: str
    vertices: Floats  # (v, 3) float32, metres, object space
    polygons: tuple[Polygon, ...]
    slots: tuple[int, ...] = ()  # which material each polygon has; by default all have the first

    @property
    def slot_of(self) -> tuple[int, ...]:
        """Which material each polygon has."""
        return self.slots or (0,) * len(self.polygons)

    @property
    def triangles(self) -> Integers:
        """The polygons cut into fans, (n, 3)."""
        fans = [(p[0], *p[k : k + 2]) for p in self.polygons for k in range(1, len(p) - 1)]
        return np.array(fans, np.int32).reshape(-1, 3)

    @property
    def triangle_slots(self) -> Integers:
        """Which material each triangle has, (n,)."""
        counts = [len(p) - 2 for p in self.polygons]
        return np.repeat(np.array(self.slot_of, np.int32), counts)

    @property
    def mesh(self) -> Mesh:
        """The mesh that is traced."""
        return Mesh(self.vertices, self.triangles, self.triangle_slots, name=self.name)

    def unwelded(self) -> Shape:
        """Return the same with vertices of its own for each triangle."""
        corners = self.triangles.reshape(-1)
        own = tuple((k, k + 1, k + 2) for k in range(0, len(corners), 3))
        slots = tuple(self.triangle_slots.tolist())
        return Shape(f"{self.name} unwelded", self.vertices[corners], own, slots)


def _shape(name: str, vertices: ArrayLike, polygons: Sequence[Polygon]) -> Shape:
    return Shape(name, np.array(vertices, np.float32), tuple(polygons))


def _circle(count: int) -> Floats:
    """Return points of the circle of radius 1, (count, 2)."""
    turns = 2 * np.pi * np.arange(count) / count
    return np.column_stack((np.cos(turns), np.sin(turns)))


def _walls(count: int) -> list[Polygon]:
    """Return quads around a prism, whose lower corners are the first `count`."""
    ends = [(k, (k + 1) % count) for k in range(count)]
    return [(a, b, b + count, a + count) for a, b in ends]


@cache
def bracket() -> Shape:
    """Return an L with a slanted top, 2 x 1.5 x 0.9 m: no mirroring leaves it as it is."""
    profile = np.array([(0, 0), (2, 0), (2, 0.5), (0.5, 0.5), (0.5, 1.5), (0, 1.5)])
    low = np.column_stack((profile, np.zeros(6)))
    high = np.column_stack((profile, 0.4 + 0.25 * profile[:, 0]))
    top = [(6, 7, 8, 9), (6, 9, 10, 11)]
    bottom = [(3, 2, 1, 0), (5, 4, 3, 0)]
    return _shape("bracket", np.concatenate((low, high)), [*_walls(6), *top, *bottom])


@cache
def box(x: float = 1.0, y: float = 1.0, z: float = 1.0) -> Shape:
    """Return a box of these half sizes about the origin."""
    corners = [(i * x, j * y, k * z) for k in (-1, 1) for j in (-1, 1) for i in (-1, 1)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return _shape("box", corners, sides)


@cache
def ball() -> Shape:
    """Return a globe of radius 1, its quads flat as both their ends are parallels."""
    rings, around = 6, 10
    angles = np.pi * np.arange(1, rings) / rings
    ring = _circle(around)
    points = [
        np.column_stack((np.sin(a) * ring, np.full(around, np.cos(a)))) for a in angles.tolist()
    ]
    vertices = np.concatenate(([(0, 0, 1)], *points, [(0, 0, -1)]))
    last = len(vertices) - 1
    meridians = np.arange(1, last).reshape(-1, around).T.tolist()
    faces: list[Polygon] = []
    for here, next_ in zip(meridians, [*meridians[1:], meridians[0]], strict=True):
        faces.append((0, here[0], next_[0]))
        for (a, b), (c, d) in pairwise(zip(here, next_, strict=True)):
            # Two triangles: in float32 the four corners are flat only nearly.
            faces += [(a, c, d), (a, d, b)]
        faces.append((here[-1], last, next_[-1]))
    return _shape("ball", vertices, faces)


@cache
def prism() -> Shape:
    """Return a prism on a regular polygon, its ends one face each, its axis along Z."""
    sides = 6
    ring = _circle(sides)
    ends = [np.column_stack((ring, np.full(sides, z))) for z in (-1, 1)]
    caps = [tuple(range(sides, 2 * sides)), tuple(range(sides))[::-1]]
    return _shape("prism", np.concatenate(ends), [*_walls(sides), *caps])


@cache
def triangle() -> Shape:
    """Return one triangle that faces -Y."""
    return _shape("triangle", [(-1, 0, -0.75), (1, 0, -0.75), (0.25, 0, 1)], [(0, 1, 2)])


@cache
def sheet(size: float = 1.0) -> Shape:
    """Return a square in XY that faces +Z, two triangles of which share a diagonal."""
    corners = [(-size, -size, 0), (size, -size, 0), (size, size, 0), (-size, size, 0)]
    return _shape("sheet", corners, [(0, 1, 2, 3)])


@cache
def needles() -> Shape:
    """Return a fan of thin triangles about the origin, in XZ: each is 13 times as long as wide."""
    out = np.insert(_circle(24), 1, 0, axis=1)
    across = out[:, ::-1] * (-0.05, 0, 0.05)
    corners = np.stack((0.15 * out, 1.5 * out - across, 1.5 * out + across), axis=1)
    faces = [(k, k + 1, k + 2) for k in range(0, 3 * len(out), 3)]
    return _shape("needles", corners.reshape(-1, 3), faces)


def with_zero_areas(shape: Shape) -> Shape:
    """Return a shape with triangles of no area between the others: points, and doubled edges."""
    nothing = [p for a, b, *_ in shape.polygons for p in ((a, a, a), (a, b, b))]
    return replace(
        shape,
        name=f"{shape.name} with zero areas",
        polygons=tuple(p for pair in zip(nothing[::2], shape.polygons, strict=True) for p in pair)
        + tuple(nothing[1::2]),
    )


def in_two(shape: Shape) -> Shape:
    """Return a shape whose every second polygon is of a second material."""
    slots = tuple(k % 2 for k in range(len(shape.polygons)))
    return replace(shape, name=f"{shape.name} of two materials", slots=slots)
