"""t and the barycentrics of rays with the surfaces that they surely hit.

What belongs to the surfaces alone is computed once, for all rays.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..camera import Rays
from ..hits import Hits
from ..vector import Vectors, cross, dot, gather, in_parts
from .quotient import Quotients
from .surfaces import Surfaces

TOGETHER = 1 << 13  # rays at a time: their temporaries stay in a core's cache


class Prepared:
    """Surfaces, prepared for rays that share an origin, a direction, or nothing."""

    def __init__(self, rays: Rays, surfaces: Surfaces) -> None:
        corners = surfaces.triangles.corners
        self._surfaces, self._names = surfaces, surfaces.name()
        self._unsure: list[tuple[NDArray, NDArray]] = []
        self._planes = len(surfaces.planes)
        with np.errstate(all="ignore"):  # what overflows is not sure
            self._quotients = Quotients.of(rays, corners, surfaces.planes)
            self._edges = in_parts(
                lambda part: _edges(rays, corners[..., part]), corners.shape[2], TOGETHER
            )

    def enter(
        self, hits: Hits, at: NDArray[np.intp], rays: Rays, surface: NDArray[np.intp]
    ) -> None:
        """Enter what rays (p,) surely hit first into the hits with these numbers."""
        with np.errstate(all="ignore"):  # what overflows is not sure
            t, sure, s = self.meet(rays, surface)
        if not sure.all():
            unsure = np.flatnonzero(~sure)
            self._unsure.append((at[unsure], surface[unsure]))
        hits.t[at] = t
        for component, value in zip(hits.s, s, strict=True):
            component[at] = value
        instance, triangle = self._names
        hits.instance[at], hits.triangle[at] = instance.take(surface), triangle.take(surface)

    def finish(self, hits: Hits, rays_at: Callable[[NDArray[np.intp]], Rays]) -> None:
        """Enter the t that could not be rounded for sure: whole numbers divide."""
        if not self._unsure:
            return
        at, surface = map(np.concatenate, zip(*self._unsure, strict=True))
        numbers = self._surfaces.numbers(rays_at(at), np.arange(len(at)), surface)
        hits.t[at] = [numbers.batch.t(numbers.meeting(k)) for k in range(len(at))]
        self._unsure = []

    def meet(
        self, rays: Rays, surface: NDArray[np.intp]
    ) -> tuple[NDArray[np.float64], NDArray[np.bool_], Vectors]:
        """Return t of p rays, whether it surely is rounded correctly, and the barycentrics."""
        t, sure = self._quotients.meet(rays, surface)
        row = np.maximum(surface - self._planes, 0) if self._planes else surface
        s = self._weights(rays, row) if len(self._edges.T) else np.zeros((3, len(surface)))
        if self._planes:
            s[:, surface < self._planes] = 0
        return t, sure, s

    def _weights(self, rays: Rays, row: NDArray[np.intp]) -> Vectors:
        """Return e_bc, e_ca, e_ab as in `bounds.py`, divided by their sum."""
        edges = gather(self._edges, row).reshape(3, -1, 3, len(row))
        if len(edges[0]) == 1:
            of_each = [dot(normal, rays.directions) for (normal,) in edges]
        elif rays.directions.shape[1] == 1:
            of_each = [dot(corner - rays.origins, normal) for corner, normal in edges]
        else:
            of_each = [
                dot(rays.directions, cross(corner - rays.origins, side)) for corner, side in edges
            ]
        s = np.stack(of_each)
        s /= s[0] + s[1] + s[2]
        return s


def _edges(rays: Rays, corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what the edges bc, ca, ab of triangles (3, 3, m) are to all rays: (9 or 18, m)."""
    out = []
    for k in (1, 2, 0):
        corner, side = corners[k], corners[(k + 1) % 3] - corners[k]
        if rays.origins.shape[1] == 1:
            out.append(cross(corner - rays.origins, side))
        else:
            shared = rays.directions.shape[1] == 1
            out += [corner, cross(side, rays.directions) if shared else side]
    return np.concatenate(out)
