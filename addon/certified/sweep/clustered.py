"""Leaves out clusters of triangles that no pixel sees, before any of their vertices is projected.

A linear function f of object space is between f(middle) - h and f(middle) + h in a cluster's box,
where h sums half a side of the box times f's |slope| along each axis. So w is at least W. With X
the film position of the middle, p - X w is a linear function, too: nothing of the cluster appears
farther from X along x than h / W. The same holds for q.

All of this is off by less than `place` and `weight` of `film.py`, as it is computed from numbers of
at most the same size. What is computed of a vertex is off by that, too, and the box of its pixels
is widened by it once more. Here they count _ERRORS times. So no triangle has a pixel in its box
that its cluster does not have in its own, and none is nearer than the cluster: what is left out
here has no pixel for `boxes_of`, or is hidden by the same depth buffer, and changes no result.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...arrays import Bools, Floats, Index, Integers
from ...scene import Region, Scene
from ...tracer.vector import grouped
from .chunks import Chunk
from .clusters import SIZE, Clusters
from .depth_buffer import DepthBuffer
from .film import Film

_ERRORS = 8.0  # how often the error of a vertex counts: three times would do
_ROUNDING = 2.0**-20  # pixels: more than film positions lose when they are rounded
_TILE = 32  # pixels along the side of a tile
_LAYERS = 6.0, 24.0  # of boxes, between a bin and the next: some six boxes cover as one surface
_DEEP = 128.0  # layers of boxes
_SHARE = 0.5  # of clusters
SAMPLE = 16  # every so many clusters are looked at first


@dataclass(frozen=True, eq=False)
class Clustered:
    """Some clusters of a chunk's instances on a camera's film, k in all.

    `instances` (k,) and `numbers` (k,) name them. They cover only pixels of a region from `low` to
    `high`, (2, k) x and y, both included, counted from its corner. `area` (k,) is that of their
    boxes without any margin, in pixels; 0 where it is not known. `nearest` (k,) bounds the nearness
    (`edge_functions.py`) from above. `in_view` (k,) is False where no pixel can be covered.
    """

    scene: Scene
    chunk: Chunk
    instances: Integers
    numbers: Index
    low: Floats
    high: Floats
    area: Floats
    nearest: Floats
    in_view: Bools

    @classmethod
    def of(
        cls,
        scene: Scene,
        film: Film,
        region: Region,
        chunk: Chunk,
        clusters: dict[int, Clusters],
        step: int = 1,
    ) -> Clustered:
        """Project clusters: every `step`-th of those of a chunk. They are given by mesh."""
        own = [clusters[k] for k in scene.instance_meshes[chunk.instances].tolist()]
        first = chunk.first // SIZE
        end = None if chunk.last is None else -(-chunk.last // SIZE)
        some = slice(first, end, step)
        middle = np.concatenate([c.middle[:, some] for c in own], axis=1)
        half = np.concatenate([c.half[:, some] for c in own], axis=1)
        numbers = [np.arange(len(c))[some] for c in own]
        which = np.repeat(np.arange(len(own)), [len(n) for n in numbers])
        rows, size = film.rows(scene)
        size = _ERRORS * size
        of = chunk.instances if len(own) == 1 else chunk.instances[which]
        rows, size = rows[..., of], size[of]

        def span(row: Floats) -> tuple[Floats, Floats]:
            """Return a linear function in the middle, and how far it is from that elsewhere."""
            x, y, z = row[:3]
            at = x * middle[0] + y * middle[1] + z * middle[2] + row[3]
            return at, np.abs(x) * half[0] + np.abs(y) * half[1] + np.abs(z) * half[2]

        *across, w, depth = rows
        scale, more = span(w)
        least = scale - more
        constant, slope = film.place
        far = 2.0 * max(film.camera.width, film.camera.height)
        margin = (_ERRORS * constant + (slope + far * film.weight) * size) / least + _ROUNDING
        clear = (least > 2.0**11 * film.weight * size) & (margin < far)
        in_view = ~(scale + more < -film.weight * size)  # `pixel_bounds`: what is behind the eye
        places = []
        for row in across:
            # Far beside the picture it does not matter where: X is any film position.
            at = np.clip(span(row)[0] / scale, -far, far)
            reach = span(row - at * w)[1] / least
            clear &= np.isfinite(at) & np.isfinite(reach)  # else a number has overflowed
            places.append((at, reach))
        low, high = np.empty((2, 2, len(scale)))
        area = clear.astype(np.float64)
        ends = (region.x0, region.x1), (region.y0, region.y1)
        for axis, ((at, reach), (start, end)) in enumerate(zip(places, ends, strict=True)):
            area *= np.where(clear, np.minimum(2 * reach, end - start), 1.0)
            reach += margin
            low[axis] = np.where(clear, np.ceil(at - reach - 0.5), start)
            high[axis] = np.where(clear, np.floor(at + reach - 0.5), end - 1)
            low[axis] = np.maximum(low[axis], start) - start
            high[axis] = np.minimum(high[axis], end - 1) - start
            in_view &= low[axis] <= high[axis]
        deep, more = span(depth)
        nearest = film.nearest(deep - more, size)
        nearest = np.where(clear & (nearest < np.inf), nearest, np.inf)
        names = chunk.instances[which], np.concatenate(numbers)
        return cls(scene, chunk, *names, low, high, area, nearest, in_view)

    @cached_property
    def layers(self) -> float:
        """How many boxes are behind one another, on average."""
        low, high = self.low[:, self.in_view], self.high[:, self.in_view]
        width, height = high.max(axis=1, initial=0) - low.min(axis=1, initial=np.inf) + 1
        return float(self.area[self.in_view].sum() / (width * height))

    def pay(self) -> bool:
        """Whether so much may be left out that clusters are worth their price.

        These are every SAMPLE-th of a chunk's.
        """
        return SAMPLE * self.layers > _DEEP or self.in_view.mean() < _SHARE

    def bins(self) -> Iterator[Index]:
        """Yield the clusters in view; if there are many layers, those in front come first.

        Clusters are sorted by nearness in each tile of the picture, where the middle of their box
        is. The boxes of those before a cluster cover its tile so many times: that is its layer.
        """
        seen = np.flatnonzero(self.in_view)
        if self.layers <= _DEEP:
            yield seen
            return
        x, y = (self.low + self.high)[:, seen] // (2 * _TILE)
        tile = y * (x.max(initial=0) + 1) + x
        order = np.lexsort((-self.nearest[seen], tile))
        area = self.area[seen[order]]
        layer = np.cumsum(area) - area
        first = np.flatnonzero(np.diff(tile[order], prepend=-1))
        layer -= np.repeat(layer[first], np.diff(first, append=len(tile)))
        number = np.searchsorted(_LAYERS, layer / _TILE**2, side="right")
        for members in grouped(number, len(_LAYERS) + 1):
            yield seen[order[members]]

    def not_hidden(self, some: Index, depths: DepthBuffer) -> Index:
        """Return those of some clusters that a depth buffer does not surely hide."""
        low, high = self.low[:, some], self.high[:, some]
        farthest = depths.farthest_over(low.astype(np.int32), high.astype(np.int32))
        return some[~(self.nearest[some] < farthest)]

    def triangles(self, some: Index) -> Iterator[tuple[int, Integers]]:
        """Yield the triangles of some clusters, instance by instance."""
        some = np.sort(some)
        starts = np.flatnonzero(np.diff(self.instances[some])) + 1
        for members in np.split(some, starts):
            instance = int(self.instances[members[0]])
            count = len(self.scene.meshes[self.scene.instances[instance].mesh].triangles)
            last = count if self.chunk.last is None else self.chunk.last
            own = (self.numbers[members, None] * SIZE + np.arange(SIZE)).ravel().astype(np.int32)
            yield instance, own[(own >= self.chunk.first) & (own < last)]
