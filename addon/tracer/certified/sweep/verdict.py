"""What every pixel of a region sees, of all that it has kept.

In come the pairs that a sweep has kept; out go `Hits`. A pixel that has kept one triangle, which
surely is hit, is decided: t and the barycentrics are all that is open. The rays of all others, and
all that they may see, go to a `Contest`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ....scene import Scene
from ...camera import Rays, camera_rays, film_positions_of
from ...candidates import Pairs
from ...hits import NOTHING, Hits, Statistics
from ...progress import Steps, named
from ...vector import gather
from ...world import WorldTriangles, world_corners
from ..certainty import Certainty
from ..contest import Contest
from ..resolve import TOGETHER, Prepared
from ..surfaces import Surfaces
from .chunks import Names, Numbering
from .depth_buffer import DepthBuffer
from .film import Film
from .fragments import Kept

_PAIRS = 1 << 15  # that a contest tests at a time
_PIXELS = 1 << 17  # whose surfaces are prepared together: what that takes is some MiB

Index = NDArray[np.integer]


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
        self._first_triangle = len(scene.planes)
        # The rays of the picture's corners, which enclose all others, as they are linear in x and y
        # and rounding is monotone. What is done for many rays is done for these, so that it does
        # not depend on the region.
        px = np.array([0.5, 0.5, film.camera.width - 0.5, film.camera.width - 0.5]) + film.dx
        py = np.array([0.5, film.camera.height - 0.5] * 2) + film.dy
        self._around = camera_rays(film.camera, px, py)

    def steps(self, kept: Sequence[Kept]) -> Steps[Hits]:
        """Decide every pixel by what they have kept, in small steps that say what they were."""
        region = self._depths.region
        hits = Hits.none(region.width * region.height, Certainty.BOUND)
        if not kept:
            return hits
        near = []
        for some in kept:
            seen = ~(some.nearest < gather(self._depths.nearness, some.pixel))
            near.append(some.take(np.flatnonzero(seen)))
            yield "verdict"
        found = Kept.joined(near)
        pixel = self._depths.pixels(found.pixel)
        # Of several that a pixel has, one is the last: the others see that they are not alone.
        every = np.arange(len(pixel), dtype=np.int32)
        last = np.full(len(hits.t), NOTHING, np.int32)
        last[pixel] = every
        open_ = (gather(last, pixel) != every) | ~found.sure
        open_ = gather(pixel, np.flatnonzero(open_))
        clear = last >= 0
        clear[open_] = False
        yield "verdict"
        decided = np.flatnonzero(clear)
        yield from self._enter_sure(hits, decided, gather(found.surface, gather(last, decided)))
        if len(open_):
            rest = np.flatnonzero(~gather(clear, pixel))
            yield from self._contest(hits, gather(pixel, rest), gather(found.surface, rest))
        return hits

    def _enter_sure(self, hits: Hits, pixel: Index, surface: Index) -> Steps[None]:
        """Enter pixels, in their order, that surely see the surface which is all that they have."""
        for piece, own, first in self._numbers.by_piece(surface):
            at, row = pixel[own], surface[own] - first
            room = np.empty(piece.count, np.int32)
            for start in range(0, len(at), _PIXELS):
                part = slice(start, start + _PIXELS)
                yield from self._enter_some(hits, at[part], row[part], piece, room)

    def _enter_some(
        self, hits: Hits, at: Index, row: Index, piece: Names, room: NDArray[np.int32]
    ) -> Steps[None]:
        """Enter pixels that surely see these surfaces of a piece."""
        surfaces = Surfaces(self._planes, len(self._scene.instances), WorldTriangles.none())
        if piece.first != NOTHING:
            used, row = _used(row, room)
            names = piece.of(used)
            triangles = WorldTriangles(world_corners(self._scene, *names), *names)
            surfaces = Surfaces((), 0, triangles)
        prepared = Prepared(self._around, surfaces)
        yield "rounding"
        for first in range(0, len(at), TOGETHER):
            part = slice(first, first + TOGETHER)
            prepared.enter(hits, at[part], self._rays(at[part]), row[part])
            yield "rounding"
        prepared.finish(hits, self._rays)

    def _rays(self, pixel: Index) -> Rays:
        """Return the rays of pixels of the region, numbered row by row."""
        film = self._film
        return camera_rays(
            film.camera, *film_positions_of(self._depths.region, pixel, film.dx, film.dy)
        )

    def _contest(self, hits: Hits, pixel: Index, surface: Index) -> Steps[None]:
        """Decide pixels that may see several surfaces, or none for sure."""
        scene, camera = self._scene, self._film.camera
        which, ray = np.unique(pixel, return_inverse=True)
        some = self._rays(which)
        on_mesh = np.flatnonzero(surface >= self._first_triangle)  # it has the planes already
        ray, surface = ray[on_mesh], surface[on_mesh]
        surface, row = np.unique(surface, return_inverse=True)
        clip = camera.clip_start, camera.clip_end
        contest = Contest(some, self._planes, len(scene.instances), *clip, self._around)
        names = self._numbers.names_of(surface)
        triangles = WorldTriangles(world_corners(scene, *names), *names)
        # Ray by ray, and once each: a triangle of unknown sign has two footprints.
        ray, row = np.divmod(np.unique(ray * len(surface) + row), max(1, len(surface)))
        for first in range(0, len(ray), _PAIRS):
            part = slice(first, first + _PAIRS)
            contest.enter(Pairs(ray[part], row[part], triangles))
            yield "contest"
        found = yield from named(contest.hits(self._statistics), "contest")
        hits.t[which], hits.instance[which] = found.t, found.instance
        hits.triangle[which], hits.s[:, which] = found.triangle, found.s
        hits.certainty[which] = found.certainty
        hits.ties.update((int(which[k]), names) for k, names in found.ties.items())


def _used(number: Index, room: NDArray[np.int32]) -> tuple[Index, Index]:
    """Return which numbers occur, and where each of `number` is among them.

    In the order in which they occur first: neighbours in the picture are neighbours in memory.
    `room` has a place for each number there may be.
    """
    every = np.arange(len(number), dtype=np.int32)
    room[number[::-1]] = every[::-1]
    used = number.take(np.flatnonzero(gather(room, number) == every))
    room[used] = every[: len(used)]
    return used, gather(room, number)
