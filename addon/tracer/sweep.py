"""The certified picture of a region: what a front-to-back sweep proves, and what it leaves open.

In comes a scene; out go `Hits`. Pieces of the scene are swept from the front to the back. What a
depth buffer of sure hits hides is dropped, most of it unseen; of the rest every pixel keeps those
triangles that may be its nearest. Almost always that is one, which surely is hit: then the pixel is
decided. The rays of all other pixels, and all that they may see, go to a `Contest`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, Plane, Region, Scene
from .bounds import U, plane_depths
from .camera import Rays, camera_rays, film_positions_of
from .candidates import Pairs, WorldTriangles, pixel_bounds
from .certainty import Certainty
from .certified import Contest
from .cover import LARGE, Boxes, Covered, covered, split
from .depth_buffer import DepthBuffer
from .film import Film
from .footprints import Footprints, footprints
from .hits import NOTHING, Hits, Statistics
from .instance_boxes import InstanceBoxes
from .pieces import Expanded, Names, Piece, expand, pieces
from .progress import Work, quiet, scaled
from .resolve import TOGETHER, Prepared
from .rivals import Surfaces
from .vector import transform_points

_TRIANGLES = 1 << 15  # looked at together
_BINS = 256  # of depth, into which a piece's triangles are sorted
_PAIRS = 1 << 15  # that a contest tests at a time
_BYTES_PER_TRIANGLE = 128  # of a piece, with its vertices

Index = NDArray[np.integer]


@dataclass(frozen=True, eq=False)
class Kept:
    """c pairs of a pixel and a surface that may be its nearest, (c,) each.

    `surface` counts the triangles of all pieces; `nearest` is the most that its nearness can be;
    `sure` whether it is hit for sure.
    """

    pixel: Index
    surface: Index
    nearest: NDArray[np.float64]
    sure: NDArray[np.bool_]

    def take(self, index: Index) -> Kept:
        """Return those at `index`."""
        return Kept(*(v.take(index) for v in vars(self).values()))

    @staticmethod
    def joined(parts: Sequence[Kept]) -> Kept:
        """Return them all as one."""
        return Kept(
            *(np.concatenate(f) for f in zip(*(vars(p).values() for p in parts), strict=True))
        )


def sweep(
    scene: Scene,
    region: Region,
    memory: int,
    dx: float = 0.0,
    dy: float = 0.0,
    statistics: Statistics | None = None,
) -> Work[Hits]:
    """Find the nearest hits of a region's rays, with proof, in small steps.

    Parameters
    ----------
    scene : Scene
    region : Region
        Of n pixels, within the camera's.
    memory : int
        Bytes that a piece of the scene may take, about.
    dx, dy : float
        Where each ray passes its pixel's centre, in pixels; at most half a pixel.
    statistics : Statistics, optional
        To count in.

    Returns
    -------
    Hits
        Of the n rays, row by row from the lowest.
    """
    swept = Sweep(scene, Film(scene.camera, dx, dy), region, statistics or Statistics())
    return quiet(swept.steps(max(1, memory // _BYTES_PER_TRIANGLE)))


class ClipRange:
    """The camera's clip range as nearness, with room for its own rounding."""

    def __init__(self, camera: Camera) -> None:
        if camera.orthographic:
            ends = -camera.clip_end, -camera.clip_start
            room = 0.0
        else:
            ends = 1 / camera.clip_end, 1 / camera.clip_start
            room = 4 * U
        self._outer = ends[0] * (1 - room), ends[1] * (1 + room)
        self._inner = ends[0] * (1 + room), ends[1] * (1 - room)

    def inside(self, least: NDArray, most: NDArray) -> NDArray[np.bool_]:
        """Return which surely are in the range, of nearnesses between these."""
        return (least > self._inner[0]) & (most < self._inner[1])

    def outside(self, least: NDArray, most: NDArray) -> NDArray[np.bool_]:
        """Return which surely are not."""
        return (most < self._outer[0]) | (least > self._outer[1])


class Sweep:
    """A region's pixels on the way to being decided.

    Parameters
    ----------
    film : Film
    region : Region
        Within the camera's.
    statistics : Statistics
        To count in.
    """

    def __init__(self, scene: Scene, film: Film, region: Region, statistics: Statistics) -> None:
        self._scene, self._film, self._statistics = scene, film, statistics
        self._depths = DepthBuffer(region)
        self._clip = ClipRange(film.camera)
        self._picture = Region(0, 0, film.camera.width, film.camera.height)
        # The rays of the picture's corners, which enclose all others, as they are linear in x and y
        # and rounding is monotone. What is done for many rays is done for these, so that it does
        # not depend on the region.
        px = np.array([0.5, 0.5, film.camera.width - 0.5, film.camera.width - 0.5]) + film.dx
        py = np.array([0.5, film.camera.height - 0.5] * 2) + film.dy
        self._around = camera_rays(film.camera, px, py)
        self._planes = [(p.point, p.normal) for p in scene.planes]
        self._first_triangle = len(scene.planes)
        self._kept: list[Kept] = []
        self._names: list[Names] = []  # of the pieces so far
        self._starts = np.zeros(1, np.int64)  # and the number of the first surface of each

    def steps(self, limit: int) -> Work[Hits]:
        """Sweep the scene in pieces of at most `limit` triangles, and decide every pixel."""
        for _ in self.enter_planes():
            yield 0.0
        around = InstanceBoxes.of(self._scene, self._film) if self._scene.instances else None
        parts = pieces(self._scene, around, self._depths.region, limit)
        for number, piece in enumerate(parts):
            if self._kept:
                piece = self._not_behind(piece, around)
            for _ in self.enter(piece) if len(piece.instances) else ():
                yield 0.6 * number / len(parts)
        return (yield from scaled(self.hits(), 0.6, 0.4))

    def _not_behind(self, piece: Piece, around: InstanceBoxes) -> Piece:
        """Return a piece without the instances that what is nearer hides."""
        self._depths.refresh(0, self._depths.region.height)
        hidden = around.hidden(piece.instances, self._depths)
        return replace(piece, instances=piece.instances[~hidden])

    def enter_planes(self) -> Iterator[None]:
        """Sweep the infinite planes, in small steps."""
        planes, first = self._scene.planes, len(self._scene.instances)
        if not planes:
            return
        count = np.arange(len(planes) + 1)
        start = self._enter_names(Names((first + count[:-1]).astype(np.int32), count, NOTHING))
        region, kept = self._depths.region, []
        for number, infinite in enumerate(planes):
            for pixel in np.split(
                every := np.arange(region.width * region.height), range(_PAIRS, len(every), _PAIRS)
            ):
                with np.errstate(all="ignore"):
                    kept.append(self._keep_plane(infinite, pixel, start + number))
                yield
        self._kept.append(Kept.joined(kept))

    def _keep_plane(self, infinite: Plane, pixel: Index, surface: int) -> Kept:
        self._statistics.pairs_tested += len(pixel)
        depths = plane_depths(self._rays(pixel), infinite.point[:, None], infinite.normal[:, None])
        low, high = (np.broadcast_to(v, pixel.shape) for v in depths.interval())
        if self._film.camera.orthographic:
            least, most = -high, np.where(np.isfinite(high), -low, np.inf)
        else:
            least, most = (1 - 4 * U) / high, (1 + 4 * U) / np.maximum(low, 0)
        sure = np.isfinite(high) & self._clip.inside(least, most)
        place = self._depths.places(pixel)
        certain = np.flatnonzero(sure)
        self._depths.enter(place[certain], least[certain])
        keep = ~(most < self._depths.nearness.take(place)) & ~self._clip.outside(least, most)
        keep = np.flatnonzero(keep)
        return Kept(place[keep], np.full(len(keep), surface), most[keep], sure[keep])

    def _enter_names(self, names: Names) -> int:
        """Enter a piece; returns the number of its first surface."""
        start = int(self._starts[-1])
        self._names.append(names)
        self._starts = np.append(self._starts, start + names.count)
        return start

    def enter(self, piece: Piece) -> Iterator[None]:
        """Sweep the triangles of a piece, in small steps."""
        region, stage = self._depths.region, self._statistics.stage
        with stage("project"):
            expanded = expand(self._scene, self._film, piece)
        start = self._enter_names(expanded.names)
        yield
        with stage("bound"):
            low, high, nearest = self._boxes(expanded)
        yield
        corner = np.array([[region.x0], [region.y0]], low.dtype)
        extent = np.array([[region.width - 1], [region.height - 1]], low.dtype)
        part_low = np.maximum(low - corner, 0)
        part_high = np.minimum(high - corner, extent)
        fits = part_low <= part_high
        seen = np.flatnonzero(fits[0] & fits[1])
        if not len(seen):
            return
        yield
        kept: list[Kept] = []
        slabs, y0, y1 = _slabs(seen, nearest, part_low, part_high)
        yield
        for number, slab in enumerate(slabs):
            if number or self._kept:
                self._depths.refresh(y0, y1)
            for first in range(0, len(slab), _TRIANGLES):
                some = slab[first : first + _TRIANGLES]
                boxes = Boxes(None, part_low.take(some, axis=1), part_high.take(some, axis=1))
                shape, front = boxes.shape, nearest.take(some)
                # Sorted by shape, so that what is evaluated together lies together.
                open_ = self._not_hidden(boxes, shape, front)
                open_ = open_.take(np.argsort(shape.take(open_), kind="stable"))
                some, shape = some.take(open_), shape.take(open_)
                if not len(some):
                    continue
                origin = low.take(some, axis=1)
                width, height = high.take(some, axis=1) - origin
                found = footprints(
                    self._film,
                    expanded.vertices,
                    expanded.corners.take(some, axis=1),
                    front.take(open_),
                    origin,
                    np.maximum(width, height) + 1.0,
                )
                boxes = Boxes(None, boxes.low.take(open_, axis=1), boxes.high.take(open_, axis=1))
                for pairs in self._pairs(found, boxes, shape):
                    kept.append(self._keep(found, pairs, start + some))
                    yield
        if kept:
            self._kept.append(Kept.joined(kept))

    def _boxes(self, expanded: Expanded) -> tuple[Index, Index, NDArray[np.float64]]:
        """Return lowest and highest x and y of triangles, (2, m) each, within the whole picture.

        And the most that the nearness of each can be, (m,).
        """
        vertices, corners = expanded.vertices, expanded.corners
        kind = vertices.box.dtype
        packed = vertices.box.view(np.int64 if kind.itemsize == 2 else np.complex128).ravel()
        count = corners.shape[1]
        low, high, nearest = np.empty((2, count), kind), np.empty((2, count), kind), np.empty(count)
        ends = np.array([[self._picture.x1 - 1], [self._picture.y1 - 1]], kind)
        for first in range(0, count, _TRIANGLES):
            part = slice(first, first + _TRIANGLES)
            some = corners[:, part]
            box = _smallest(*(packed.take(c).view(kind) for c in some)).reshape(-1, 4).T
            np.maximum(box[:2], 0, out=low[:, part])
            np.minimum(-box[2:], ends, out=high[:, part])
            nearest[part] = _largest(*(vertices.nearest.take(c) for c in some))
        if not vertices.ahead.all() or not vertices.finite.all():
            self._special(expanded, low, high)
        return low, high, nearest

    def _special(self, expanded: Expanded, low: Index, high: Index) -> None:
        """Mend the boxes of triangles with a corner that is not before the eye, or not finite."""
        vertices, corners = expanded.vertices, expanded.corners
        whole = replace(self._film.camera, region=self._picture)
        finite = vertices.finite.take(corners).all(axis=0)
        high[:, ~finite] = -1
        some = np.flatnonzero(finite & ~vertices.ahead.take(corners).all(axis=0))
        for part in np.split(some, range(_TRIANGLES, len(some), _TRIANGLES)):
            world = world_corners(self._scene, *expanded.names.of(part))
            x0, x1, y0, y1 = pixel_bounds(whole, world, reach=1.0)
            low[:, part], high[:, part] = (x0, y0), (x1 - 1, y1 - 1)

    def _not_hidden(self, boxes: Boxes, shape: NDArray, nearest: NDArray) -> Index:
        """Return which boxes, where they are small, are not wholly behind the depth buffer."""
        farthest = np.full(len(nearest), -np.inf)
        small = np.flatnonzero(shape != LARGE)
        (x0, y0), (x1, y1) = boxes.low.take(small, axis=1), boxes.high.take(small, axis=1)
        farthest[small] = self._depths.farthest_in(x0, x1, y0, y1)
        return np.flatnonzero(~(nearest < farthest))

    def _pairs(
        self, found: Footprints, boxes: Boxes, shape: NDArray[np.uint8]
    ) -> Iterator[Covered]:
        """Yield the pairs of sorted boxes, the large ones last, each with its own footprint."""
        large = int(np.searchsorted(shape, LARGE))
        parts = list(covered(found, boxes, shape[:large], self._depths))
        rest = np.arange(large, len(found.row))  # and those that occur twice
        row = found.row.take(rest)
        rest = Boxes(rest, boxes.low.take(row, axis=1), boxes.high.take(row, axis=1))
        for some in split(found, rest, self._depths) if len(row) else ():
            order = np.argsort(own := some.shape, kind="stable")
            parts += covered(found, some.take(order), own.take(order), self._depths)
            if parts:
                yield _joined(parts)
                parts = []
        if parts:
            yield _joined(parts)

    def _keep(self, found: Footprints, pairs: Covered, surface: Index) -> Kept:
        """Enter the sure hits into the depth buffer; return what may be the nearest."""
        self._statistics.pairs_tested += len(pairs.pixel)
        error = found.nearness_error.take(pairs.owner)
        least, most = pairs.nearness - error, pairs.nearness + error
        np.minimum(most, found.nearest.take(pairs.owner), out=most)
        sure = pairs.least > found.edge_error.take(pairs.owner)
        sure &= found.sure.take(pairs.owner)
        sure &= self._clip.inside(least, most)
        certain = np.flatnonzero(sure)
        if len(certain) == len(sure):
            self._depths.enter(pairs.pixel, least)
            keep = ~(most < self._depths.nearness.take(pairs.pixel))
        else:
            self._depths.enter(pairs.pixel.take(certain), least.take(certain))
            keep = ~(most < self._depths.nearness.take(pairs.pixel))
            keep &= ~self._clip.outside(least, most)
        keep = np.flatnonzero(keep)
        owner = found.row.take(pairs.owner.take(keep))
        return Kept(pairs.pixel.take(keep), surface.take(owner), most.take(keep), sure.take(keep))

    def hits(self) -> Work[Hits]:
        """Decide every pixel, in small steps that all yield 1."""
        region = self._depths.region
        hits = Hits.none(region.width * region.height, Certainty.BOUND)
        if not self._kept:
            return hits
        near = []
        for some in self._kept:
            seen = ~(some.nearest < self._depths.nearness.take(some.pixel))
            near.append(some.take(np.flatnonzero(seen)))
            yield 1.0
        self._kept = []
        found = Kept.joined(near)
        pixel = self._depths.pixels(found.pixel)
        # Of several that a pixel has, one is the last: the others see that they are not alone.
        every = np.arange(len(pixel), dtype=np.int32)
        last = np.full(len(hits.t), NOTHING, np.int32)
        last[pixel] = every
        open_ = (last.take(pixel) != every) | ~found.sure
        open_ = pixel.take(np.flatnonzero(open_))
        clear = last >= 0
        clear[open_] = False
        yield 1.0
        decided = np.flatnonzero(clear)
        yield from self._enter_sure(hits, decided, found.surface.take(last.take(decided)))
        if len(open_):
            rest = np.flatnonzero(~clear.take(pixel))
            yield from self._contest(hits, pixel.take(rest), found.surface.take(rest))
        return hits

    def _enter_sure(self, hits: Hits, pixel: Index, surface: Index) -> Work[None]:
        """Enter pixels, in their order, that surely see the surface which is all that they have."""
        for number, own in self._by_piece(surface):
            at, row = pixel[own], surface[own] - self._starts[number]
            surfaces = Surfaces(self._planes, len(self._scene.instances), WorldTriangles.none())
            if self._names[number].first != NOTHING:
                used, row = _used(row, self._names[number].count)
                names = self._names[number].of(used)
                triangles = WorldTriangles(world_corners(self._scene, *names), *names)
                surfaces = Surfaces((), 0, triangles)
            prepared = Prepared(self._around, surfaces)
            for first in range(0, len(at), TOGETHER):
                part = slice(first, first + TOGETHER)
                prepared.enter(hits, at[part], self._rays(at[part]), row[part])
                yield 1.0
            prepared.finish(hits, self._rays)

    def _names_of(self, surface: Index) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle of surfaces."""
        out = np.empty((2, len(surface)), np.int32)
        for number, own in self._by_piece(surface):
            out[:, own] = self._names[number].of(surface[own] - self._starts[number])
        return out[0], out[1]

    def _by_piece(self, surface: Index) -> Iterator[tuple[int, Index | slice]]:
        """Yield the number of each piece with those of the surfaces that are its own."""
        if len(self._names) == 1:
            yield 0, slice(None)
            return
        piece = np.searchsorted(self._starts, surface, side="right") - 1
        order = np.argsort(piece.astype(np.uint16), kind="stable")
        cuts = np.searchsorted(piece[order], np.arange(len(self._names) + 1))
        for number, (start, end) in enumerate(pairwise(cuts.tolist())):
            if start < end:
                yield number, order[start:end]

    def _rays(self, pixel: Index) -> Rays:
        """Return the rays of pixels of the region, numbered row by row."""
        film = self._film
        return camera_rays(
            film.camera, *film_positions_of(self._depths.region, pixel, film.dx, film.dy)
        )

    def _contest(self, hits: Hits, pixel: Index, surface: Index) -> Work[None]:
        """Decide pixels that may see several surfaces, or none for sure."""
        scene, camera = self._scene, self._film.camera
        which, ray = np.unique(pixel, return_inverse=True)
        some = self._rays(which)
        on_mesh = np.flatnonzero(surface >= self._first_triangle)  # it has the planes already
        ray, surface = ray[on_mesh], surface[on_mesh]
        surface, row = np.unique(surface, return_inverse=True)
        clip = camera.clip_start, camera.clip_end
        contest = Contest(some, self._planes, len(scene.instances), *clip, self._around)
        names = self._names_of(surface)
        triangles = WorldTriangles(world_corners(scene, *names), *names)
        # Ray by ray, and once each: a triangle of unknown sign has two footprints.
        ray, row = np.divmod(np.unique(ray * len(surface) + row), max(1, len(surface)))
        for first in range(0, len(ray), _PAIRS):
            part = slice(first, first + _PAIRS)
            contest.enter(Pairs(ray[part], row[part], triangles))
            yield 1.0
        found = yield from contest.hits(self._statistics)
        hits.t[which], hits.instance[which] = found.t, found.instance
        hits.triangle[which], hits.s[:, which] = found.triangle, found.s
        hits.certainty[which] = found.certainty
        hits.ties.update((int(which[k]), names) for k, names in found.ties.items())


def _slabs(
    seen: Index, nearest: NDArray[np.float64], low: Index, high: Index
) -> tuple[list[Index], int, int]:
    """Split the triangles that are seen into slabs, from the front to the back.

    Each holds about as many pixels of boxes as the union of all boxes has: so there are as many
    slabs as surfaces lie behind one another, and what a refreshed depth buffer may save is worth
    its price. Returns the rows y0 <= y < y1 of that union, too.
    """
    (x0, y0), (x1, y1) = low.take(seen, axis=1), high.take(seen, axis=1)
    nearest = nearest.take(seen)
    bottom, top = int(y0.min()), int(y1.max()) + 1
    area = np.multiply(x1 - x0 + 1, y1 - y0 + 1, dtype=np.float32)
    union = (int(x1.max()) + 1 - int(x0.min())) * (top - bottom)
    count = min(int(area.sum(dtype=np.float64) / union), _BINS - 1)
    if count < 1:
        return [seen], bottom, top
    first, last = nearest.min(), nearest.max()
    scale = (_BINS - 1) / (last - first) if last > first else 0.0
    depth = ((last - nearest) * scale).astype(np.uint8)
    area = np.cumsum(np.bincount(depth, area, _BINS))
    slab = (area * (count / area[-1])).astype(np.uint8)[depth]
    order = np.argsort(slab, kind="stable")
    ends = np.cumsum(np.bincount(slab))[:-1]
    return [seen.take(part) for part in np.split(order, ends) if len(part)], bottom, top


def _joined(parts: Sequence[Covered]) -> Covered:
    return Covered(
        *(np.concatenate(f) for f in zip(*(vars(p).values() for p in parts), strict=True))
    )


def _smallest(first: NDArray, *others: NDArray) -> NDArray:
    for other in others:
        first = np.minimum(first, other)
    return first


def _largest(first: NDArray, *others: NDArray) -> NDArray:
    for other in others:
        first = np.maximum(first, other)
    return first


def _used(number: Index, count: int) -> tuple[Index, Index]:
    """Return which of `count` numbers occur, and where each of `number` is among them.

    In the order in which they occur first: neighbours in the picture are neighbours in memory.
    """
    if count > 8 * len(number):
        return np.unique(number, return_inverse=True)
    every = np.arange(len(number), dtype=np.int32)
    first = np.empty(count, np.int32)
    first[number[::-1]] = every[::-1]
    used = number.take(np.flatnonzero(first.take(number) == every))
    first[used] = every[: len(used)]
    return used, first.take(number)


def world_corners(scene: Scene, instance: Index, triangle: Index) -> NDArray[np.float64]:
    """Return the corners of named triangles in world space, (3, 3, m): corner, component."""
    out = np.empty((3, 3, len(instance)))
    groups = [slice(None)]
    if len(instance) and (instance[0] != instance).any():
        of = scene.instance_meshes[instance]
        groups = [np.flatnonzero(of == mesh) for mesh in np.unique(of)]
    with np.errstate(over="ignore", invalid="ignore"):
        for rows in groups:
            own, which = instance[rows], triangle[rows]
            if not len(own):
                continue
            one = bool((own == own[0]).all())
            matrices = scene.instance_matrices[..., own[:1] if one else own]
            mesh = scene.meshes[scene.instances[own[0]].mesh]
            corners = mesh.triangles.take(which, axis=0)
            for corner in range(3):
                local = mesh.vertices.take(corners[:, corner], axis=0).T
                out[corner][:, rows] = transform_points(matrices, local)
    return out
