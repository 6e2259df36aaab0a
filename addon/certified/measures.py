"""Finds t, rounded to the nearest float64, and the barycentrics of rays on what they surely see.

Which surface a ray sees is known before. What is found here depends on the ray and its surface
alone, so that it does not matter when it is found, or together with what.

A barycentric is one of the edge functions of `bounds.py`, divided by the sum D of all three: they
are computed as there, and so are off by at most 9 u P. With A above the components of the arms
a - o, S above those of the sides b - a, and d = |d|_1, P is at most 2 A S d; let E = 18 u A S d.
On a surface that is met no two edge functions have opposite signs, so that none is larger than D.
Hence D as computed is off by at most 3.01 E + 2 u D, and each quotient by less than

    4.02 E / |D| + 4 u  <  72.4 u A S d / |D| + 4 u.

Where |D| is above 2^-22 A S d, that is less than `WITHIN`, 2^-24: half of float32's last place
below 1. Everywhere else integers divide, and each barycentric is rounded once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..arrays import Bools, Floats, Index, parts
from ..scene import Region, Scene
from ..tracer.camera import Rays, camera_rays, corner_rays, film_positions
from ..tracer.frame_measures import PIXELS
from ..tracer.hits import NOTHING, Hits, Measures, Names
from ..tracer.vector import Arrays, Vectors, cross, gather, largest
from .arithmetic import sound
from .quotient import Quotients
from .surfaces import Surfaces, surfaces_of

WITHIN = 2.0**-24  # of the exact barycentrics
_SHARE = 2.0**-22  # of A S d: where D is less, too few of its digits are right
_LEAST = 2.0**-960  # of D: far above what gradual underflow may lose
TOGETHER = 1 << 13  # rays at a time: their temporaries stay in a core's cache


class Prepared:
    """Surfaces, prepared for rays that share an origin, a direction, or nothing.

    What belongs to the surfaces alone is computed once, for all rays.
    """

    def __init__(self, rays: Rays, surfaces: Surfaces) -> None:
        corners = surfaces.triangles.corners
        self._surfaces, self._names = surfaces, surfaces.names()
        self._planes = len(surfaces.planes)
        self._one_direction = rays.one_direction
        with np.errstate(all="ignore"):  # what overflows is not sure
            self._quotients = Quotients.of(rays, corners, surfaces.planes)
            self._edges = _edges(rays, corners)

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
        return t, sure & np.isfinite(t) & ~np.isnan(s[0]), s

    def _weights(self, rays: Rays, row: Index) -> Vectors:
        """Return e_bc, e_ca, e_ab as in `bounds.py`, divided by D; NaN if they may be off."""
        table = gather(self._edges, row)
        edges = table[:-1].reshape(3, -1, 3, len(row))
        products, least = edges[:, 0], table[-1]
        if edges.shape[1] == 1:
            products *= rays.directions
        elif self._one_direction:
            products -= rays.origins
            products *= edges[:, 1]
        else:
            products -= rays.origins
            least = _least(products[0], edges[0, 1], edges[1, 1], rays.directions)
            products = np.stack([cross(*each) for each in edges]) * rays.directions
        s = products[:, 0] + products[:, 1]
        s += products[:, 2]
        total = s[0] + s[1]
        total += s[2]
        size = np.abs(total)
        known = (size > least) & (size < np.inf)
        s /= total if known.all() else np.where(known, total, np.nan)
        return s


def _edges(rays: Rays, corners: Floats) -> Floats:
    """Return what the edges bc, ca, ab of triangles (3, 3, m) are to all rays: (10 or 19, m).

    The last row is what |D| must be above.
    """
    count = corners.shape[2]
    columns = 1 if rays.one_origin else 2
    out = np.empty((9 * columns + 1, count))
    edges = out[:-1].reshape(3, columns, 3, count)
    low, high = (end(axis=1, keepdims=True) for end in (rays.origins.min, rays.origins.max))
    along = np.abs(rays.directions).max(axis=1, keepdims=True)
    for part in parts(count, TOGETHER):
        firsts = [corners[k, :, part] for k in (1, 2, 0)]
        sides = [corners[k, :, part] - first for k, first in zip((2, 0, 1), firsts, strict=True)]
        arm = np.maximum(np.abs(firsts[0] - low), np.abs(firsts[0] - high))
        out[-1, part] = _least(arm, sides[0], sides[1], along)
        for own, first, side in zip(edges[..., part], firsts, sides, strict=True):
            if rays.one_origin:
                cross(first - rays.origins, side, out=own[0])
                continue
            own[0] = first
            if rays.one_direction:
                cross(side, rays.directions, out=own[1])
            else:
                own[1] = side
    return out


def _least(arm: Vectors, side: Vectors, other: Vectors, along: Vectors) -> Floats:
    """Return what |D| must be above, given an arm, two of the sides and the direction."""
    span = largest(*np.abs(side)) + largest(*np.abs(other))
    reach = largest(*np.abs(arm)) + span
    x, y, z = np.abs(along)
    length = x + y + z
    return _LEAST * (1 + reach + length) + _SHARE * reach * span * length


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
    """Finds the measures of certified rays of a region on first use.

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
        """Return t, the nearest float64, and the barycentrics, within `WITHIN`, of k rays, (4, k).

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
            surfaces, surface = surfaces_of(self.scene, gather(instance, at), gather(triangle, at))
            for _ in Prepared(around, surfaces).enter(hits, at, surface, rays_at):
                pass
        return hits.values
