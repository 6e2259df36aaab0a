"""Sorts triangles into depth bins, from the front to the back."""

from __future__ import annotations

import numpy as np

from ...arrays import Bytes, Floats, Index, parts
from ...tracer.vector import gather, grouped

BINS = 256  # intervals of nearness that the depth bins are made of
_GROWTH = 1.2  # by how much each depth bin is larger than the one before
_FIRST = 0.5  # the area of the first depth bin: a box is larger than its triangle
_SAMPLE = 1 << 14  # triangles, about, from which depth bins are estimated
_TOGETHER = 1 << 15  # triangles at a time


def by_depth(seen: Index, nearest: Floats, low: Index, high: Index) -> list[Index]:
    """Split the triangles `seen` into depth bins, from the front to the back.

    The boxes of the first bin have somewhat fewer pixels than the union of all boxes: about as many
    as a surface that covers it all. Every other bin is larger than the one before: the more lies in
    front, the less is left to be hidden. So the number of bins is about the logarithm of the number
    of surfaces behind one another, and refreshing the depth buffer is worth its price. All this is
    estimated from some thousand triangles.
    """
    step = 1 + len(seen) // _SAMPLE
    some = seen[::step]
    x0, y0 = low.take(some, axis=1)
    x1, y1 = high.take(some, axis=1)
    area = np.multiply(x1 - x0 + 1, y1 - y0 + 1, dtype=np.float32)
    union = _FIRST * (int(x1.max()) + 1 - int(x0.min())) * (int(y1.max()) + 1 - int(y0.min()))
    if step * area.sum(dtype=np.float64) < 2 * union or BINS < 3:
        return [seen]
    near = nearest.take(some)
    first = np.min(near)
    last = np.max(near)
    scale = (BINS - 1) / (last - first) if last > first else 0.0

    def depth(nearness: Floats) -> Bytes:
        return np.clip((last - nearness) * scale, 0, BINS - 1).astype(np.uint8)

    before = np.cumsum(np.bincount(depth(near), area, BINS)) * (step / union)
    of_depth = (np.log1p(before * (_GROWTH - 1)) / np.log(_GROWTH)).astype(np.uint8)
    own = np.empty(len(seen), np.uint8)
    for part in parts(len(seen), _TOGETHER):
        own[part] = of_depth.take(depth(gather(nearest, seen[part])))
    bins = grouped(own, int(of_depth[-1]) + 1)
    return [seen.take(part) for part in bins if len(part)]
