"""What every pixel of a region sees, of all its fragments.

In come the fragments that a sweep has found; out go `Hits`. A pixel with one fragment, which surely
is hit, is decided: t and the barycentrics are all that is open. The rays of all others, and
all that they may see, go to a `Contest`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ....scene import Scene
from ...camera import Rays, camera_rays, corner_rays, film_positions
from ...candidates import Pairs
from ...hits import NOTHING, Hits, Statistics, Ties
from ...progress import Steps, mapped
from ...vector import Index, gather, grouped, groups, parts
from ...world import WorldTriangles, world_corners
from ..certainty import Certainty
from ..contest import Contest
from ..surfaces import TOGETHER, Prepared, Surfaces
from .chunks import Names, Numbering
from .depth_buffer import DepthBuffer, Fragments
from .film import Film

_PAIRS = 1 << 15  # that a contest tests at a time
_FRAGMENTS = 1 << 17  # looked at together: a step of some milliseconds
_RAYS, _CANDIDATES = 1 << 14, 1 << 15  # of a contest, at most
_PIXELS = 1 << 17  # whose surfaces are prepared together: what that takes is some MiB


class Verdict:
    """The end of a sweep: its depth buffer, and how it numbers surfaces."""

    def __init__(
        self,
        scene: Scene,
        film: Film,
        depths: DepthBuffer,
        numbers: Numbering,
        statistics: Statistics,
    ) -> None:
        self._scene, self._film, self._depths = scene, film, depths
        self._numbers, self._statistics = numbers, statistics
        self._planes = [(p.point, p.normal) for p in scene.planes]
        self._around = corner_rays(film.camera, film.dx, film.dy)

    def steps(self, fragments: list[Fragments]) -> Steps[Hits]:
        """Decide every pixel by its fragments, which it empties, in small steps with names."""
        region = self._depths.region
        count = region.width * region.height
        hits = Hits.room(count)
        for part in parts(count, _PAIRS):
            hits.clear(part, Certainty.BOUND)
            yield "verdict"
        # Of several fragments of a pixel, one is the last: the others see that they are not alone.
        near, total = [], 0
        last, surface = np.full(count, NOTHING, np.int32), np.empty(count, np.int64)
        yield "verdict"
        # Each is let go of as soon as it is looked at.
        every = (fragments.pop(0) for _ in range(len(fragments)))
        for some in Fragments.together(every, _FRAGMENTS):
            some = some.take(self._depths.not_hidden(some))
            pixel = self._depths.pixels(some.pixel)
            number = np.arange(total, total + len(pixel), dtype=np.int32)
            last[pixel], surface[pixel] = number, some.surface
            near.append((pixel, some.surface, some.sure, number))
            total += len(pixel)
            yield "verdict"
        open_ = np.zeros(count, bool)
        for pixel, _, sure, number in near:
            alone = gather(last, pixel) == number
            open_[gather(pixel, np.flatnonzero(~(alone & sure)))] = True
            yield "verdict"
        for part in parts(count, _PIXELS):
            decided = part.start + np.flatnonzero((last[part] >= 0) & ~open_[part])
            for chunk, own, first in self._numbers.by_chunk(gather(surface, decided)):
                at = decided[own]
                if len(at):
                    yield from self._enter_sure(hits, at, gather(surface, at) - first, chunk)
        del last, surface
        yield from self._enter_open(hits, open_, [near.pop(0)[:2] for _ in range(len(near))])
        return hits

    def _enter_open(
        self, hits: Hits, open_: NDArray[np.bool_], pairs: list[tuple[Index, Index]]
    ) -> Steps[None]:
        """Enter the pixels that may see several surfaces, or none for sure: some at a time.

        `pairs` are pixels and surfaces, of these pixels and of others; they are used up.
        """
        every = np.flatnonzero(open_)
        self._statistics.culling["left"] += len(every)
        amount = np.zeros(len(open_), np.int32)
        for k, (pixel, surface) in enumerate(pairs):
            rest = np.flatnonzero(gather(open_, pixel))
            pairs[k] = pixel, _ = gather(pixel, rest), gather(surface, rest)
            np.add.at(amount, pixel, 1)
            yield "contest"
        ends = list(groups(amount[every] + _CANDIDATES // _RAYS, _CANDIDATES))
        starts = every[[first for first, _ in ends]]
        contests: list[list[tuple[Index, Index]]] = [[] for _ in ends]
        while pairs and ends:
            pixel, surface = pairs.pop()
            group = (np.searchsorted(starts, pixel, side="right") - 1).astype(np.uint16)
            for members, own in zip(contests, grouped(group, len(ends)), strict=True):
                if len(own):
                    members.append((pixel[own], surface[own]))
            yield "contest"
        ties = []
        for (first, last), members in zip(ends, contests, strict=True):
            which = every[first:last]
            pixel, surface = map(np.concatenate, zip(*members, strict=True))
            members.clear()
            ray = np.searchsorted(which, pixel)
            ties.append((yield from self._contest(hits, which, ray, surface)))
        hits.ties = Ties.joined(ties)

    def _enter_sure(self, hits: Hits, at: Index, row: Index, chunk: Names) -> Steps[None]:
        """Enter pixels that surely see these surfaces of a chunk, which are all that they have."""
        surfaces = Surfaces(self._planes, len(self._scene.instances), WorldTriangles.none())
        if chunk.first != NOTHING:
            used, row = _used(row, chunk.count)
            names = chunk.of(used)
            surfaces = Surfaces((), 0, WorldTriangles(world_corners(self._scene, *names), *names))
        prepared = Prepared(self._around, surfaces)
        yield "rounding"
        for part in parts(len(at), TOGETHER):
            prepared.enter(hits, at[part], self._rays(at[part]), row[part])
            yield "rounding"
        prepared.finish(hits, self._rays)

    def _rays(self, pixel: Index) -> Rays:
        """Return the rays of pixels of the region, numbered row by row."""
        film = self._film
        return camera_rays(
            film.camera, *film_positions(self._depths.region, film.dx, film.dy, pixel)
        )

    def _contest(self, hits: Hits, which: Index, ray: Index, surface: Index) -> Steps[Ties]:
        """Decide pixels `which`, the rays of pairs with a surface each; returns their ties."""
        scene, camera = self._scene, self._film.camera
        on_mesh = np.flatnonzero(surface >= len(scene.planes))  # it has the planes already
        ray, surface = ray[on_mesh], surface[on_mesh]
        surface, row = np.unique(surface, return_inverse=True)
        clip = camera.clip_start, camera.clip_end
        rays = self._rays(which)
        contest = Contest(rays, self._planes, len(scene.instances), *clip, self._around)
        names = self._numbers.names_of(surface)
        triangles = WorldTriangles(world_corners(scene, *names), *names)
        # Ray by ray, and once each: a triangle of unknown orientation has two set-ups.
        key = np.sort(ray * len(surface) + row)  # faster than `np.unique`
        key = key[np.flatnonzero(np.diff(key, prepend=-1))]
        ray, row = np.divmod(key, max(1, len(surface)))
        for part in parts(len(ray), _PAIRS):
            contest.enter(Pairs(ray[part], row[part], triangles))
            yield "contest"
        found = yield from mapped(contest.hits(self._statistics), lambda _: "contest")
        hits.enter(which, found)
        return found.ties.numbered(which)


def _used(number: Index, count: int) -> tuple[Index, Index]:
    """Return which numbers occur, and where each of `number` is among them.

    In the order in which they occur first: neighbours in the picture are neighbours in memory.
    All are less than `count`.
    """
    room = np.empty(count, np.int32)
    every = np.arange(len(number), dtype=np.int32)
    room[number[::-1]] = every[::-1]
    used = number.take(np.flatnonzero(gather(room, number) == every))
    room[used] = every[: len(used)]
    return used, gather(room, number)
