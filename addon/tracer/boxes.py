"""The pixels of boxes on the film, listed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Index, Integers, groups
from .vector import spread

if TYPE_CHECKING:
    from ..scene import Region


def pairs(
    bounds: Integers, tile: Region, limit: int, before: Index | None = None
) -> Iterator[tuple[Index, Index]]:
    """List the pixels of boxes within a tile, about `limit` at most at a time.

    Yields the numbers of pixels in the tile, and columns of `bounds`, (p,) each. `before` (n + 1,)
    says how many wanted pixels come before each pixel, and in all: then only these are numbered.
    """
    x0, x1, y0, y1 = bounds
    some = np.flatnonzero((x0 < x1) & (y0 < y1))
    # A run is one row of one box: first find its triangle and row, then its pixels.
    triangle, row = spread(some, (y1 - y0)[some])
    row += y0[triangle]
    start = (row - tile.y0) * tile.width + (x0[triangle] - tile.x0)
    length = (x1 - x0)[triangle]
    if before is not None:
        end = before[start + length]
        start = before[start]
        length = end - start
    for first, last in groups(length, limit):
        run, step = spread(np.arange(first, last), length[first:last])
        yield start[run] + step, triangle[run]
