"""t and the barycentrics of rays with the surfaces that they surely hit.

What belongs to the surfaces alone is computed once, for all rays.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from .camera import Rays
from .hits import Hits
from .rivals import Surfaces
from .rounding import Quotients
from .vector import Vectors, cross, dot

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
            self._arms = self._normals = None
            edges = [(corners[k], corners[(k + 1) % 3]) for k in (1, 2, 0)]
            if rays.origins.shape[1] == 1:
                normals = [cross(p - rays.origins, q - p) for p, q in edges]
                self._normals = np.concatenate(normals)
            else:
                self._arms = np.concatenate([p for p, _ in edges])
                if rays.directions.shape[1] == 1:
                    normals = [cross(q - p, rays.directions) for p, q in edges]
                    self._normals = np.concatenate(normals)
                else:
                    self._sides = np.concatenate([q - p for p, q in edges])

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
        if self._planes == len(surface) == 0 or self._of_planes(surface):
            return t, sure, np.zeros((3, len(surface)))
        s = self._edges(rays, row)
        s /= s[0] + s[1] + s[2]
        if self._planes:
            s[:, surface < self._planes] = 0
        return t, sure, s

    def _of_planes(self, surface: NDArray[np.intp]) -> bool:
        return bool((surface < self._planes).all())

    def _edges(self, rays: Rays, row: NDArray[np.intp]) -> Vectors:
        """Return e_bc, e_ca, e_ab as in `bounds.py`."""
        out = np.empty((3, len(row)))
        d = rays.directions
        if self._arms is None:
            n = self._normals.take(row, axis=1)
            for k in range(3):
                out[k] = dot(n[3 * k : 3 * k + 3], d)
            return out
        arms = self._arms.take(row, axis=1)
        if self._normals is not None:
            n = self._normals.take(row, axis=1)
            for k in range(3):
                out[k] = dot(arms[3 * k : 3 * k + 3] - rays.origins, n[3 * k : 3 * k + 3])
            return out
        sides = self._sides.take(row, axis=1)
        for k in range(3):
            part = slice(3 * k, 3 * k + 3)
            out[k] = dot(d, cross(arms[part] - rays.origins, sides[part]))
        return out
