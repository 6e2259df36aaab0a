"""Decides what a ray sees with Python's integers alone, without any rounding: the exact oracle.

It shares nothing with the tracer's own exact arithmetic: it uses Cramer's rule in place of edge
functions, tests every triangle with every ray in place of candidates, and really moves a ray (see
`moved_rays.py`) in place of a rule for signs that are zero. It takes the stored rays and the world
vertices as they are: they are the scene. Every float is an integer times a power of two, so all
that is computed from them is an integer, too. A pair takes some ten microseconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from reference_tracer.arrays import Bools, Index
from reference_tracer.scene import Scene
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.hits import NOTHING, NOWHERE
from reference_tracer.tracer.ties import Name
from reference_tracer.tracer.vector import Vectors, transform_points

from .moved_rays import (
    THE_RULE,
    Surface,
    Vector,
    crosses,
    dot,
    in_integers,
    meet,
    moved,
    nearest_of_moved,
)

OUTSIDE, EDGE, INSIDE = -1, 0, 1
rational = np.vectorize(Fraction, otypes=[object])
AT_ONCE = 1 << 16  # pairs: some hundred MiB of integers


@dataclass(frozen=True, eq=False)
class Intersections:
    """Exact intersections of n lines with n triangles, pair by pair, (n,) each."""

    # Where the stored line passes: INSIDE, at the EDGE, or OUTSIDE, which is also a line that is
    # parallel to the triangle or lies in its plane.
    side: NDArray[np.int8]
    hit: Bools  # whether the moved line meets the triangle
    numerator: NDArray[np.object_]  # integers: t = numerator / denominator * 2^shift
    denominator: NDArray[np.object_]
    shift: Index

    def t(self, k: int | np.integer) -> Fraction:
        """Return the t of a pair that is not OUTSIDE."""
        return Fraction(self.numerator[k], self.denominator[k]) * Fraction(2) ** int(self.shift[k])

    def within(self, start: float = 0.0, end: float = np.inf) -> Bools:
        """Return which pairs meet at start <= t <= end; not at t = 0 where the ray begins there."""
        if start == 0 and end == np.inf:  # the sign says it
            return (self.side != OUTSIDE) & (self.numerator * self.denominator > 0)
        met = np.zeros(len(self.side), bool)
        for k in np.flatnonzero(self.side != OUTSIDE):
            met[k] = _within(self.t(k), start, end)
        return met


def _within(t: Fraction, start: float, end: float) -> bool:
    return start <= t <= end and not t == start == 0


def intersect_pairs(origins: Vectors, directions: Vectors, corners: Vectors) -> Intersections:
    """Intersect n rays (3, n) and n triangles (3 corners, 3, n), pair by pair."""
    parts = []
    for at in range(0, corners.shape[2], AT_ONCE):
        part = slice(at, at + AT_ONCE)
        lengths, scale = scaled_integers(np.concatenate((origins[:, part], *corners[:, :, part])))
        d, direction_scale = scaled_integers(directions[:, part])
        o, p1, p2, p3 = lengths.reshape(4, 3, -1)
        det, u, v, numerator = meet(o, d, p1, p2, p3)
        rest = det - u - v
        front = det > 0
        weights = [np.where(front, w, -w) for w in (u, v, rest)]
        closed = (det != 0) & np.all([w >= 0 for w in weights], axis=0)
        inside = closed & np.all([w > 0 for w in weights], axis=0)
        hit = inside.copy()
        for k in np.flatnonzero(closed & ~inside):
            origin, along, *own = ([int(x) for x in w[:, k]] for w in (o, d, p1, p2, p3))
            o_moved, d_moved, [surface] = moved(origin, along, [Surface(NOWHERE, own)], THE_RULE)
            hit[k] = crosses(o_moved, d_moved, surface)
        side = np.where(inside, INSIDE, np.where(closed, EDGE, OUTSIDE)).astype(np.int8)
        parts.append((side, hit, numerator, det, scale - direction_scale))
    return Intersections(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def barycentrics(
    origins: Vectors, directions: Vectors, corners: Vectors
) -> tuple[NDArray[np.object_], NDArray[np.object_]]:
    """Return the barycentrics (3, n) of n lines on n triangles' planes, and what they share."""
    det, u, v, _ = meet(*map(rational, (origins, directions)), *rational(corners))
    return np.stack((det - u - v, u, v)) / det, det


def scaled_integers(values: Vectors) -> tuple[NDArray[np.object_], Index]:
    """Return floats (k, n) as integers and the exponent of each column: float = integer * 2^e."""
    mantissa, exponent = np.frexp(values)
    exponent = np.where(mantissa == 0, 5000, exponent.astype(np.int64))  # zero has none
    least = exponent.min(axis=0)
    exponent = np.where(mantissa == 0, least, exponent)
    whole = (mantissa * 2.0**53).astype(np.int64)
    shifted = whole.astype(object) << (exponent - least).astype(object)
    return shifted, np.where(least == 5000, 0, least - 53)


class Crossing(NamedTuple):
    """One surface that the stored ray meets within the clip range."""

    t: Fraction
    at_edge: bool
    surface: Surface  # in floats or fractions


@dataclass(frozen=True, eq=False)
class Sight:
    """What one ray sees."""

    origin: Vectors  # (3,)
    direction: Vectors  # (3,)
    seen: Name  # what the ray that the rule moves sees first, NOWHERE for nothing
    t: Fraction | None  # where the stored ray meets it
    # All surfaces that the textbook leaves open: the nearest that the closed triangles have, and
    # those that the ray meets at an edge before it.
    front: tuple[Surface, ...]
    covered: bool  # whether something is seen however the ray is moved

    @property
    def rounded_t(self) -> float:
        """The float nearest to t; inf for nothing, and for what is above all floats."""
        return np.inf if self.t is None else rounded(self.t)


def rounded(t: Fraction) -> float:
    """Return the float nearest to a t, the even one of two."""
    try:
        return float(t)
    except OverflowError:
        return np.inf


def scene_sights(scene: Scene, pixels: Index | None = None) -> list[Sight]:
    """Return what the rays through the pixels' centres see, row by row from the lowest.

    Parameters
    ----------
    scene : Scene
        Its triangles that have a corner that is not finite in world space are left out.
    pixels : (n,) int, optional
        Only these, by their number in the region.
    """
    camera = scene.camera
    x, y = film_positions(camera.region, 0.0, 0.0)
    rays = camera_rays(camera, x, y)
    o, d = (np.broadcast_to(v, (3, len(x))) for v in (rays.origins, rays.directions))
    if pixels is not None:
        o, d = o[:, pixels], d[:, pixels]
    names: list[Name] = []
    corners: list[Vectors] = [np.zeros((3, 3, 0))]
    for i, instance in enumerate(scene.instances):
        mesh = scene.meshes[instance.mesh]
        with np.errstate(over="ignore", invalid="ignore"):
            world = transform_points(instance.world_from_object, mesh.vertices.T)
        own = world[:, mesh.triangles.T].transpose(1, 0, 2)
        finite = np.flatnonzero(np.isfinite(own).all(axis=(0, 1)))
        corners.append(own[:, :, finite])
        names += [(i, int(k)) for k in finite]
    numbered = enumerate(scene.planes, len(scene.instances))
    planes = [((k, NOTHING), plane.point, plane.normal) for k, plane in numbered]
    clip = camera.clip_start, camera.clip_end
    return sights(o, d, np.concatenate(corners, axis=2), names, planes, clip)


def sights(
    origins: Vectors,
    directions: Vectors,
    corners: Vectors,
    names: Sequence[Name] | None = None,
    planes: Sequence[tuple[Name, Vector, Vector]] = (),
    clip: tuple[float, float] = (0.0, np.inf),
) -> list[Sight]:
    """Return what n rays see of m triangles and of infinite planes, all with all.

    Parameters
    ----------
    origins, directions : (3, n) float64
    corners : (3 corners, 3 components, m) float64
    names : sequence of Name, optional
        Of the triangles; without them (0, index).
    planes : sequence
        The name, a point and the normal of each.
    clip : (2,) float
        The least and the largest t, both inclusive, in lengths of the direction.
    """
    count, n = corners.shape[2], origins.shape[1]
    names = names or [(0, k) for k in range(count)]
    found: list[list[Crossing]] = [[] for _ in range(n)]
    step = max(1, AT_ONCE // max(count, 1))
    for at in range(0, n if count else 0, step):
        ray = np.repeat(np.arange(at, min(at + step, n)), count)
        triangle = np.tile(np.arange(count), len(ray) // count)
        result = intersect_pairs(origins[:, ray], directions[:, ray], corners[:, :, triangle])
        for k in np.flatnonzero(result.within(*clip)).tolist():
            surface = Surface(names[triangle[k]], list(corners[:, :, triangle[k]]))
            crossing = Crossing(result.t(k), result.side[k] == EDGE, surface)
            found[ray[k]].append(crossing)
    for ray_number, crossings in enumerate(found):
        o, d = ([Fraction(float(x)) for x in v[:, ray_number]] for v in (origins, directions))
        for name, point, normal in planes:
            p, w = ([Fraction(float(x)) for x in v] for v in (point, normal))
            if dot(d, w) and _within(t := (dot(p, w) - dot(o, w)) / dot(d, w), *clip):
                crossings.append(Crossing(t, False, Surface(name, [p], w)))
    return [_sight(origins[:, k], directions[:, k], m) for k, m in enumerate(found)]


def _sight(o: Vectors, d: Vectors, crossings: list[Crossing]) -> Sight:
    sure = min((m.t for m in crossings if not m.at_edge), default=None)
    front = [m for m in crossings if sure is None or m.t == sure or (m.at_edge and m.t < sure)]
    surfaces = tuple(m.surface for m in front)
    if len(front) == 1 and sure is not None:
        seen = front[0].surface.name
    else:
        seen = nearest_of_moved(*in_integers(o, d, surfaces), THE_RULE) if front else NOWHERE
    t = next((m.t for m in front if m.surface.name == seen), None)
    return Sight(o, d, seen, t, surfaces, sure is not None)
