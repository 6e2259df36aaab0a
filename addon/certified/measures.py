"""Finds t, rounded to the nearest float64, and the barycentrics of rays on what they surely see.

Which surface a ray sees is known before. What is found here depends on the ray and its surface
alone, so that it does not matter when it is found, or together with what.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Bools, Floats, Index
from ..scene import Region, Scene
from ..tracer.camera import Rays, camera_rays, corner_rays, film_positions
from ..tracer.frame_measures import PIXELS
from ..tracer.hits import NOTHING, Hits, Measures, Names
from ..tracer.vector import Arrays, Vectors, cross, gather, largest, parts
from ..tracer.world import WorldTriangles, world_corners
from .arithmetic import sound
from .quotient import Quotients
from .surfaces import Surfaces

_LEAST = 2.0**-960  # of the sum of edge functions: far above what gradual underflow may lose
TOGETHER = 1 << 13  # rays at a time: their temporaries stay in a core's cache


class Prepared:
    """Surfaces, prepared for rays that share an origin, a direction, or nothing.

    What belongs to the surfaces alone is computed once, for all rays.
    """

    def __init__(self, rays: Rays, surfaces: Surfaces) -> None:
        corners = surfaces.triangles.corners
        self._surfaces, self._names = surfaces, surfaces.names()
        self._planes = len(surfaces.planes)
        with np.errstate(all="ignore"):  # what overflows is not sure
            self._quotients = Quotients.of(rays, corners, surfaces.planes)
            self._edges, self._least = _edges(rays, corners)

    def enter(
        self, hits: Hits, at: Index, surface: Index, rays_at: Callable[[Index], Rays]
    ) -> Iterator[None]:
        """Enter what rays surely meet first into the hits with these numbers (p,), in small steps.

        Integers divide where t or the barycentrics are not known well.
        """
        instance, triangle = self._names
        unsure = [np.arange(0)]
        for part in parts(len(at), TOGETHER):
            own = at[part]
            of = surface[part]
            with np.errstate(all="ignore"):  # what overflows is not sure
                hits.t[own], sure, s = self.meet(rays_at(own), of)
            unsure.append(np.flatnonzero(~sure) + part.start)
            for component, value in zip(hits.s, s, strict=True):
                component[own] = value
            hits.instance[own], hits.triangle[own] = instance.take(of), triangle.take(of)
            yield
        which = np.concatenate(unsure)
        if not len(which):
            return
        at = at[which]
        batch, numbers, surfaces = self._surfaces.integers(
            rays_at(at), np.arange(len(at)), surface[which]
        )
        for ray, number, of in zip(at.tolist(), numbers.tolist(), surfaces.tolist(), strict=True):
            hit = batch.hit(number, of)
            assert hit, "the ray certainly meets it"
            hits.t[ray] = batch.t(hit)
            if np.isnan(hits.s[0, ray]):
                hits.s[:, ray] = hit.weights

    def meet(self, rays: Rays, surface: Index) -> tuple[Floats, Bools, Vectors]:
        """Return t of p rays, whether it surely is rounded correctly, and the barycentrics."""
        t, sure = self._quotients.meet(rays, surface)
        row = np.maximum(surface - self._planes, 0) if self._planes else surface
        s = self._weights(rays, row) if len(self._edges.T) else np.zeros((3, len(surface)))
        if self._planes:
            s[:, surface < self._planes] = 0
        return t, sure & ~np.isnan(s[0]), s

    def _weights(self, rays: Rays, row: Index) -> Vectors:
        """Return e_bc, e_ca, e_ab as in `bounds.py`, divided by their sum; NaN if that is lost."""
        edges = gather(self._edges, row).reshape(3, -1, 3, len(row))
        products, least = edges[:, 0], self._least
        if edges.shape[1] == 1:
            products *= rays.directions
        elif rays.directions.shape[1] == 1:
            products -= rays.origins
            products *= edges[:, 1]
            least = gather(least, row)
        else:
            sides = [cross(corner - rays.origins, side) for corner, side in edges]
            products = np.stack(sides) * rays.directions
            least = _LEAST * (1 + largest(*np.abs(rays.directions)))
        s = products[:, 0] + products[:, 1]
        s += products[:, 2]
        total = s[0] + s[1]
        total += s[2]
        size = np.abs(total)
        known = (size > least) & (size < np.inf)
        s /= total if known.all() else np.where(known, total, np.nan)
        return s


def _edges(rays: Rays, corners: Floats) -> tuple[Floats, Floats]:
    """Return what the edges bc, ca, ab of triangles (3, 3, m) are to all rays: (9 or 18, m).

    And what a sum of edge functions must be above: as often as its last factor, which rays bound,
    may underflow count.
    """
    count = corners.shape[2]
    one_origin, shared = rays.origins.shape[1] == 1, rays.directions.shape[1] == 1
    out = np.empty((3, 1 if one_origin else 2, 3, count))
    for part in parts(count, TOGETHER):
        for k in range(3):
            first = corners[(k + 1) % 3, :, part]
            side = corners[(k + 2) % 3, :, part] - first
            if one_origin:
                cross(first - rays.origins, side, out=out[k, 0, :, part])
                continue
            out[k, 0, :, part] = first
            if shared:
                cross(side, rays.directions, out=out[k, 1, :, part])
            else:
                out[k, 1, :, part] = side
    last = np.abs(rays.directions if one_origin else rays.origins).max()
    if not one_origin:
        last = last + largest(*np.abs(corners).reshape(9, count))
    return out.reshape(9 if one_origin else 18, count), _LEAST * (1 + last)


@dataclass(frozen=True, eq=False)
class Known(Arrays):
    """t and barycentrics, (4, k), of k rays that were found with their surface; `ray` ascends."""

    ray: NDArray[np.int64]
    values: Measures

    @classmethod
    def none(cls) -> Known:
        """Return those of no rays."""
        return cls(np.zeros(0, np.int64), np.zeros((4, 0)))


@dataclass(frozen=True, eq=False)
class Measured:
    """Finds the measures of certified rays of a region when they are asked for.

    Parameters
    ----------
    known : Known
        The measures of rays that integers decided.
    dx, dy : float
        Where each ray passes its pixel's centre, in pixels.
    """

    scene: Scene
    region: Region
    known: Known
    dx: float = 0.0
    dy: float = 0.0

    @sound
    def __call__(self, ray: Index, instance: Names, triangle: Names) -> Measures:
        """Return t, the nearest float64, and the barycentrics of k rays, (4, k).

        Parameters
        ----------
        ray : (k,) int
            Their numbers in the region, row by row.
        instance, triangle : (k,) int
            The surface that each certainly sees.

        Raises
        ------
        AssumptionError
            If this process's arithmetic no longer is as the proof needs it.
        """
        hits = Hits.none(len(ray))
        place = np.searchsorted(self.known.ray, ray)
        given = np.append(self.known.ray, NOTHING)[place] == ray
        hits.values[:, given] = self.known.values[:, place[given]]
        camera = self.scene.camera
        around = corner_rays(camera, self.dx, self.dy)

        def rays_at(index: Index) -> Rays:
            pixel = gather(ray, index)
            return camera_rays(camera, *film_positions(self.region, self.dx, self.dy, pixel))

        rest = np.flatnonzero((instance != NOTHING) & ~given)
        for part in parts(len(rest), PIXELS):
            at = rest[part]
            surfaces, surface = _surfaces(self.scene, gather(instance, at), gather(triangle, at))
            for _ in Prepared(around, surfaces).enter(hits, at, surface, rays_at):
                pass
        return hits.values


def _surfaces(scene: Scene, instance: Names, triangle: Names) -> tuple[Surfaces, Index]:
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
