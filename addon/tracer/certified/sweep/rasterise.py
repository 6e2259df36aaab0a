"""Which pixels triangles cover: their edge functions, evaluated where they may be inside.

In come edge functions with the boxes of pixels that they may cover; out go pairs of a pixel and a
triangle that the ray may hit. A box is evaluated as a block, pixel by pixel. One that is larger
than a cell of the depth buffer is split into cells first, and cells that an edge rules out, or that
lie behind what is in the depth buffer already, are dropped as a whole. Floating-point addition and
multiplication are monotone: what holds at a cell's corner holds, to the last bit, at all of its
pixels.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...vector import Arrays, Index, gather, groups, spread
from .depth_buffer import COARSE, FINE, DepthBuffer
from .edge_functions import EdgeFunctions

_VALUES = 1 << 14  # pixels
_CELLS = 1 << 14  # cells tested together
# Boxes are evaluated in blocks of few sizes, by their extent less 1: what is done for each block
# weighs more than a few pixels in vain.
_PADDED = np.array([1, 2, 3, 4, 6, 6, 8, 8], np.uint8)
LARGE_SHAPE = np.uint8(255)  # the shape of what is larger than a cell of FINE pixels


@dataclass(frozen=True, eq=False)
class Boxes:
    """b boxes of pixels: `low` and `high`, (2, b) x and y each, both included, in the region.

    `owner` (b,) says whose edge functions each has; None if each has its own, in their order.
    """

    owner: Index | None
    low: Index
    high: Index

    def take(self, index: Index | slice) -> Boxes:
        """Return those at `index`."""
        owner = index if self.owner is None else self.owner[index]
        return Boxes(owner, self.low[:, index], self.high[:, index])

    @property
    def shape(self) -> NDArray[np.uint8]:
        """Which size of block each is evaluated in, (b,): 16 height + width, or LARGE_SHAPE."""
        width, height = self.high - self.low
        large = np.maximum(width, height) >= FINE
        shape = _PADDED.take(height, mode="clip") * np.uint8(16) + _PADDED.take(width, mode="clip")
        return np.where(large, LARGE_SHAPE, shape)


@dataclass(frozen=True, eq=False)
class Rasterised(Arrays):
    """p pairs whose ray may hit: (p,) each.

    `least` is the smallest of the three edge functions, `nearness` the fourth.
    """

    pixel: Index
    owner: Index
    least: NDArray[np.float64]
    nearness: NDArray[np.float64]


def rasterised(
    found: EdgeFunctions, boxes: Boxes, shape: NDArray[np.uint8], depths: DepthBuffer
) -> Iterator[Rasterised]:
    """Yield the pairs of boxes that are no larger than a cell, sorted by their shape."""
    starts = np.flatnonzero(np.diff(shape, prepend=np.uint8(0)))
    for start, end in pairwise([*starts.tolist(), len(shape)]):
        h, w = divmod(int(shape[start]), 16)
        together = max(1, _VALUES // (h * w))
        for first in range(start, end, together):
            part = slice(first, min(first + together, end))
            yield _block(found, boxes.take(part), h, w, depths)


def _block(found: EdgeFunctions, boxes: Boxes, h: int, w: int, depths: DepthBuffer) -> Rasterised:
    """Evaluate boxes that are at most h pixels high and w wide."""
    owner, region = boxes.owner, depths.region
    own = found.take(owner)
    of_1, of_y, of_x = own.coefficients
    x, y = low = boxes.low
    last_x, last_y = boxes.high - low
    x0, y0 = low + (np.array([[region.x0], [region.y0]]) - own.origin)
    right = x0 + np.arange(w, dtype=np.float64)[:, None]  # (w, b)
    up = y0 + np.arange(h, dtype=np.float64)[:, None]
    for k in range(1, w):  # what a block has beyond its box is not covered, as NaN is not inside
        right[k, last_x < k] = np.nan
    for k in range(1, h):
        up[k, last_y < k] = np.nan
    rows = of_1[:, None] + of_y[:, None] * up  # (4, h, b)
    across = of_x[:, None] * right  # (4, w, b)
    least = rows[0, :, None] + across[0]  # (h, w, b)
    other = np.empty_like(least)
    for k in (1, 2):
        np.minimum(least, np.add(rows[k, :, None], across[k], out=other), out=least)
    inside = np.flatnonzero(least >= -own.edge_error)
    nearness = np.add(rows[3, :, None], across[3], out=other)
    stride = np.int32(depths.stride)
    steps = np.arange(h, dtype=np.int32)[:, None] * stride + np.arange(w, dtype=np.int32)
    pixel = steps[..., None] + (y.astype(np.int32) * stride + x)
    row = inside % low.shape[1]
    return Rasterised(
        gather(pixel.ravel(), inside),
        row + owner.start if isinstance(owner, slice) else gather(owner, row),
        gather(least.ravel(), inside),
        gather(nearness.ravel(), inside),
    )


def split(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer) -> Iterator[Boxes]:
    """Yield the parts of boxes in those cells of FINE pixels which may be covered and seen."""
    for coarse in cells(found, boxes, depths, COARSE):
        yield from cells(found, coarse, depths, FINE)


def cells(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer, size: int) -> Iterator[Boxes]:
    """Yield the parts of boxes in those cells of this size which may be covered and seen."""
    first, last = boxes.low // size, boxes.high // size
    columns, rows = (last - first + 1).astype(np.intp)
    for start, end in groups(columns * rows, _CELLS):
        which, number = spread(np.arange(start, end), (columns * rows)[start:end])
        row, column = np.divmod(number, columns.take(which))
        cell = first.take(which, axis=1) + np.stack((column, row)).astype(first.dtype)
        low = np.maximum(boxes.low.take(which, axis=1), cell * size)
        high = np.minimum(boxes.high.take(which, axis=1), cell * size + (size - 1))
        some = Boxes(boxes.owner.take(which), low, high)
        yield some.take(_may_be_seen(found, some, depths.farthest(*cell, size), depths))


def _may_be_seen(
    found: EdgeFunctions, boxes: Boxes, farthest: NDArray[np.float64], depths: DepthBuffer
) -> Index:
    """Return which boxes no edge rules out, and what is in the depth buffer does not hide."""
    of_1, of_y, of_x = gather(found.coefficients, boxes.owner)
    region = depths.region
    origin = gather(found.origin, boxes.owner)
    low = boxes.low + (np.array([[region.x0], [region.y0]]) - origin)
    high = low + (boxes.high - boxes.low)
    most = of_1 + of_y * np.where(of_y > 0, high[1], low[1])
    most = most + of_x * np.where(of_x > 0, high[0], low[0])
    least = np.minimum(np.minimum(most[0], most[1]), most[2])
    nearest = most[3] + found.nearness_error.take(boxes.owner)
    out = (least < -found.edge_error.take(boxes.owner)) | (nearest < farthest)
    return np.flatnonzero(~out)
