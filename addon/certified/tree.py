"""A tree of boxes: which of many items each of any rays may meet.

An item is dropped only if the ray certainly misses its box, whatever is rounded: that is argued
here, by hand. The rays are certified's, where a triangle that is left is decided by `ladder.py`, or
those of a diagnosis, which needs no proof.

A box holds what is in it as it is: nothing of it is rounded. A ray is within it for the t between
near and far, (side - o) / d along each axis. The quotients are off by three roundings each, and d
by a power of two that is exact: `_LOOSE` is five times that. Where d is 0 along an axis, the ray is
within if its origin is. Where d is next to 0, so that 1 / d might overflow, nothing is dropped
along that axis. A ray that was moved infinitesimally (`exact.py`) meets no triangle whose closed
box the ray itself misses.

Products that underflow are off by 2^-1075 each: `TINY` is far above. What overflows is infinite or
NaN, and drops nothing: all comparisons with it are false.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Bools, Floats, Index, Places, parts
from ..tracer.camera import Rays
from ..tracer.vector import Arrays
from .bounds import U

WIDE = 8  # children of a node: a cache line of float64
TOGETHER = 1 << 12  # nodes that are tested together: their temporaries stay in a core's cache
_MANY = 1 << 20  # pairs of a ray and a node that are listed together, at most
_LOOSE = 16 * U
TINY = 2.0**-1060
_MOST = 2.0**1022
_LEAST = 2.0**-500  # of |d| along an axis, the largest being 1 to 2


@dataclass(frozen=True, eq=False)
class Crossed(Arrays):
    """Pairs of a ray and an item, where the ray may cross the item's box, (p,)."""

    ray: Index
    item: Index
    near: Floats  # where the ray enters the box, in the t of `BoxRays`


@dataclass(frozen=True, eq=False)
class BoxRays:
    """n rays, as a test takes them: d is scaled by a power of two, its largest |d| 1 to 2."""

    origins: Floats  # (3, n)
    directions: Floats  # (3, n), scaled
    exponent: Index  # (n,): the scaled t is 2^exponent t
    inverse: Floats  # (3, n) 1 / d; of any size where |d| is below _LEAST
    steep: Bools  # (3, n): |d| is below _LEAST, or 0
    still: Bools  # (3, n): d is 0
    backward: Places  # (3, n) 1 where d is negative, else 0
    start: Floats  # (n,) of the clip range, in the scaled t
    end: Floats

    @classmethod
    @np.errstate(all="ignore")  # what overflows drops nothing
    def of(cls, rays: Rays, start: float, end: Floats | float) -> BoxRays:
        """Prepare finite rays, which meet what has start <= t <= end."""
        count = rays.count
        own = np.broadcast_to(rays.directions, (3, count))
        exponent = np.frexp(np.abs(own).max(axis=0))[1] - 1
        d = np.ldexp(own, -exponent)
        steep = np.abs(d) < _LEAST
        return cls(
            np.ascontiguousarray(np.broadcast_to(rays.origins, (3, count))),
            d,
            exponent,
            1 / np.where(steep, 1.0, d),
            steep,
            own == 0,
            (d < 0).astype(np.intp),
            np.ldexp(np.full(count, start), exponent),
            np.ldexp(end, exponent),
        )


@dataclass(frozen=True, eq=False)
class Tree:
    """The nodes of some trees, each with the boxes around WIDE nodes or items."""

    boxes: Floats  # (6, n, WIDE): of the children the low x, y and z, then the high ones
    children: Index  # (n, WIDE): how many nodes after its own a child is; or items; -1 of none
    is_last: Bools  # (n,) whether the children are items
    roots: Places  # (k,) of k trees; -1 of one without an item

    @classmethod
    def of(cls, boxes: Floats, items: Index) -> Tree:
        """Build a tree of items from their boxes, (6, m); `items` (m,) has their numbers."""
        order = neighbours(boxes)
        boxes = boxes.take(order, axis=1)
        items = np.where(order < 0, -1, items.take(order))  # -1 is never met
        levels: list[Tree] = []
        while boxes.size and (boxes.shape[1] > 1 or not levels):
            missing = -boxes.shape[1] % WIDE
            empty = np.repeat(((np.inf,), (-np.inf,)), 3, axis=0)
            boxes = np.concatenate((boxes, np.repeat(empty, missing, axis=1)), axis=1)
            children = np.append(items, np.full(missing, -1)).reshape(-1, WIDE)
            count = len(children)
            if levels:
                children[children >= 0] += np.repeat(count - np.arange(count), WIDE)[: len(items)]
            is_last = np.full(count, not levels)
            levels.append(cls(boxes.reshape(6, count, WIDE), children, is_last, np.zeros(0, int)))
            boxes, items = around(levels[-1].boxes), np.arange(count)
        return replace(cls.joined(levels[::-1]), roots=np.array([0 if levels else -1]))

    @classmethod
    def joined(cls, trees: Sequence[Tree]) -> Tree:
        """Return some trees as one record; their items keep their numbers."""
        starts = np.cumsum([0, *(len(tree.is_last) for tree in trees)])
        roots = [
            np.where(t.roots < 0, -1, t.roots + s) for t, s in zip(trees, starts, strict=False)
        ]
        return cls(
            np.concatenate([np.zeros((6, 0, WIDE)), *(t.boxes for t in trees)], axis=1),
            np.concatenate([np.zeros((0, WIDE), int), *(t.children for t in trees)]),
            np.concatenate([np.zeros(0, bool), *(t.is_last for t in trees)]),
            np.concatenate([np.zeros(0, int), *roots]),
        )

    def crossed(self, rays: BoxRays, ray: Index, node: Index) -> Iterator[Crossed]:
        """Yield the items that p rays may meet, each below the root of one of the trees."""
        # Without a direction a ray meets nothing, not even a box.
        some = np.flatnonzero((node >= 0) & ~rays.still.all(axis=0)[ray])
        todo = [(ray[some], node[some])]
        while todo:
            ray, node = todo.pop()
            todo += [(ray[some], node[some]) for some in parts(len(ray), _MANY)[1:]]
            few = parts(min(len(ray), _MANY), TOGETHER)
            found = [self._entered(rays, ray[part], node[part]) for part in few]
            if found:
                ray, node, child, near = (np.concatenate(each) for each in zip(*found, strict=True))
                last = self.is_last[node]
                yield Crossed(ray[last], child[last], near[last])
                if not last.all():
                    todo.append((ray[~last], (node + child)[~last]))

    @np.errstate(all="ignore")
    def _entered(
        self, rays: BoxRays, ray: Index, node: Index
    ) -> tuple[Index, Index, Index, Floats]:
        """Return the children that p rays may meet of p nodes: rays, nodes, children, and near."""
        boxes, count = self.boxes.reshape(-1, WIDE), len(self.is_last)
        near = np.repeat(rays.start[ray][:, None], WIDE, axis=1)
        far = np.repeat(rays.end[ray][:, None], WIDE, axis=1)
        for axis in range(3):
            origin, inverse = rays.origins[axis][ray][:, None], rays.inverse[axis][ray][:, None]
            backward = rays.backward[axis][ray]
            first = boxes.take((axis + 3 * backward) * count + node, axis=0)
            last = boxes.take((axis + 3 - 3 * backward) * count + node, axis=0)
            for side in (first, last):
                side -= origin
                side *= inverse
            steep = np.flatnonzero(rays.steep[axis][ray])
            if len(steep):
                own = ray[steep]
                low, high = self.boxes[axis::3, node[steep]]
                at = rays.origins[axis][own][:, None]
                beside = rays.still[axis][own][:, None] & ~((low <= at) & (at <= high))
                first[steep] = np.where(beside, np.inf, -np.inf)
                last[steep] = np.inf
            np.fmax(near, first, out=near)  # NaN, of 0 x inf, bounds nothing
            np.fmin(far, last, out=far)
        np.fmin(near, _MOST, out=near)  # else inf, of an empty box, is beyond no slack
        np.fmax(far, -_MOST, out=far)
        slack = _LOOSE * np.abs(near) + _LOOSE * np.abs(far) + TINY
        children = self.children.take(node, axis=0)
        row, place = np.nonzero(~(near - far > slack) & (children >= 0))
        return ray[row], node[row], children[row, place], near[row, place]


def around(boxes: Floats) -> Floats:
    """Return the box around each row of boxes: (6, k) of (6, k, WIDE)."""
    return np.concatenate((boxes[:3].min(axis=2), boxes[3:].max(axis=2)))


@np.errstate(all="ignore")  # any order is right
def neighbours(boxes: Floats) -> Index:
    """Return the numbers of m boxes (6, m), neighbours together: of each half, of its halves ...

    Each part is halved, or first cut in three, along the axis in which it is widest. So that parts
    are equally large, there are a few more numbers, which are -1.
    """
    count = boxes.shape[1]
    cuts = _cuts(-(-count // WIDE))
    total = WIDE * math.prod(cuts) if count else 0
    middle = np.pad(0.5 * boxes[:3] + 0.5 * boxes[3:], ((0, 0), (0, total - count)), "edge")
    order = np.arange(total)[None]
    for cut in cuts if count else ():
        along = middle.take(order, axis=1)
        widest = (along.max(axis=2) - along.min(axis=2)).argmax(axis=0)
        key = np.take_along_axis(along, widest[None, :, None], axis=0)[0]
        size = order.shape[1] // cut
        place = np.argpartition(key, [size * k for k in range(1, cut)], axis=1)
        order = np.take_along_axis(order, place, axis=1).reshape(-1, size)
    return np.where(order < count, order, -1).reshape(-1)


def _cuts(leaves: int) -> list[int]:
    """Return how parts are cut, so that there are at least `leaves`, and few more."""
    sizes = []
    for threes in range(6):
        twos = max(0, math.ceil(math.log2(max(leaves, 1) / 3**threes)))
        sizes.append((3**threes * 2**twos, [3] * threes + [2] * twos))
    return min(sizes)[1]
