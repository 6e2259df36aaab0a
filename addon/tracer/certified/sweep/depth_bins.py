"""Triangles from the front to the back, in depth bins: how many is the scene's own number."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

BINS = 256  # of nearness, into which triangles are sorted

Index = NDArray[np.integer]


def by_depth(
    seen: Index, nearest: NDArray[np.float64], low: Index, high: Index
) -> tuple[list[Index], int, int]:
    """Split the triangles that are seen into depth bins, from the front to the back.

    Each holds about as many pixels of boxes as the union of all boxes has: so there are as many
    bins as surfaces lie behind one another, and what a refreshed depth buffer may save is worth
    its price. Returns the rows y0 <= y < y1 of that union, too.
    """
    (x0, y0), (x1, y1) = low.take(seen, axis=1), high.take(seen, axis=1)
    nearest = nearest.take(seen)
    bottom, top = int(y0.min()), int(y1.max()) + 1
    area = np.multiply(x1 - x0 + 1, y1 - y0 + 1, dtype=np.float32)
    union = (int(x1.max()) + 1 - int(x0.min())) * (top - bottom)
    count = min(int(area.sum(dtype=np.float64) / union), BINS - 1)
    if count < 1:
        return [seen], bottom, top
    first, last = nearest.min(), nearest.max()
    scale = (BINS - 1) / (last - first) if last > first else 0.0
    depth = ((last - nearest) * scale).astype(np.uint8)
    area = np.cumsum(np.bincount(depth, area, BINS))
    own = (area * (count / area[-1])).astype(np.uint8)[depth]
    order = np.argsort(own, kind="stable")
    ends = np.cumsum(np.bincount(own))[:-1]
    return [seen.take(part) for part in np.split(order, ends) if len(part)], bottom, top
