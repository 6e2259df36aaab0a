"""Which pixels triangles cover: their edge functions, evaluated where they may be inside.

In come edge functions with the boxes of pixels that they may cover; out go pairs of a pixel and a
triangle that the ray may hit. A box is evaluated pixel by pixel. One that is larger
than a cell of the depth buffer is split into cells first, and cells that an edge rules out, or that
lie behind what is in the depth buffer already, are dropped as a whole. Floating-point addition and
multiplication are monotone: what holds at a cell's corner holds, to the last bit, at all of its
pixels.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...tracer.vector import Arrays, Floats, Index, gather, groups, parts, spread
from .depth_buffer import COARSE, FINE, DepthBuffer
from .edge_functions import EdgeFunctions

_BOXES = 1 << 8  # evaluated together
_CELLS = 1 << 14  # tested together


@dataclass(frozen=True, eq=False)
class Boxes(Arrays):
    """b boxes of pixels: `low` and `high`, (2, b) x and y each, both included, in the region.

    `owner` (b,) says whose edge functions each has.
    """

    owner: Index
    low: Index
    high: Index

    @property
    def size(self) -> Index:
        """The longer side of each, less 1, (b,)."""
        return np.maximum(*(self.high - self.low))


@dataclass(frozen=True, eq=False)
class Covered(Arrays):
    """p pairs of a pixel of a depth buffer and a triangle whose ray may hit, (p,) each.

    `owner` is the triangle; the hit's nearness is between `least` and `most`; `sure` says whether
    there is one for sure.
    """

    pixel: Index
    owner: Index
    least: Floats
    most: Floats
    sure: NDArray[np.bool_]


def rasterised(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer) -> Iterator[Covered]:
    """Yield the pairs of boxes that are no larger than a cell."""
    # Of about one size, as they are evaluated together.
    boxes = boxes.take(np.argsort(boxes.size, kind="stable"))
    for part in parts(len(boxes), _BOXES):
        yield _block(found, boxes.take(part), depths)


def _block(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer) -> Covered:
    """Evaluate some boxes in blocks of one size."""
    own = found.take(boxes.owner)
    of_1, of_y, of_x = own.coefficients
    x, y = low = boxes.low
    last_x, last_y = boxes.high - low
    x0, y0 = low + (depths.corner - own.origin)
    across, upwards = (np.arange(last.max() + 1)[:, None] for last in (last_x, last_y))
    # What a block has beyond its box is not covered, as NaN is not inside.
    right = np.where(across <= last_x, x0 + across, np.nan)  # (w, b)
    up = np.where(upwards <= last_y, y0 + upwards, np.nan)  # (h, b)
    rows = of_1[:, None] + of_y[:, None] * up  # (4, h, b)
    columns = of_x[:, None] * right  # (4, w, b)
    least = rows[0, :, None] + columns[0]  # (h, w, b)
    other = np.empty_like(least)
    for k in (1, 2):
        np.minimum(least, np.add(rows[k, :, None], columns[k], out=other), out=least)
    inside = np.flatnonzero(least >= -own.edge_error)
    np.add(rows[3, :, None], columns[3], out=other)
    stride = np.int32(depths.stride)
    first = y.astype(np.int32) * stride + x
    pixel = (upwards[:, None] * stride + across).astype(np.int32) + first
    row = inside % len(boxes)
    nearness, error = gather(other.ravel(), inside), gather(own.nearness_error, row)
    return Covered(
        gather(pixel.ravel(), inside),
        gather(boxes.owner, row),
        nearness - error,
        np.minimum(nearness + error, gather(own.nearest, row)),
        (gather(least.ravel(), inside) > gather(own.edge_error, row)) & gather(own.sure, row),
    )


def split(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer) -> Iterator[Boxes]:
    """Yield boxes no larger than a cell of FINE pixels; of others their parts in such cells.

    Only in those which may be covered and seen.
    """
    is_small = boxes.size < FINE
    yield boxes.take(np.flatnonzero(is_small))
    for coarse in cells(found, boxes.take(np.flatnonzero(~is_small)), depths, COARSE):
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
    low = boxes.low + (depths.corner - gather(found.origin, boxes.owner))
    high = low + (boxes.high - boxes.low)
    most = of_1 + of_y * np.where(of_y > 0, high[1], low[1])
    most = most + of_x * np.where(of_x > 0, high[0], low[0])
    least = np.minimum(np.minimum(most[0], most[1]), most[2])
    nearest = most[3] + found.nearness_error.take(boxes.owner)
    out = (least < -found.edge_error.take(boxes.owner)) | (nearest < farthest)
    return np.flatnonzero(~out)
