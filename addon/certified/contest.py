"""The nearest hit of every ray, proven: by the bounds where they decide, else by integers.

In come rays, and the pairs to be tested; out go `Hits` with the `Certainty` of each. A pair that
the bounds rule out is done with. What may be a hit has an interval for its t, and only what could
be the nearest is kept. At the end a ray whose one candidate surely is a hit is decided; the
candidates of all others are settled together (`settle.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..certainty import Certainty
from ..tracer.camera import Rays
from ..tracer.candidates import Pairs
from ..tracer.hits import Hits, Statistics, Ties
from ..tracer.progress import Work
from ..tracer.vector import occurring
from ..tracer.world import WorldTriangles
from .bounds import Fractions, FromPoint, Parallel, plane_fractions
from .settle import BY_INTEGERS, BY_ORDER, Decisions, by_ray
from .surfaces import CLIP, EDGE, SURE, Candidates, Surfaces

if TYPE_CHECKING:
    from ..scene import Scene


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
    room : float
        How far beside these rays, by component, what is said of planes holds, too.
    """

    def __init__(
        self,
        rays: Rays,
        planes: Sequence[tuple[NDArray, NDArray]] = (),
        first_plane: int = 0,
        start: float = 0.0,
        end: float = np.inf,
        around: Rays | None = None,
        room: float = 0,
    ) -> None:
        self._rays, self._planes, self._clip = rays, planes, (start, end)
        self._around = around or rays
        self._count = max(rays.origins.shape[1], rays.directions.shape[1])
        self._farthest = np.full(self._count, np.inf)  # the nearest hit is not farther than this
        self._first_plane = first_plane
        none = np.zeros((2, 0))
        self._possible = [Candidates(*none.astype(np.intp), *none, np.zeros(0, np.uint8))]
        self._surfaces = len(planes)
        self._triangles: list[WorldTriangles] = [WorldTriangles.none()]
        self._batch: WorldTriangles | None = None  # of the last pairs
        every = np.arange(self._count)
        for k, (point, normal) in enumerate(planes):
            with np.errstate(all="ignore"):
                fractions = plane_fractions(rays, point[:, None], normal[:, None])
                for error in (fractions.numerator_error, fractions.denominator_error):
                    error += room * np.abs(normal).sum()
                sure = np.ones(self._count, bool)
                found = self._candidates(every, np.full(self._count, k), fractions, sure)
            self._possible.append(found)

    @classmethod
    def of(cls, scene: Scene, rays: Rays, around: Rays | None = None, room: float = 0) -> Contest:
        """Return one with a scene's planes, in its camera's clip range."""
        planes, camera = [(p.point, p.normal) for p in scene.planes], scene.camera
        clip = camera.clip_start, camera.clip_end
        return cls(rays, planes, len(scene.instances), *clip, around, room)

    def enter(self, some: Pairs) -> None:
        """Test pairs of a ray and a triangle; those of one batch follow one another."""
        if some.triangles is not self._batch:
            self._batch, self._prepared = some.triangles, self._prepare(some.triangles.corners)
        rays, row = self._rays.take(some.pixel), some.row
        with np.errstate(all="ignore"):  # what overflows is not known, and goes to integers
            prepared = self._prepared
            if prepared is None:  # rays that share nothing: each pair by itself
                prepared = FromPoint(rays.origins, np.abs(rays.directions), some.corners)
                row = np.arange(len(row))
            sure, possible = sides(prepared, row, rays)
            fractions = prepared.fractions(row[possible], rays.take(possible))
            found = self._candidates(some.pixel[possible], some.row[possible], fractions, sure)
        used, number = occurring(found.surface, len(some.triangles))
        self._possible.append(replace(found, surface=number + self._surfaces))
        self._triangles.append(some.triangles.take(used))
        self._surfaces += len(used)

    def hits(self, statistics: Statistics) -> Work[Hits]:
        """Decide who is nearest, in small steps that all yield 1.

        Counts in the statistics what integers were asked for.
        """
        hits = Hits.none(self._count, Certainty.BOUND)
        found, clear, surfaces = self.left()
        if not len(found):
            return hits
        decisions = Decisions(
            hits, self._rays, surfaces, self._clip, self._around, statistics.reasons
        )
        some = found.take(np.flatnonzero(clear))
        for _ in decisions.by_bound(some.ray, some.surface):
            yield 1.0
        for part in by_ray(found.take(np.flatnonzero(~clear)), BY_ORDER):
            with np.errstate(all="ignore"):
                rest = decisions.by_order(part)
            yield 1.0
            for some in by_ray(rest, BY_INTEGERS):
                with np.errstate(all="ignore"):
                    decisions.by_integers(some)
                yield 1.0
        hits.ties = Ties.joined(decisions.ties)
        return hits

    def left(self) -> tuple[Candidates, NDArray[np.bool_], Surfaces]:
        """Return what may be nearest, which of it surely is, and of which surfaces it is."""
        found = Candidates.joined(self._possible)
        found = found.take(np.flatnonzero(found.low <= self._farthest[found.ray]))
        alone = np.bincount(found.ray, minlength=self._count)[found.ray] == 1
        triangles = WorldTriangles.joined(self._triangles)
        surfaces = Surfaces(self._planes, self._first_plane, triangles)
        return found, alone & (found.doubt == SURE), surfaces

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

    def _candidates(self, ray, surface, fractions: Fractions, sure) -> Candidates:
        """Return what may be in the clip range, and not behind what surely is."""
        low, high, outside, doubt = in_range(fractions, sure, *self._clip)
        certain = np.flatnonzero(doubt == SURE)
        np.minimum.at(self._farthest, ray[certain], high[certain])
        keep = np.flatnonzero(~outside & (low <= self._farthest[ray]))
        return Candidates(ray, surface, low, high, doubt).take(keep)


def sides(prepared: FromPoint | Parallel, row: NDArray, rays: Rays):
    """Return which of the pairs that may be hits surely are, and which pairs may be."""
    edges, error = prepared.edges(row, rays)
    low, high = edges.min(axis=0), edges.max(axis=0)
    possible = np.flatnonzero(~((low < -error) & (high > error)))
    sure = ((low > error) | (high < -error))[possible]
    return sure, possible


def in_range(fractions: Fractions, sure: NDArray[np.bool_], start: float, end: float):
    """Return the ends of each t's interval, whether it surely is clipped, and what is in doubt."""
    low, high = fractions.interval()
    inside = (low > start) & (high < end)
    doubt = np.where(sure & np.isfinite(high), np.where(inside, SURE, CLIP), EDGE).astype(np.uint8)
    outside = (high < start) | (low > end)
    if start < 0:  # the interval leaves out what is behind the origin
        outside &= np.isfinite(high)
        low = np.where(np.isfinite(high), low, -np.inf)
    return low, high, outside, doubt
