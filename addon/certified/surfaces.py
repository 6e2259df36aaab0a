"""The records that the ladder works on: candidates of rays, and the surfaces that they index."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Bytes, Floats, Index, Integers
from ..tracer.camera import Rays
from ..tracer.hits import NOTHING, Names
from ..tracer.vector import Arrays, gather, occurring
from ..tracer.world import WorldTriangles, world_corners
from . import exact

if TYPE_CHECKING:
    from ..scene import Scene

# The doubt about a candidate: none; the sign of an edge function or of D; the clip range.
SURE, EDGE, CLIP = 0, 1, 2
PlaneOf = tuple[Floats, Floats]  # a point and the normal, (3,) each


@dataclass(frozen=True, eq=False)
class Candidates(Arrays):
    """c surfaces that may be the nearest of their ray.

    `surface` (c,) indexes `Surfaces`; `low` and `high` (c,) enclose t; `doubt` (c,) is SURE, EDGE
    or CLIP.
    """

    ray: Index
    surface: Index
    low: Floats
    high: Floats
    doubt: Bytes

    @classmethod
    def none(cls) -> Candidates:
        """Return no candidates."""
        index, t = np.zeros(0, np.intp), np.zeros(0)
        return cls(index, index, t, t, np.zeros(0, np.uint8))

    def by_ray(self, limit: int) -> Iterator[Candidates]:
        """Split them into parts of about at most `limit`, those of one ray together."""
        found = self.take(np.argsort(self.ray, kind="stable"))
        starts = np.flatnonzero(np.diff(found.ray, prepend=-1))
        ends = np.arange(limit, len(found.ray), limit)
        cuts = np.r_[starts, len(found.ray)][np.searchsorted(starts, ends)]
        for part in np.split(np.arange(len(found.ray)), cuts):
            if len(part):
                yield found.take(part)


@dataclass(frozen=True, eq=False)
class Surfaces:
    """The surfaces that candidates index: infinite planes, then triangles.

    The first of the planes is called by the instance `first_plane`.
    """

    planes: Sequence[PlaneOf] = ()
    first_plane: int = 0
    triangles: WorldTriangles = field(default_factory=WorldTriangles.none)

    @classmethod
    def planes_of(cls, scene: Scene) -> Surfaces:
        """Return a scene's infinite planes, and no triangles yet."""
        return cls([(p.point, p.normal) for p in scene.planes], len(scene.instances))

    def only(self, surface: Index) -> tuple[Surfaces, Index]:
        """Return all planes and only the triangles among these surfaces, and the new indices."""
        planes = len(self.planes)
        count = planes + self.triangles.corners.shape[2]
        which, place = occurring(np.r_[np.arange(planes), surface], count)
        triangles = self.triangles.take(which[planes:] - planes)
        return replace(self, triangles=triangles), place[planes:]

    def names(self, surface: Index | slice = slice(None)) -> tuple[Integers, Integers]:
        """Return instance and triangle of surfaces, (c,) each; by default of all."""
        count = len(self.planes)
        instance = np.r_[self.first_plane + np.arange(count), self.triangles.instance]
        triangle = np.r_[np.full(count, NOTHING), self.triangles.triangle]
        return instance.astype(np.int32)[surface], triangle.astype(np.int32)[surface]

    def integers(
        self, rays: Rays, ray: Index, surface: Index, clip: tuple[float, float] = (-np.inf, np.inf)
    ) -> tuple[exact.IntegerBatch, Index, Index]:
        """Return rays and surfaces as integers, and where pairs of them, (c,) each, are there."""
        which, ray = np.unique(ray, return_inverse=True)
        some, surface = self.only(surface)
        corners = some.triangles.corners
        batch = exact.IntegerBatch(rays.take(which), corners, self.planes, *clip)
        return batch, ray, surface


def surfaces_of(scene: Scene, instance: Names, triangle: Names) -> tuple[Surfaces, Index]:
    """Return the surfaces of these names, (n,) each, and which of them each is."""
    planes = Surfaces.planes_of(scene)
    first = planes.first_plane
    which, row = _different(instance, triangle)
    of_mesh = gather(instance, which) < first
    own = which[of_mesh]
    names = gather(instance, own), gather(triangle, own)
    triangles = WorldTriangles(world_corners(scene, *names), *names)
    on_mesh = len(planes.planes) - 1 + np.cumsum(of_mesh)
    number = np.where(of_mesh, on_mesh, instance[which] - first)
    return replace(planes, triangles=triangles), gather(number, row)


def _different(instance: Index, triangle: Index) -> tuple[Index, Index]:
    """Return where different names occur first, and which of these each is.

    In their order: neighbours in the picture are neighbours in memory. Of names that share a place
    in the table, some may come more than once.
    """
    every = np.arange(len(instance), dtype=np.int32)
    table = np.empty(1 << (2 * len(every)).bit_length(), np.int32)
    place = (triangle + instance * np.int32(40503)) & (len(table) - 1)
    table[place[::-1]] = every[::-1]
    first = gather(table, place)
    same = (gather(instance, first) == instance) & (gather(triangle, first) == triangle)
    first = np.where(same, first, every)
    which = np.flatnonzero(first == every)
    table[which] = every[: len(which)]
    return which, gather(table, first)
