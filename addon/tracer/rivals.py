"""What may be the nearest of each ray: hits, in doubt or not, and the surfaces that they are on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from . import exact
from .camera import Rays
from .candidates import WorldTriangles
from .hits import NOTHING
from .rounding import round_t, triangle_normals
from .vector import Vectors

# What is in doubt of a candidate: nothing, the sign of an edge function or of D, the clip range.
SURE, EDGE, CLIP = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Candidates:
    """c hits that may be the nearest of their ray.

    `surface` (c,) says of which of the contest's surfaces; `low` and `high` (c,) enclose t;
    `edges` (3, c) are e_ab, e_bc, e_ca; `doubt` (c,) is what is not known.
    """

    ray: NDArray[np.intp]
    surface: NDArray[np.intp]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    edges: Vectors
    doubt: NDArray[np.uint8]

    def take(self, index: NDArray) -> Candidates:
        """Return those at `index`."""
        return Candidates(*(v[..., index] for v in vars(self).values()))

    @staticmethod
    def joined(parts: Sequence[Candidates]) -> Candidates:
        """Return them all as one."""
        fields = zip(*(vars(part).values() for part in parts), strict=True)
        return Candidates(*(np.concatenate(f, axis=-1) for f in fields))


@dataclass(frozen=True, eq=False)
class Surfaces:
    """Infinite planes, then triangles: what candidates are candidates of.

    `planes` are (point, normal), (3,) each; the first of them has the instance `first_plane`.
    """

    planes: Sequence[tuple[NDArray, NDArray]]
    first_plane: int
    triangles: WorldTriangles

    def take(self, index: NDArray[np.integer]) -> Surfaces:
        """Return all planes, and of the triangles those at `index` (which counts planes)."""
        return replace(self, triangles=self.triangles.take(index - len(self.planes)))

    def name(self, surface: NDArray[np.integer]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle of surfaces, (c,) each."""
        count = len(self.planes)
        instance = np.r_[self.first_plane + np.arange(count), self.triangles.instance]
        triangle = np.r_[np.full(count, NOTHING), self.triangles.triangle]
        return instance[surface].astype(np.int32), triangle[surface].astype(np.int32)

    def round_t(self, rays: Rays, surface: NDArray) -> tuple[NDArray, NDArray[np.bool_]]:
        """Return t of p rays with these surfaces, and whether it surely is rounded correctly."""
        corners = self.triangles.corners
        (high, low), size = triangle_normals(corners)
        if self.planes:
            points, normals = (np.array(v, np.float64).T for v in zip(*self.planes, strict=True))
            high, low = np.hstack((normals, high)), np.hstack((np.zeros_like(normals), low))
            return round_t(
                rays,
                surface,
                np.hstack((points, corners[0])),
                (high, low),
                np.hstack((np.abs(normals), size)),
            )
        return round_t(rays, surface, corners[0], (high, low), size)

    def numbers(
        self, rays: Rays, found: Candidates, start: float = -np.inf, end: float = np.inf
    ) -> Numbers:
        """Return candidates as whole numbers."""
        which, ray = np.unique(found.ray, return_inverse=True)
        planes = len(self.planes)
        used, surface = np.unique(
            np.r_[np.arange(planes), found.surface], return_inverse=True
        )  # every plane stays, so that planes keep their numbers
        some = self.take(used[planes:])
        batch = exact.Batch(rays.take(which), some.triangles.corners, self.planes, start, end)
        return Numbers(batch, ray.tolist(), surface[planes:].tolist())


@dataclass(frozen=True, eq=False)
class Numbers:
    """Candidates as whole numbers."""

    batch: exact.Batch
    ray: list[int]
    surface: list[int]

    def meeting(self, k: int) -> exact.Meeting | None:
        """Return what candidate k truly is."""
        return self.batch.meeting(self.ray[k], self.surface[k])
