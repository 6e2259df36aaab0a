"""Rasterises triangles: evaluates their edge functions in the pixels that they may cover.

A box of pixels that is larger than a cell of the depth buffer is split into cells. A cell that an
edge rules out, or that the depth buffer hides, is dropped as a whole. Floating-point addition and
multiplication are monotone, so that what holds at a cell's corner holds, to the last bit, at all of
its pixels. The boxes that are left are evaluated pixel by pixel.

References: Greene, "Hierarchical polygon tiling with coverage masks", SIGGRAPH 1996, for cells that
are tested as a whole. Theorems: `SweepPixels.block_right`, `SweepPixels.may_be_seen_right`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Index, groups, parts
from ...tracer.vector import Arrays, gather, spread
from .depth_buffer import COARSE, FINE, DepthBuffer
from .edge_functions import EdgeFunctions

_VALUES = 1 << 15  # pixels of boxes evaluated together
_CELLS = 1 << 14  # cells tested together


@dataclass(frozen=True, eq=False)
class Boxes(Arrays):
    """b boxes of pixels of a region, from `low` to `high`, (2, b) x and y each, both included.

    `owner` (b,) is the number of the edge functions of each.
    """

    owner: Index
    low: Index
    high: Index

    @property
    def size(self) -> Index:
        """The longer side of each in pixels, minus 1, (b,)."""
        return np.maximum(*(self.high - self.low))


@dataclass(frozen=True, eq=False)
class Covered(Arrays):
    """p pairs of a pixel of a depth buffer and a triangle that its ray may meet, (p,) each.

    `owner` is the triangle. The nearness of the hit is between `least` and `most`. `sure` says
    whether the ray surely meets it.
    """

    pixel: Index
    owner: Index
    least: Floats
    most: Floats
    sure: Bools


def rasterised(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer) -> Iterator[Covered]:
    """Yield the pairs of boxes, in small steps."""
    for some in split(found, boxes, depths):
        size = some.size
        for longest in np.unique(size).tolist():  # those evaluated together are of one size
            own = np.flatnonzero(size == longest)
            for part in parts(len(own), max(1, _VALUES // (longest + 1) ** 2)):
                yield _block(found, some.take(own[part]), depths)


def _block(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer) -> Covered:
    """Evaluate some boxes, in blocks as large as the largest."""
    own = found.take(boxes.owner)
    of_1, of_y, of_x = own.coefficients
    low = boxes.low
    x, y = low
    last_x, last_y = boxes.high - low
    x0, y0 = low + (depths.corner - own.origin)
    across, upwards = (np.arange(last.max() + 1)[:, None] for last in (last_x, last_y))
    # The pixels of a block beyond its box are NaN, which is not inside.
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
    nearness = gather(other.ravel(), inside)
    error = gather(own.nearness_error, row)
    return Covered(
        gather(pixel.ravel(), inside),
        gather(boxes.owner, row),
        nearness - error,
        np.minimum(nearness + error, gather(own.nearest, row)),
        (gather(least.ravel(), inside) > gather(own.edge_error, row)) & gather(own.sure, row),
    )


def split(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer) -> Iterator[Boxes]:
    """Yield boxes that are no larger than a FINE cell, and the parts of others in FINE cells.

    Cells that cannot be covered or seen are left out.
    """
    is_small = boxes.size < FINE
    yield boxes.take(np.flatnonzero(is_small))
    for coarse in cells(found, boxes.take(np.flatnonzero(~is_small)), depths, COARSE):
        yield from cells(found, coarse, depths, FINE)


def cells(found: EdgeFunctions, boxes: Boxes, depths: DepthBuffer, size: int) -> Iterator[Boxes]:
    """Yield the parts of boxes in those cells of this size which may be covered and seen."""
    first = boxes.low // size
    last = boxes.high // size
    columns, rows = (last - first + 1).astype(np.intp)
    for start, end in groups(columns * rows, _CELLS):
        which, number = spread(np.arange(start, end), (columns * rows)[start:end])
        row, column = np.divmod(number, columns.take(which))
        cell = first.take(which, axis=1) + np.stack((column, row)).astype(first.dtype)
        low = np.maximum(boxes.low.take(which, axis=1), cell * size)
        high = np.minimum(boxes.high.take(which, axis=1), cell * size + (size - 1))
        some = Boxes(boxes.owner.take(which), low, high)
        x, y = cell
        yield some.take(_may_be_seen(found, some, depths.farthest(x, y, size), depths))


def _may_be_seen(
    found: EdgeFunctions, boxes: Boxes, farthest: Floats, depths: DepthBuffer
) -> Index:
    """Return which boxes neither an edge rules out nor the depth buffer hides."""
    of_1, of_y, of_x = gather(found.coefficients, boxes.owner)
    low = boxes.low + (depths.corner - gather(found.origin, boxes.owner))
    high = low + (boxes.high - boxes.low)
    most = of_1 + of_y * np.where(of_y > 0, high[1], low[1])
    most = most + of_x * np.where(of_x > 0, high[0], low[0])
    least = np.minimum(np.minimum(most[0], most[1]), most[2])
    nearest = most[3] + found.nearness_error.take(boxes.owner)
    out = (least < -found.edge_error.take(boxes.owner)) | (nearest < farthest)
    return np.flatnonzero(~out)
