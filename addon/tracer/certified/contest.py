"""The nearest hit of every ray, proven: by the bounds where they decide, else by whole numbers.

In come rays, and the pairs to be tested; out go `Hits` with the `Certainty` of each. A pair that
the bounds rule out is done with. What may be a hit has an interval for its t, and only what could
be the nearest is kept. At the end a ray whose one candidate surely is a hit is decided; the
candidates of all others go to whole numbers together (`settle.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..camera import Rays
from ..candidates import Pairs
from ..hits import Hits, Statistics
from ..progress import Work, result_of
from ..world import WorldTriangles
from . import exact
from .bounds import Depths, FromPoint, Parallel, plane_depths
from .certainty import Certainty
from .settle import by_bound, by_numbers, by_order, by_ray
from .surfaces import CLIP, EDGE, SURE, Candidates, Surfaces

_PAIRS = 1 << 15  # that `nearest` tests at a time


class Contest:
    """n rays, and what may be the nearest to each so far.

    Parameters
    ----------
    rays : Rays
        n rays in float64, finite.
    planes : sequence of ((3,), (3,)) float64
        Point and normal of each infinite plane.
    first_plane : int
        The instance that the first of them is called.
    start, end : float
        The clip range: hits with start <= t <= end are seen, but none at t = 0 where start is 0.
    around : Rays, optional
        Rays that share what these share, and whose components enclose those of these, which are
        the default. Bounds for all rays at once are bounds for them: so what becomes of a ray does
        not depend on which others are in the contest.
    """

    def __init__(
        self,
        rays: Rays,
        planes: Sequence[tuple[NDArray, NDArray]] = (),
        first_plane: int = 0,
        start: float = 0.0,
        end: float = np.inf,
        around: Rays | None = None,
    ) -> None:
        self._rays, self._planes, self._clip = rays, planes, (start, end)
        self._around = around or rays
        self._count = max(rays.origins.shape[1], rays.directions.shape[1])
        self._farthest = np.full(self._count, np.inf)  # the nearest hit is not farther than this
        self._first_plane = first_plane
        self._kept: list[Candidates] = []  # of all but the current batch
        self._surfaces = len(planes)
        self._triangles: list[WorldTriangles] = [WorldTriangles.none()]
        self._batch: WorldTriangles | None = None
        self._of_batch: list[Candidates] = []
        every = np.arange(self._count)
        for k, (point, normal) in enumerate(planes):
            with np.errstate(all="ignore"):
                depths = plane_depths(rays, point[:, None], normal[:, None])
                sure = np.ones(self._count, bool)
                found = self._possible(every, np.full(self._count, k), depths, sure)
            self._kept.append(found)

    def enter(self, some: Pairs) -> None:
        """Test pairs of a ray and a triangle; those of one batch follow one another."""
        if some.triangles is not self._batch:
            self._end_batch()
            self._batch, self._prepared = some.triangles, self._prepare(some.triangles.corners)
        rays, row = self._rays.take(some.pixel), some.row
        with np.errstate(all="ignore"):  # what overflows is not known, and goes to whole numbers
            prepared = self._prepared
            if prepared is None:  # rays that share nothing: each pair by itself
                prepared = FromPoint(rays.origins, np.abs(rays.directions), some.corners)
                row = np.arange(len(row))
            sure, possible = _sides(prepared, row, rays)
            depths = prepared.depths(row[possible], rays.take(possible))
            found = self._possible(some.pixel[possible], some.row[possible], depths, sure)
        self._of_batch.append(found)

    def hits(self, statistics: Statistics) -> Work[Hits]:
        """Decide who is nearest, in small steps that all yield 1.

        Counts in the statistics what whole numbers were asked for.
        """
        self._end_batch()
        hits = Hits.none(self._count, Certainty.BOUND)
        if not self._kept:
            return hits
        found = Candidates.joined(self._kept)
        found = found.take(np.flatnonzero(found.low <= self._farthest[found.ray]))
        alone = np.bincount(found.ray, minlength=self._count)[found.ray] == 1
        clear = alone & (found.doubt == SURE)
        triangles = WorldTriangles.joined(self._triangles)
        surfaces = Surfaces(self._planes, self._first_plane, triangles)
        some = found.take(np.flatnonzero(clear))
        for _ in by_bound(hits, self._rays, surfaces, some.ray, some.surface, self._around):
            yield 1.0
        rest = found.take(np.flatnonzero(~clear))
        with np.errstate(all="ignore"):
            rest = by_order(
                hits, self._rays, surfaces, self._clip, rest, statistics.reasons, self._around
            )
        for part in by_ray(rest):
            yield 1.0
            with np.errstate(all="ignore"):
                by_numbers(hits, self._rays, surfaces, self._clip, part, statistics.reasons)
        return hits

    def _prepare(self, corners: NDArray[np.float64]) -> FromPoint | Parallel | None:
        """Return what of triangles (3, 3, m) is the same for all the rays; None if nothing is."""
        o, d = self._around.origins, self._around.directions
        with np.errstate(all="ignore"):
            if o.shape[1] == 1:
                return FromPoint(o, np.abs(d).max(axis=1, keepdims=True), corners)
            if d.shape[1] == 1:
                ends = o.min(axis=1, keepdims=True), o.max(axis=1, keepdims=True)
                return Parallel(d, *ends, corners)
        return None

    def _possible(self, ray, surface, depths: Depths, sure) -> Candidates:
        """Return what may be in the clip range, and not behind what surely is."""
        low, high, outside, doubt = _in_range(depths, sure, *self._clip)
        certain = np.flatnonzero(doubt == SURE)
        np.minimum.at(self._farthest, ray[certain], high[certain])
        keep = np.flatnonzero(~outside & (low <= self._farthest[ray]))
        return Candidates(ray, surface, low, high, doubt).take(keep)

    def _end_batch(self) -> None:
        """Keep of the current batch only the triangles that candidates are left of."""
        if self._of_batch:
            found = Candidates.joined(self._of_batch)
            used, number = np.unique(found.surface, return_inverse=True)
            self._kept.append(replace(found, surface=number + self._surfaces))
            self._triangles.append(self._batch.take(used))
            self._surfaces += len(used)
        self._of_batch, self._batch = [], None


@dataclass(frozen=True, eq=False)
class Decision:
    """What n rays make of n triangles, pair by pair: (n,) bool each."""

    hit: NDArray[np.bool_]  # the ray, moved infinitesimally by the rule, meets it in the clip range
    edge: NDArray[np.bool_]  # the ray as it is meets its edge or corner exactly
    exact: NDArray[np.bool_]  # whole numbers decided


def decide(
    rays: Rays, corners: NDArray[np.float64], start: float = 0.0, end: float = np.inf
) -> Decision:
    """Decide pairs of a ray and a triangle, each by itself.

    Parameters
    ----------
    rays : Rays
        n rays, finite, float64.
    corners : (3, 3, n) float64
        Corner, component, triangle; finite, in world space.
    start, end : float
        As of a `Contest`.
    """
    hit, edge, undecided = (np.zeros(corners.shape[2], bool) for _ in range(3))
    every = np.arange(corners.shape[2])
    with np.errstate(all="ignore"):  # what overflows is not known, and goes to whole numbers
        prepared = FromPoint(rays.origins, np.abs(rays.directions), corners)
        sure, possible = _sides(prepared, every, rays)
        depths = prepared.depths(possible, rays.take(possible))
        _, _, outside, doubt = _in_range(depths, sure, start, end)
    hit[possible] = ~outside & (doubt == SURE)
    undecided[possible] = ~outside & (doubt != SURE)
    for part in np.split(np.flatnonzero(undecided), range(4096, len(every), 4096)):
        batch = exact.Batch(rays.take(part), corners.take(part, axis=2), (), start, end)
        for k, pair in enumerate(part.tolist()):
            meeting = batch.meeting(k, k)
            if meeting:
                hit[pair], edge[pair] = meeting.is_hit(), meeting.on_edge
    return Decision(hit, edge, undecided)


def nearest(
    rays: Rays, corners: NDArray[np.float64], start: float = 0.0, end: float = np.inf
) -> Hits:
    """Return what n rays see of m triangles (3, 3, m), each ray tested with each triangle.

    Parameters are as of :func:`decide`. A hit has the instance 0, and the number of its triangle.
    """
    count = corners.shape[2]
    triangles = WorldTriangles(corners, np.zeros(count, np.int32), np.arange(count, dtype=np.int32))
    contest = Contest(rays, (), 0, start, end)
    n = max(rays.origins.shape[1], rays.directions.shape[1])
    together = max(1, _PAIRS // max(count, 1))
    for first in range(0, n, together):
        ray, row = np.divmod(np.arange(first * count, min(first + together, n) * count), count)
        contest.enter(Pairs(ray, row, triangles))
    return result_of(contest.hits(Statistics()))


def _sides(prepared: FromPoint | Parallel, row: NDArray, rays: Rays):
    """Return which of the pairs that may be hits surely are, and which pairs may be."""
    edges, error = prepared.edges(row, rays)
    low, high = edges.min(axis=0), edges.max(axis=0)
    possible = np.flatnonzero(~((low < -error) & (high > error)))
    sure = ((low > error) | (high < -error))[possible]
    return sure, possible


def _in_range(depths: Depths, sure: NDArray[np.bool_], start: float, end: float):
    """Return the ends of each t's interval, whether it surely is clipped, and what is in doubt."""
    low, high = depths.interval()
    inside = (low > start) & (high < end)
    doubt = np.where(sure & np.isfinite(high), np.where(inside, SURE, CLIP), EDGE).astype(np.uint8)
    outside = (high < start) | (low > end)
    if start < 0:  # the interval leaves out what is behind the origin
        outside &= np.isfinite(high)
        low = np.where(np.isfinite(high), low, -np.inf)
    return low, high, outside, doubt
