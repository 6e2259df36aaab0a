"""Makes the certified picture of a region in one sweep through the scene, from front to back.

The scene is rasterised chunk by chunk. Whatever a depth buffer of sure hits hides is dropped, most
of it before it is evaluated. The rest are fragments: pairs of a pixel and a surface that may be its
nearest. `resolve.py` decides which of them is. Theorem: `Sweep.sweep_sees_what_plain_does`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays import Floats, Index, parts
from ...scene import Region, Scene
from ...tracer.camera import camera_rays, film_positions
from ...tracer.hits import NOTHING, Hits, Statistics
from ...tracer.progress import Progress, Work, scaled
from ...tracer.vector import gather
from ..arithmetic import sound_steps
from ..bounds import plane_fractions
from .boxes import Boxed, InstanceBoxes, boxes_of
from .chunks import Chunk, Names, Numbering, chunks, expand
from .depth_bins import by_depth
from .depth_buffer import ROUNDING, ClipRange, DepthBuffer, Fragments, nearness
from .edge_functions import set_up
from .film import Film
from .rasterise import Boxes, Covered, rasterised
from .resolve import Resolver
from .small_triangles import SmallTriangles

_TRIANGLES = 1 << 15  # triangles that are tested against the depth buffer, and set up, together
_FRAGMENTS = 1 << 10  # fragments for which there is always room
_PIXELS = 1 << 15  # pixels of a plane at a time
_PAIRS = 1 << 15  # pairs entered into the depth buffer together
_BYTES_PER_TRIANGLE = 128  # of a chunk, its vertices included
_BYTES_PER_FRAGMENT = 48  # until its pixel is decided


@sound_steps
def sweep(
    scene: Scene,
    region: Region,
    memory: int,
    dx: float = 0.0,
    dy: float = 0.0,
    statistics: Statistics | None = None,
) -> Work[Hits]:
    """Find the nearest hits of a region's rays, the same as `plain` does.

    A chunk of the scene may take about `memory` bytes, and the fragments as many. If many surfaces
    tie and they need more, the region's halves are swept one after the other.
    """
    statistics = statistics or Statistics()
    pairs = statistics.pairs_tested
    film = Film(scene.camera, dx, dy)
    try:  # without a name for what is given up where memory ends
        return (yield from Sweep(scene, film, region, statistics).steps(memory))
    except _FullError as full:
        share = full.share
    statistics.pairs_tested = pairs  # each pair counts once
    size = (1 - share) / 2
    halves = []
    for k, half in enumerate(region.halves):
        part = sweep(scene, half, memory, dx, dy, statistics)
        halves.append((yield from scaled(part, share + k * size, size)))
    return Hits.joined(halves)


class _FullError(Exception):
    """There is no room for more fragments; `share` of the work was done."""

    def __init__(self, share: float) -> None:
        self.share = share


class Sweep:
    """The sweep of a region, which is within the camera's."""

    def __init__(self, scene: Scene, film: Film, region: Region, statistics: Statistics) -> None:
        self._scene = scene
        self._film = film
        self._statistics = statistics
        self._depths = DepthBuffer(region)
        self._clip = ClipRange(film.camera)
        self._fragments: list[Fragments] = []
        self._held = 0  # how many fragments
        self._numbers = Numbering()

    def steps(self, memory: int) -> Work[Hits]:
        """Sweep the scene in chunks, and decide every pixel; a `_FullError` without the memory."""
        room = max(_FRAGMENTS, memory // _BYTES_PER_FRAGMENT)
        yield None  # allocating the depth buffer of a large picture is a step of its own
        for _ in self.enter_planes():
            yield None
            self._make_room(room, 0.0)
        if self._scene.instances:
            yield from self._instances(max(1, memory // _BYTES_PER_TRIANGLE), room)
        end = Resolver(self._scene, self._film, self._depths, self._numbers, self._statistics)
        return (yield from end.steps(self._fragments))

    def _instances(self, limit: int, room: int) -> Work[None]:
        """Sweep the instances in chunks of `limit` triangles, with room for some fragments."""
        around = InstanceBoxes.of(self._scene, self._film)
        region = self._depths.region
        small = SmallTriangles(self._scene, self._film, region, around.area)
        in_view = around.in_region(region)
        every = chunks(self._scene, in_view, around.depth, limit, small.is_dense)
        for number, chunk in enumerate(every):
            if self._fragments:
                self._depths.refresh()
                hidden = around.hidden(chunk.instances, self._depths)
                chunk = replace(chunk, instances=chunk.instances[~hidden])
            share = 0.6 * number / len(every)
            for _ in self.enter(chunk, small):
                yield Progress(share)
                self._make_room(room, share)

    def _keep(self, some: Fragments) -> None:
        self._fragments.append(some)
        self._held += len(some)

    def _make_room(self, room: int, share: float) -> None:
        """Drop the fragments that are hidden by now, if there is little room for more."""
        if self._held <= room:
            return
        for k, some in enumerate(self._fragments):
            self._fragments[k] = some.take(self._depths.not_hidden(some))
        self._held = sum(map(len, self._fragments))
        region = self._depths.region
        if self._held > 0.75 * room and region.width * region.height > 1:
            raise _FullError(share)

    def enter_planes(self) -> Work[None]:
        """Sweep the infinite planes, in small steps."""
        planes = self._scene.planes
        if not planes:
            return
        count = np.arange(len(planes) + 1)
        instances = (len(self._scene.instances) + count[:-1]).astype(np.int32)
        start = self._numbers.enter(Names(instances, count, NOTHING))
        film = self._film
        region = self._depths.region
        for surface, infinite in enumerate(planes, start):
            at = infinite.point[:, None], infinite.normal[:, None]
            for part in parts(region.width * region.height, _PIXELS):
                pixel = np.arange(part.start, part.stop)
                rays = camera_rays(film.camera, *film_positions(region, film.dx, film.dy, pixel))
                ends = plane_fractions(rays, *at).interval()
                low, high = (np.broadcast_to(v, pixel.shape) for v in ends)
                least, most = nearness(film.camera, low, high, ROUNDING)
                of = np.full(len(pixel), surface)
                place = self._depths.places(pixel)
                self._keep(self.of_pairs(Covered(place, of, least, most, np.isfinite(high)), of))
                yield None

    def enter(self, chunk: Chunk, small: SmallTriangles) -> Work[None]:
        """Sweep the triangles of a chunk, in small steps."""
        if not len(chunk.instances):
            return
        expanded = yield from expand(self._scene, self._film, chunk, small)
        yield None
        low, high, nearest = boxes_of(self._scene, self._film, expanded)
        yield None
        number = self._numbers.enter(expanded.names)
        boxed = Boxed.of(expanded, number, self._depths.region, low, high, nearest)
        if not len(boxed.seen):
            return
        yield None
        bins = by_depth(boxed.seen, nearest, boxed.region_low, boxed.region_high)
        yield None
        for number, depth_bin in enumerate(bins):
            if number or self._fragments:
                self._depths.refresh()
            for part in parts(len(depth_bin), _TRIANGLES):
                yield from self._enter_triangles(boxed, depth_bin[part])

    def _enter_triangles(self, boxed: Boxed, some: Index) -> Work[None]:
        """Sweep those of some triangles of a chunk that the depth buffer does not hide."""
        low, high = boxed.in_region(some)
        some = gather(some, self.not_hidden(low, high, gather(boxed.nearest, some)))
        expanded = boxed.expanded
        origin = gather(boxed.low, some)
        reach = np.maximum(*(gather(boxed.high, some) - origin)) + 1.0
        corners = gather(expanded.corners, some)
        nearest = gather(boxed.nearest, some)
        found = set_up(self._film, expanded.vertices, corners, nearest, origin, reach)
        of = gather(some, found.row)  # a triangle of unknown orientation occurs twice
        low, high = boxed.in_region(of)
        boxes = Boxes(np.arange(len(of)), low, high)
        yield None
        for pairs in Covered.together(rasterised(found, boxes, self._depths), _PAIRS):
            self._keep(self.of_pairs(pairs, boxed.first + gather(of, pairs.owner)))
            yield None

    def not_hidden(self, low: Index, high: Index, nearest: Floats) -> Index:
        """Return which boxes the depth buffer does not surely hide; it knows about small boxes."""
        return np.flatnonzero(~(nearest < self._depths.farthest_in(low, high)))

    def of_pairs(self, pairs: Covered, surface: Index) -> Fragments:
        """Enter sure hits into the depth buffer; return the fragments, and all that is not sure."""
        least = pairs.least
        most = pairs.most
        self._statistics.pairs_tested += len(pairs)
        sure = pairs.sure & self._clip.inside(least, most)
        if sure.all():
            return Fragments.joined(self._depths.enter(pairs.pixel, surface, least, most))
        certain = np.flatnonzero(sure)
        own = gather(surface, certain)
        some = pairs.take(certain)
        fragments = self._depths.enter(some.pixel, own, some.least, some.most)
        open_ = ~(sure | (most < gather(self._depths.nearness, pairs.pixel)))
        unsure = np.flatnonzero(open_ & ~self._clip.outside(least, most))
        others = Fragments(pairs.pixel, surface, most).take(unsure)
        return Fragments.joined((*fragments, others))
