"""What may be the nearest of each ray: hits, in doubt or not, and the surfaces that they are on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..camera import Rays
from ..hits import NOTHING
from ..world import WorldTriangles
from . import exact

# What is in doubt of a candidate: nothing, the sign of an edge function or of D, the clip range.
SURE, EDGE, CLIP = 0, 1, 2


@dataclass(frozen=True, eq=False)
class Candidates:
    """c hits that may be the nearest of their ray.

    `surface` (c,) says of which of the contest's surfaces; `low` and `high` (c,) enclose t;
    `doubt` (c,) is what is not known.
    """

    ray: NDArray[np.intp]
    surface: NDArray[np.intp]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
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

    def only(self, surface: NDArray[np.integer]) -> tuple[Surfaces, NDArray[np.intp]]:
        """Return all planes, and the triangles among these surfaces, with their numbers there."""
        planes, count = len(self.planes), self.triangles.corners.shape[2]
        occurs = np.zeros(planes + count, bool)
        occurs[surface] = occurs[:planes] = True
        return self.take(np.flatnonzero(occurs)[planes:]), (np.cumsum(occurs) - 1)[surface]

    def name(self) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle of every surface."""
        count = len(self.planes)
        instance = np.r_[self.first_plane + np.arange(count), self.triangles.instance]
        triangle = np.r_[np.full(count, NOTHING), self.triangles.triangle]
        return instance.astype(np.int32), triangle.astype(np.int32)

    def names(self, surface: NDArray[np.integer]) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle of surfaces, (c,) each."""
        instance, triangle = self.name()
        return instance[surface], triangle[surface]

    def numbers(
        self,
        rays: Rays,
        ray: NDArray[np.intp],
        surface: NDArray[np.intp],
        start: float = -np.inf,
        end: float = np.inf,
    ) -> Numbers:
        """Return pairs of a ray and a surface, (c,) each, as whole numbers."""
        which, ray = np.unique(ray, return_inverse=True)
        planes = len(self.planes)
        used, surface = np.unique(
            np.r_[np.arange(planes), surface], return_inverse=True
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
