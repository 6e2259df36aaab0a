"""Resolves the pixels of a swept region: decides which surface each of them sees.

A pixel whose winner has no fragment that may be nearer is decided. The rays of the others are
tested again by a `Ladder`, with all surfaces that they may see.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Bools, Index, groups, parts
from ...certainty import Certainty
from ...scene import Scene
from ...tracer.camera import camera_rays, corner_rays, film_positions
from ...tracer.frame_measures import PIXELS
from ...tracer.hits import NOTHING, Hits, Statistics
from ...tracer.progress import Work
from ...tracer.ties import Ties
from ...tracer.vector import gather, grouped
from ...tracer.world import Pairs, WorldTriangles, world_corners
from ..ladder import Ladder
from ..measures import Known, Measured
from .chunks import Numbering
from .depth_buffer import DepthBuffer, Fragments
from .film import Film

_PAIRS = 1 << 15  # pairs that a ladder tests at a time
_FRAGMENTS = 1 << 17  # fragments tested together: a step of some milliseconds
_RAYS = 1 << 14  # rays of a ladder, at most
_CANDIDATES = 1 << 15  # candidates of a ladder, at most


@dataclass(frozen=True, eq=False)
class Resolver:
    """The end of a sweep: its depth buffer, and the numbers of its surfaces."""

    scene: Scene
    film: Film
    depths: DepthBuffer
    numbers: Numbering
    statistics: Statistics

    def steps(self, fragments: list[Fragments]) -> Work[Hits]:
        """Decide every pixel, in small steps; empties `fragments`."""
        region = self.depths.region
        count = region.width * region.height
        instance, triangle = np.full((2, count), NOTHING, np.int32)
        certainty = np.full(count, Certainty.BOUND, np.uint8)
        yield None
        open_ = np.zeros(count, bool)
        pairs = []
        # Fragments are freed as soon as they are tested.
        every = (fragments.pop(0) for _ in range(len(fragments)))
        for some in Fragments.together(every, _FRAGMENTS):
            some = some.take(self.depths.not_hidden(some))
            pixel = self.depths.pixels(some.pixel)
            open_[pixel] = True
            pairs.append((pixel, some.surface))
            yield None
        winners = self.depths.winners
        for part in parts(count, PIXELS):
            own = winners[part]
            is_open = open_[part]
            decided = np.flatnonzero((own != NOTHING) & ~is_open)
            names = self.numbers.names_of(gather(own, decided))
            instance[part.start + decided] = names[0]
            triangle[part.start + decided] = names[1]
            beside = np.flatnonzero((own != NOTHING) & is_open)
            pairs.append((part.start + beside, gather(own, beside)))
            yield None
        measured = Measured(self.scene, region, Known.none(), self.film.dx, self.film.dy)
        out = Hits(instance, triangle, certainty, measured)
        known = yield from self._enter_open(out, open_, pairs)
        out.measures = replace(measured, known=known)
        return out

    def _enter_open(
        self, hits: Hits, open_: Bools, pairs: list[tuple[Index, Index]]
    ) -> Work[Known]:
        """Decide the `open_` pixels, some at a time: they may see several surfaces, or none.

        `pairs` are these pixels and their surfaces; empties the list.
        """
        every = np.flatnonzero(open_)
        amount = np.zeros(len(open_), np.int32)
        for pixel, _ in pairs:
            np.add.at(amount, pixel, 1)
            yield None
        ends = list(groups(amount[every] + _CANDIDATES // _RAYS, _CANDIDATES))
        starts = every[[first for first, _ in ends]]
        together: list[list[tuple[Index, Index]]] = [[] for _ in ends]
        while pairs and ends:
            pixel, surface = pairs.pop()
            group = (np.searchsorted(starts, pixel, side="right") - 1).astype(np.uint16)
            for members, own in zip(together, grouped(group, len(ends)), strict=True):
                if len(own):
                    members.append((pixel[own], surface[own]))
            yield None
        ties = []
        known = [Known.none()]
        for (first, last), members in zip(ends, together, strict=True):
            which = every[first:last]
            pixel, surface = map(np.concatenate, zip(*members, strict=True))
            members.clear()
            ray = np.searchsorted(which, pixel)
            found = yield from self._decide(which, ray, surface)
            hits.instance[which] = found.instance
            hits.triangle[which] = found.triangle
            hits.certainty[which] = found.certainty
            ties.append(found.ties.numbered(which))
            known.append(Known(which, found.values))
        hits.ties = Ties.joined(ties)
        return Known.joined(known)

    def _decide(self, pixel: Index, ray: Index, surface: Index) -> Work[Hits]:
        """Decide the rays of pixels (n,), given all pairs of one of them and a surface, (p,)."""
        scene = self.scene
        film = self.film
        at = film_positions(self.depths.region, film.dx, film.dy, pixel)
        on_mesh = np.flatnonzero(surface >= len(scene.planes))  # a ladder has all planes anyway
        ray = ray[on_mesh]
        surface, row = np.unique(surface[on_mesh], return_inverse=True)
        around = corner_rays(film.camera, film.dx, film.dy)
        ladder = Ladder.of(scene, camera_rays(film.camera, *at), around)
        names = self.numbers.names_of(surface)
        triangles = WorldTriangles(world_corners(scene, *names), *names)
        # Sort by ray, and drop duplicates: a triangle of unknown orientation was set up twice.
        key = np.sort(ray * len(surface) + row)  # faster than `np.unique`
        key = key[np.flatnonzero(np.diff(key, prepend=-1))]
        ray, row = np.divmod(key, max(1, len(surface)))
        for part in parts(len(ray), _PAIRS):
            ladder.test(Pairs(ray[part], row[part], triangles))
            yield None
        return (yield from ladder.hits(self.statistics))
