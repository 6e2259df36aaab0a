"""The certified picture of a region: what a front-to-back sweep proves, and what it leaves open.

In comes a scene; out go `Hits`. Chunks of the scene are swept from the front to the back. What a
depth buffer of sure hits hides is dropped, most of it unseen; of the rest every pixel keeps those
triangles that may be its nearest. `verdict.py` says which of them is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...scene import Region, Scene
from ...tracer.camera import camera_rays, film_positions
from ...tracer.hits import NOTHING, Hits, Statistics
from ...tracer.progress import Steps, Work, quiet, scaled, timed
from ...tracer.vector import Index, gather, parts
from ..bounds import plane_fractions
from .boxes import InstanceBoxes, boxes_of, by_depth
from .chunks import Chunk, Names, Numbering, chunks, expand
from .depth_buffer import ROUNDING, ClipRange, DepthBuffer, Fragments
from .edge_functions import EdgeFunctions, set_up
from .film import Film
from .rasterise import Boxes, Covered, rasterised, split
from .small_boxes import are_small, small_pairs
from .small_triangles import SmallTriangles
from .verdict import Verdict

_TRIANGLES = 1 << 17  # looked at together
_SET_UP = 1 << 13  # of those that are not small, at a time: they stay in a core's cache
_FRAGMENTS = 1 << 10  # for which there is always room
_PIXELS = 1 << 15  # of a plane, at a time
_PAIRS = 1 << 15  # that the depth buffer is asked about together
_BYTES_PER_TRIANGLE = 128  # of a chunk, with its vertices
_BYTES_PER_FRAGMENT = 48  # until its pixel is decided


def sweep(
    scene: Scene,
    region: Region,
    memory: int,
    dx: float = 0.0,
    dy: float = 0.0,
    statistics: Statistics | None = None,
) -> Work[Hits]:
    """Find the nearest hits of a region's rays, as `plain` does.

    `memory` is how many bytes a chunk of the scene may take, about, and as many its fragments.
    Where more surfaces tie than it has room for, the region's halves are swept, one by one.
    """
    statistics = statistics or Statistics()
    pairs, culling = statistics.pairs_tested, statistics.culling.copy()
    with np.errstate(all="ignore"):
        work = Sweep(scene, Film(scene.camera, dx, dy), region, statistics).steps(memory)
    try:
        return (yield from quiet(work))
    except _FullError as full:
        share = full.share
    statistics.pairs_tested, statistics.culling = pairs, culling  # each pair counts once
    size, halves = (1 - share) / 2, []
    for k, half in enumerate(region.halves):
        part = sweep(scene, half, memory, dx, dy, statistics)
        halves.append((yield from scaled(part, share + k * size, size)))
    return Hits.joined(halves)


class _FullError(Exception):
    """There is no room for so many fragments; `share` is that of the work that is done."""

    def __init__(self, share: float) -> None:
        self.share = share


class Sweep:
    """A region's pixels, within the camera's, on the way to being decided."""

    boxes_of, are_small = staticmethod(boxes_of), staticmethod(are_small)

    def __init__(self, scene: Scene, film: Film, region: Region, statistics: Statistics) -> None:
        self._scene, self._film, self._statistics = scene, film, statistics
        self._depths = DepthBuffer(region)
        self._clip = ClipRange(film.camera)
        self._fragments: list[Fragments] = []
        self._held = 0  # of them
        self._numbers = Numbering()

    def steps(self, memory: int) -> Work[Hits]:
        """Sweep the scene in chunks, and decide every pixel; a `_FullError` without the memory."""
        limit = max(1, memory // _BYTES_PER_TRIANGLE)
        room = max(_FRAGMENTS, memory // _BYTES_PER_FRAGMENT)
        stages = self._statistics.stages
        yield 0.0  # to make room for the depth buffer of a large picture is a step of its own
        for _ in timed(self.enter_planes(), stages):
            yield 0.0
            self._make_room(room, 0.0)
        every: list[Chunk] = []
        if self._scene.instances:
            around, region = InstanceBoxes.of(self._scene, self._film), self._depths.region
            self._small = SmallTriangles(self._scene, self._film, region, around.area)
            in_view, dense = around.in_region(region), self._small.is_dense
            every = chunks(self._scene, in_view, around.depth, limit, dense)
        for number, chunk in enumerate(every):
            if self._fragments:
                self._depths.refresh()
                hidden = around.hidden(chunk.instances, self._depths)
                chunk = replace(chunk, instances=chunk.instances[~hidden])
            for _ in timed(self.enter(chunk), stages):
                yield 0.6 * number / len(every)
                self._make_room(room, 0.6 * number / len(every))
        verdict = Verdict(self._scene, self._film, self._depths, self._numbers, self._statistics)
        return (yield from timed(verdict.steps(self._fragments), stages, 0.6))

    def _keep(self, some: Fragments) -> None:
        self._fragments.append(some)
        self._held += len(some)

    def _make_room(self, room: int, share: float) -> None:
        """Drop what is hidden by now where there is little room for more fragments."""
        if self._held <= room:
            return
        for k, some in enumerate(self._fragments):
            self._fragments[k] = some.take(self._depths.not_hidden(some))
        self._held = sum(map(len, self._fragments))
        region = self._depths.region
        if self._held > 0.75 * room and region.width * region.height > 1:
            raise _FullError(share)

    def enter_planes(self) -> Steps[None]:
        """Sweep the infinite planes, in small steps."""
        planes, first = self._scene.planes, len(self._scene.instances)
        if not planes:
            return
        count = np.arange(len(planes) + 1)
        start = self._numbers.enter(Names((first + count[:-1]).astype(np.int32), count, NOTHING))
        film, region = self._film, self._depths.region
        size = region.width * region.height
        for surface, infinite in enumerate(planes, start):
            point, normal = infinite.point[:, None], infinite.normal[:, None]
            for begin in range(0, size, _PIXELS):
                pixel = np.arange(begin, min(begin + _PIXELS, size))
                rays = camera_rays(film.camera, *film_positions(region, film.dx, film.dy, pixel))
                ends = plane_fractions(rays, point, normal).interval()
                low, high = (np.broadcast_to(v, pixel.shape) for v in ends)
                least, most = film.camera.projection.nearness(low, high, ROUNDING)
                place, of = self._depths.places(pixel), np.full(len(pixel), surface)
                pairs = Covered(place, of, least, most, np.isfinite(high))
                self._keep(self.of_pairs(pairs, of))
                yield "planes"

    def enter(self, chunk: Chunk) -> Steps[None]:
        """Sweep the triangles of a chunk, in small steps; yields which stage of work each was."""
        if not len(chunk.instances):
            return
        region, culling = self._depths.region, self._statistics.culling
        expanded = yield from expand(self._scene, self._film, chunk, self._small)
        start = self._numbers.enter(expanded.names)
        yield "project"
        low, high, nearest = self.boxes_of(self._scene, self._film, expanded)
        yield "boxes"
        corner = np.array([[region.x0], [region.y0]], low.dtype)
        extent = np.array([[region.width - 1], [region.height - 1]], low.dtype)
        part_low = np.maximum(low - corner, 0)
        part_high = np.minimum(high - corner, extent)
        fits = part_low <= part_high
        seen = np.flatnonzero(fits[0] & fits[1])
        if not len(seen):
            return
        yield "boxes"
        bins = by_depth(seen, nearest, part_low, part_high)
        yield "bins"
        for number, depth_bin in enumerate(bins):
            if number or self._fragments:
                self._depths.refresh()
            for part in parts(len(depth_bin), _TRIANGLES):
                some = depth_bin[part]
                ends = gather(part_low, some), gather(part_high, some)
                some = gather(some, self.not_hidden(*ends, gather(nearest, some)))
                small = self.are_small(self._film, expanded, low, high, some)
                yield "set-up"
                own, left = gather(some, np.flatnonzero(small)), [some[~small]]
                found = small_pairs(
                    self._film, expanded, low, high, own, self._depths, culling, left
                )
                for pairs in Covered.together(found, _PAIRS):
                    self._keep(self.of_pairs(pairs, start + pairs.owner))
                    yield "pixels"
                rest = np.concatenate(left)
                culling["reached"] += len(some) - len(rest)
                for part in parts(len(rest), _SET_UP):
                    some = rest[part]
                    origin = gather(low, some)
                    found = set_up(
                        self._film,
                        expanded.vertices,
                        gather(expanded.corners, some),
                        gather(nearest, some),
                        origin,
                        np.maximum(*(gather(high, some) - origin)) + 1.0,
                    )
                    of = gather(some, found.row)  # some may occur twice
                    boxes = Boxes(np.arange(len(of)), gather(part_low, of), gather(part_high, of))
                    yield "set-up"
                    for pairs in Covered.together(self.pairs(found, boxes), _PAIRS):
                        self._keep(self.of_pairs(pairs, start + gather(of, pairs.owner)))
                        yield "pixels"

    def not_hidden(self, low: Index, high: Index, nearest: NDArray) -> Index:
        """Return which boxes, where they are small, are not wholly behind the depth buffer."""
        self._statistics.culling["boxed"] += len(nearest)
        return np.flatnonzero(~(nearest < self._depths.farthest_in(low, high)))

    def pairs(self, found: EdgeFunctions, boxes: Boxes) -> Iterator[Covered]:
        """Yield the pairs of boxes, in small steps."""
        reached, culling = np.zeros(len(found), bool), self._statistics.culling
        for some in split(found, boxes, self._depths):
            reached[found.row.take(some.owner)] = True
            width, height = (some.high - some.low + 1).astype(np.int64)
            culling["computed"] += int((width * height).sum())
            yield from rasterised(found, some, self._depths)
        culling["reached"] += int(reached.sum())

    def of_pairs(self, pairs: Covered, surface: Index) -> Fragments:
        """Enter the sure hits into the depth buffer; return their rivals, and what is not sure."""
        pixel, _, least, most, sure = vars(pairs).values()
        self._statistics.pairs_tested += len(pixel)
        sure = sure & self._clip.inside(least, most)
        every = pixel, surface, least, most
        if sure.all():
            return Fragments.joined(self._depths.enter(*every))
        certain = np.flatnonzero(sure)
        rivals = self._depths.enter(*(gather(v, certain) for v in every))
        open_ = ~(sure | (most < gather(self._depths.nearness, pixel)))
        open_ = np.flatnonzero(open_ & ~self._clip.outside(least, most))
        others = Fragments(*(gather(v, open_) for v in (pixel, surface, most)))
        return Fragments.joined((*rivals, others))
