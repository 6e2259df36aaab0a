"""Finds each ray's nearest surface with proof, in three steps: each is slower and decides more.

1. **Error bound** (`Ladder.test`, `bounds.py`). A pair of a ray and a surface is dropped if it is a
   miss however the rounding errors fall. Every other one is a candidate, with an interval that
   holds its t. A candidate whose interval begins beyond the end of a certain hit's is dropped, too.
   A ray with one candidate left, which it certainly meets, is decided.
2. **Order of depths** (`Decisions.by_order`, `order.py`). If all candidates of a ray are certain
   hits, only the order of their t is open. For rays with a common origin or direction it is the
   sign of an expression whose coefficients belong to two surfaces: integers find these once, and
   floats with an error bound decide each ray.
3. **Integers** (`Decisions.by_integers`, `exact.py`, `ties.py`). Whatever is still open is decided
   as `definition.py` says.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Bools, Bytes, Floats, Index
from ..certainty import Certainty
from ..tracer.camera import Rays
from ..tracer.hits import Hits, Statistics
from ..tracer.progress import Work
from ..tracer.ties import Ties
from ..tracer.vector import occurring
from ..tracer.world import Pairs, WorldTriangles
from .bounds import Fractions, FromPoint, Parallel, plane_fractions
from .decisions import Decisions
from .reasons import reasons
from .surfaces import CLIP, EDGE, SURE, Candidates, Surfaces

if TYPE_CHECKING:
    from ..scene import Scene

# Candidates that are decided at a time, which takes some ten milliseconds.
BY_ORDER = 1 << 14
BY_INTEGERS = 1 << 11


class Ladder:
    """n rays, and the surfaces that may be the nearest to each so far.

    Parameters
    ----------
    rays : Rays
        n rays in float64, finite.
    surfaces : Surfaces
        The infinite planes; triangles come with the pairs.
    clip : (start, end) float
        Hits with start <= t <= end count, but none at t = 0 where start is 0.
    around : Rays, optional
        Rays with the same common origin or direction as `rays`, whose components span a range that
        contains theirs; by default `rays`. Bounds are computed for these, so that the result for a
        ray does not depend on which others it is traced with.
    """

    def __init__(
        self,
        rays: Rays,
        surfaces: Surfaces | None = None,
        clip: tuple[float, float] = (0.0, np.inf),
        around: Rays | None = None,
    ) -> None:
        self._rays = rays
        self._planes = surfaces or Surfaces()
        self._clip = clip
        self._around = around or rays
        self._farthest = np.full(rays.count, np.inf)  # the nearest hit is not farther than this
        self._found = [Candidates.none()]
        self._surfaces = len(self._planes.planes)
        self._triangles = [WorldTriangles.none()]
        self._batch: WorldTriangles | None = None  # of the last pairs
        self._prepared: FromPoint | Parallel | None = None
        for number, (point, normal) in enumerate(self._planes.planes):
            self._test_plane(number, point[:, None], normal[:, None])

    @classmethod
    def of(cls, scene: Scene, rays: Rays, around: Rays | None = None) -> Ladder:
        """Return one with a scene's planes, in its camera's clip range."""
        clip = scene.camera.clip_start, scene.camera.clip_end
        return cls(rays, Surfaces.planes_of(scene), clip, around)

    def test(self, pairs: Pairs) -> None:
        """Find the candidates among pairs of a ray and a triangle, by the error bound.

        Pairs of one batch of triangles should follow one another: its bounds are kept for the next.
        """
        if pairs.triangles is not self._batch:
            self._batch = pairs.triangles
            self._prepared = self._prepare(pairs.triangles.corners)
        rays, row, prepared = self._rays.take(pairs.pixel), pairs.row, self._prepared
        with np.errstate(all="ignore"):  # what overflows is not known, and goes to integers
            if prepared is None:  # rays that share nothing: a triangle for each pair
                prepared = FromPoint(rays.origins, np.abs(rays.directions), pairs.corners)
                row = np.arange(len(row))
            sure, possible = sides(prepared, row, rays)
            fractions = prepared.fractions(row[possible], rays.take(possible))
            found = self._candidates(pairs.pixel[possible], pairs.row[possible], fractions, sure)
        used, number = occurring(found.surface, len(pairs.triangles))
        self._found.append(replace(found, surface=number + self._surfaces))
        self._triangles.append(pairs.triangles.take(used))
        self._surfaces += len(used)

    def hits(self, statistics: Statistics) -> Work[Hits]:
        """Decide which surface is nearest to each ray, in small steps.

        Counts in the statistics why bounds did not decide.
        """
        hits = Hits.none(self._rays.count, Certainty.BOUND)
        found = Candidates.joined(self._found)
        found = found.take(np.flatnonzero(found.low <= self._farthest[found.ray]))
        if not len(found):
            return hits
        alone = np.bincount(found.ray, minlength=self._rays.count)[found.ray] == 1
        clear = alone & (found.doubt == SURE)
        surfaces = replace(self._planes, triangles=WorldTriangles.joined(self._triangles))
        decisions = Decisions(hits, self._rays, surfaces, self._clip, self._around)
        some = found.take(np.flatnonzero(clear))
        yield from decisions.by_bound(some.ray, some.surface)
        for part in found.take(np.flatnonzero(~clear)).by_ray(BY_ORDER):
            with np.errstate(all="ignore"):
                rest = decisions.by_order(part)
            yield None
            for some in rest.by_ray(BY_INTEGERS):
                with np.errstate(all="ignore"):
                    met, first = decisions.by_integers(some)
                    why = reasons(some, met, first, self._rays, surfaces)
                statistics.reasons += why
                yield None
        hits.ties = Ties.joined(decisions.ties)
        statistics.reasons += decisions.reasons
        return hits

    def _test_plane(self, number: int, point: Floats, normal: Floats) -> None:
        every = np.arange(self._rays.count)
        with np.errstate(all="ignore"):
            fractions = plane_fractions(self._rays, point, normal)
            plane = np.full(len(every), number)
            found = self._candidates(every, plane, fractions, np.ones(len(every), bool))
        self._found.append(found)

    def _prepare(self, corners: Floats) -> FromPoint | Parallel | None:
        """Return the part of the edge test of triangles (3, 3, m) that all rays share, if any."""
        o, d = self._around.origins, self._around.directions
        with np.errstate(all="ignore"):
            if self._around.one_origin:
                return FromPoint(o, np.abs(d).max(axis=1, keepdims=True), corners)
            if self._around.one_direction:
                ends = o.min(axis=1, keepdims=True), o.max(axis=1, keepdims=True)
                return Parallel(d, *ends, corners)
        return None

    def _candidates(
        self, ray: Index, surface: Index, fractions: Fractions, sure: Bools
    ) -> Candidates:
        """Return the candidates: what may be in the clip range and not behind a certain hit."""
        low, high, outside, doubt = in_range(fractions, sure, *self._clip)
        certain = np.flatnonzero(doubt == SURE)
        np.minimum.at(self._farthest, ray[certain], high[certain])
        keep = np.flatnonzero(~outside & (low <= self._farthest[ray]))
        return Candidates(ray, surface, low, high, doubt).take(keep)


def sides(prepared: FromPoint | Parallel, row: Index, rays: Rays) -> tuple[Bools, Index]:
    """Return which pairs may pass inside the triangle, after whether each of these surely does."""
    edges, error = prepared.edges(row, rays)
    low, high = edges.min(axis=0), edges.max(axis=0)
    possible = np.flatnonzero(~((low < -error) & (high > error)))
    sure = ((low > error) | (high < -error))[possible]
    return sure, possible


def in_range(
    fractions: Fractions, sure: Bools, start: float, end: float
) -> tuple[Floats, Floats, Bools, Bytes]:
    """Return the ends of each t's interval, whether it certainly is clipped, and the doubt.

    The doubt is SURE, CLIP, or EDGE where an edge function or D leaves one.
    """
    low, high = fractions.interval()
    inside = (low > start) & (high < end)
    doubt = np.where(sure & np.isfinite(high), np.where(inside, SURE, CLIP), EDGE).astype(np.uint8)
    outside = (high < start) | (low > end)
    if start < 0:  # where D is in doubt, the interval leaves out what is behind the origin
        outside &= np.isfinite(high)
        low = np.where(np.isfinite(high), low, -np.inf)
    return low, high, outside, doubt
