"""What may be the nearest of each ray: hits, in doubt or not, and the surfaces that they are on.

`Candidates` are pairs of a ray and a surface that the error bounds could not rule out. `Surfaces`
give their names, and the same pairs in integers. `Prepared` surfaces give t and the barycentrics of
rays that surely hit them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..tracer.camera import Rays
from ..tracer.hits import NOTHING, Hits
from ..tracer.vector import Arrays, Floats, Index, Vectors, cross, gather, largest, occurring, parts
from ..tracer.world import WorldTriangles
from . import exact
from .quotient import Quotients

# What is in doubt of a candidate: nothing, the sign of an edge function or of D, the clip range.
SURE, EDGE, CLIP = 0, 1, 2
_LEAST = 2.0**-960  # of the sum of edge functions: far above what gradual underflow may lose
TOGETHER = 1 << 13  # rays at a time: their temporaries stay in a core's cache


@dataclass(frozen=True, eq=False)
class Candidates(Arrays):
    """c hits that may be the nearest of their ray.

    `surface` (c,) says of which of the contest's surfaces; `low` and `high` (c,) enclose t;
    `doubt` (c,) is what is not known.
    """

    ray: Index
    surface: Index
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    doubt: NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Surfaces:
    """Infinite planes, then triangles: what candidates are candidates of.

    `planes` are (point, normal), (3,) each; the first of them has the instance `first_plane`.
    """

    planes: Sequence[tuple[NDArray, NDArray]]
    first_plane: int
    triangles: WorldTriangles

    def only(self, surface: NDArray[np.integer]) -> tuple[Surfaces, Index]:
        """Return all planes, and the triangles among these surfaces, with their numbers there."""
        planes, count = len(self.planes), self.triangles.corners.shape[2]
        which, place = occurring(np.r_[np.arange(planes), surface], planes + count)
        triangles = self.triangles.take(which[planes:] - planes)
        return replace(self, triangles=triangles), place[planes:]

    def names(
        self, surface: NDArray[np.integer] | slice = slice(None)
    ) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle of surfaces, (c,) each; by default of all."""
        count = len(self.planes)
        instance = np.r_[self.first_plane + np.arange(count), self.triangles.instance]
        triangle = np.r_[np.full(count, NOTHING), self.triangles.triangle]
        return instance.astype(np.int32)[surface], triangle.astype(np.int32)[surface]

    def integers(
        self, rays: Rays, ray: Index, surface: Index, start: float = -np.inf, end: float = np.inf
    ) -> tuple[exact.IntegerBatch, list[int], list[int]]:
        """Return rays and surfaces as integers, with where pairs of them, (c,) each, are there."""
        which, ray = np.unique(ray, return_inverse=True)
        some, surface = self.only(surface)
        batch = exact.IntegerBatch(
            rays.take(which), some.triangles.corners, self.planes, start, end
        )
        return batch, ray.tolist(), surface.tolist()


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
        """Enter what rays surely hit first into the hits with these numbers (p,), in small steps.

        Integers divide where t or the barycentrics are not known well.
        """
        (instance, triangle), unsure = self._names, [np.arange(0)]
        for part in parts(len(at), TOGETHER):
            own, of = at[part], surface[part]
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
        batch, *pairs = self._surfaces.integers(rays_at(at), np.arange(len(at)), surface[which])
        found = [batch.hit(*pair) for pair in zip(*pairs, strict=True)]
        hits.t[at] = [batch.t(hit) for hit in found]
        for k in np.flatnonzero(np.isnan(hits.s[0, at])):
            hits.s[:, at[k]] = found[k].weights

    def meet(
        self, rays: Rays, surface: Index
    ) -> tuple[NDArray[np.float64], NDArray[np.bool_], Vectors]:
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


def _edges(rays: Rays, corners: NDArray[np.float64]) -> tuple[NDArray[np.float64], Floats]:
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
