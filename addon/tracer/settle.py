"""Who is nearest among the candidates of each ray, and at which t, correctly rounded.

In come candidates that the bounds could not rule out; out go entries in `Hits`.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from . import exact
from .camera import Rays
from .candidates import WorldTriangles
from .certainty import Certainty
from .hits import NOTHING, Hits
from .reasons import Reason, of_doubts
from .rounding import round_t, triangle_normals
from .vector import Vectors

# What is in doubt of a candidate: nothing, the sign of an edge function or of D, the clip range.
SURE, EDGE, CLIP = 0, 1, 2

_TOGETHER = 1 << 11  # rays that are decided by whole numbers at a time


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

    def numbers(self, rays: Rays, found: Candidates, start: float, end: float) -> Numbers:
        """Return candidates as whole numbers."""
        which, ray = np.unique(found.ray, return_inverse=True)
        planes = len(self.planes)
        used, surface = np.unique(
            np.r_[np.arange(planes), found.surface], return_inverse=True
        )  # every plane stays, so that planes keep their numbers
        some = self.take(used[planes:])
        batch = exact.Batch(rays.take(which), some.triangles.corners, self.planes, start, end)
        return Numbers(batch, planes, ray.tolist(), surface[planes:].tolist())


@dataclass(frozen=True, eq=False)
class Numbers:
    """Candidates as whole numbers."""

    batch: exact.Batch
    planes: int
    ray: list[int]
    surface: list[int]

    def meeting(self, k: int) -> exact.Meeting | None:
        """Return what candidate k truly is."""
        surface = self.surface[k]
        if surface < self.planes:
            return self.batch.plane(self.ray[k], surface)
        return self.batch.triangle(self.ray[k], surface - self.planes)


def by_bound(hits: Hits, rays: Rays, surfaces: Surfaces, found: Candidates) -> None:
    """Enter rays that have one candidate, which surely is a hit: only t has to be rounded."""
    used = np.zeros(len(surfaces.planes) + surfaces.triangles.corners.shape[2], bool)
    used[found.surface] = used[: len(surfaces.planes)] = True
    surface = (np.cumsum(used) - 1)[found.surface]
    some = surfaces.take(np.flatnonzero(used)[len(surfaces.planes) :])
    t, sure = some.round_t(rays.take(found.ray), surface)
    unsure = np.flatnonzero(~sure)
    for part in np.split(unsure, range(_TOGETHER, len(unsure), _TOGETHER)):
        numbers = surfaces.numbers(rays, found.take(part), -np.inf, np.inf)
        t[part] = [numbers.batch.t(numbers.meeting(k)) for k in range(len(part))]
    hits.t[found.ray] = t
    hits.instance[found.ray], hits.triangle[found.ray] = surfaces.name(found.surface)
    ab, bc, ca = found.edges
    whole = ab + bc + ca
    weights = np.stack((bc, ca, ab)) / np.where(whole == 0, 1, whole)  # 0 of a plane
    hits.s[:, found.ray] = weights


def by_ray(found: Candidates) -> Iterator[Candidates]:
    """Split candidates into parts that are a short step each, those of one ray together."""
    found = found.take(np.argsort(found.ray, kind="stable"))
    starts = np.flatnonzero(np.diff(found.ray, prepend=-1))
    for part in np.split(np.arange(len(found.ray)), starts[_TOGETHER::_TOGETHER]):
        if len(part):
            yield found.take(part)


def by_numbers(
    hits: Hits,
    rays: Rays,
    surfaces: Surfaces,
    clip: tuple[float, float],
    found: Candidates,
    reasons: Counter[Reason],
) -> None:
    """Enter rays whose candidates are decided by whole numbers, together.

    Counts why each candidate had to be looked at.
    """
    numbers = surfaces.numbers(rays, found, *clip)
    names = list(zip(*(v.tolist() for v in surfaces.name(found.surface)), strict=True))
    groups: dict[int, list[tuple[int, exact.Meeting | None]]] = {}
    for k, ray in enumerate(found.ray.tolist()):
        groups.setdefault(ray, []).append((k, numbers.meeting(k)))
    first_of: dict[int, exact.Meeting | None] = {}
    for ray, group in groups.items():
        meetings = [(names[k], m) for k, m in group if m]
        seen, ties = exact.nearest(meetings, (NOTHING, NOTHING))
        hits.certainty[ray] = Certainty.AMBIGUOUS if ties else Certainty.EXACT
        if ties:
            hits.ties[ray] = ties
        first = None
        if seen >= 0:
            name, first = meetings[seen]
            hits.t[ray] = numbers.batch.t(first)
            hits.instance[ray], hits.triangle[ray] = name
            if first.edges:
                ab, bc, ca = first.edges
                hits.s[:, ray] = [e / first.towards for e in (bc, ca, ab)]
        first_of[ray] = first
    reasons.update(_reasons(rays, surfaces, found, groups, first_of))


def _reasons(rays: Rays, surfaces: Surfaces, found: Candidates, groups, first_of) -> list[Reason]:
    """Return why candidates were not decided by the bounds, one each."""
    out, unusual = [], []
    for ray, group in groups.items():
        first = first_of[ray]
        for k, m in group:
            if found.doubt[k] == CLIP:
                out.append(Reason.CLIP)
            elif found.doubt[k] == EDGE:
                if m and m.on_edge:
                    out.append(Reason.EDGE)
                elif found.surface[k] < len(surfaces.planes):
                    out.append(Reason.EDGE_ON)
                else:
                    unusual.append(k)
            elif m is not first:  # sure to be hit, but as near as another, for all the bounds know
                same = m and first and exact.compare(m, first) == 0
                out.append(Reason.COPLANAR if same else Reason.CLOSE)
    unusual = np.array(unusual, np.intp)
    corners = surfaces.triangles.corners.take(found.surface[unusual] - len(surfaces.planes), axis=2)
    return out + of_doubts(rays.take(found.ray[unusual]), corners)
