"""Rasterises triangles with small boxes by their film positions: most of a dense mesh.

Positions are relative to the pixel in which the box begins. A corner (x, y) is the p, q, w of
`edge_functions.py` with w = 1, as what is divided by a depth that is positive keeps its sign. With
n the nearness of a corner,

    nearness = n_a + (e_ca (n_b - n_a) + e_ab (n_c - n_a)) / T,

as 1 / t, and t of parallel rays, are linear on the film.

The bounds are numbers, the same for all triangles. A `certain` corner is off by at most DELTA
pixels, and lies in the box or less than a pixel beside it, as the edge of the picture does not clip
the box. So the bounds of `edge_functions.py` are, with R = SIDE, L = SIDE + 1, W = 1,
place = DELTA and weight = 0,

    E = 4 DELTA (R + L) + 8 u (4 R L + 2 L L),   ET = 12 DELTA L + 50 u L L.

T is the sum of the edges at the origin here, which has fewer roundings. A triangle whose |T| is
2 ET or less is nearly edge-on: it is left to `edge_functions.py`. For a hit, an edge divided by T
is off by at most g = (E + ET) / (|T| - ET), the nearness of a corner by `own`, and the nearness of
the hit by

    2 g (b + 2 own) + 3 own + 8 u b + u n,

with b the largest difference from the first corner's nearness n. Factors of six and four instead of
two and three cover the last two terms: E / T is more than 2 u, ET / T more than 8 u as T is at most
6 L L, and `own` more than u n. And |T| - ET is more than half of |T|, g less than 1 + E / ET.

Theorems: `SweepPixels.small_right`, `SweepPixels.small_one_right`.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ...arrays import Bools, Floats, Index, groups
from ...tracer.vector import gather, largest
from ..bounds import U
from .chunks import Expanded
from .depth_buffer import DepthBuffer
from .film import DELTA, Film
from .rasterise import Boxes, Covered

SIDE = 16  # pixels along the side of a box, at most
# Boxes are evaluated in blocks of few sizes: the side of the block, by that of the box minus 1.
_PADDED = np.array([1, 2, 3, 4, 6, 6, 8, 8, 10, 10, 12, 12, 14, 14, 16, 16], np.uint16)
_TRIANGLES = 1 << 13  # evaluated together, at most
_PIXELS = 1 << 16  # of their boxes, at most: in a step of work, and in its arrays
_VALUES = 1 << 15  # pixels evaluated together
_L = SIDE + 1
_E = 1.01 * (4 * DELTA * (SIDE + _L) + 8 * U * (4 * SIDE * _L + 2 * _L * _L))
_ET = 1.01 * (12 * DELTA * _L + 50 * U * _L * _L)
# The error of the nearness, in b / |T| and in `own`.
_PER_T = 1.01 * 12 * (_E + _ET)
_OWN = 1.01 * (4 + 12 * (1 + _E / _ET))
_SIDES = ((1, 2), (2, 0), (0, 1))  # the corners of the edges bc, ca, ab
_PLACES = np.arange(SIDE * SIDE, dtype=np.int32).reshape(SIDE, SIDE)  # numbers of a box's pixels

Block = tuple[int, int, int, int]  # triangles start <= k < end, boxes at most h high and w wide


def are_small(film: Film, expanded: Expanded, low: Index, high: Index, some: Index) -> Bools:
    """Return which of some triangles of a chunk these bounds hold for.

    The boxes of the chunk's triangles, `low` to `high`, (2, m) each, are those in the whole
    picture, so that the answer does not depend on how the picture is divided.
    """
    low = gather(low, some)
    high = gather(high, some)
    ends = np.array([[film.camera.width - 1], [film.camera.height - 1]], low.dtype)
    x, y = (low > 0) & (high < ends) & (high - low < SIDE)
    out = x & y
    if not expanded.vertices.certain.all():
        for corner in gather(expanded.corners, some):
            out &= gather(expanded.vertices.certain, corner)
    return out


def small_pairs(
    film: Film,
    expanded: Expanded,
    boxes: Boxes,
    depths: DepthBuffer,
    left: list[Index],
) -> Iterator[Covered]:
    """Yield the pairs of triangles that `are_small`, some thousand triangles at a time.

    `boxes` are those of the triangles in the whole picture. Triangles that are nearly edge-on are
    appended to `left` instead. They are sorted by the size of their boxes, and evaluated in blocks.
    """
    width, height = boxes.high - boxes.low
    shape = _PADDED.take(height) * np.uint16(SIDE + 1) + _PADDED.take(width)
    order = np.argsort(shape, kind="stable")
    area = (_PADDED.take(height) * _PADDED.take(width)).take(order).astype(np.intp)
    for start, end in groups(np.maximum(area, _PIXELS // _TRIANGLES), _PIXELS):
        some = order[start:end]
        blocks = list(_blocks(gather(shape, some)))
        yield _pairs(film, expanded, boxes.take(some), blocks, depths, left)


def _blocks(shape: Index) -> Iterator[Block]:
    """Yield the blocks of triangles with boxes of these shapes (k,), which are sorted."""
    starts = np.flatnonzero(shape[1:] != shape[:-1]) + 1
    for start, end in pairwise([0, *starts.tolist(), len(shape)]):
        h, w = divmod(int(shape[start]), SIDE + 1)
        size = _VALUES // (h * w)
        for first in range(start, end, size):
            yield first, min(first + size, end), h, w


def _pairs(
    film: Film,
    expanded: Expanded,
    boxes: Boxes,
    blocks: list[Block],
    depths: DepthBuffer,
    left: list[Index],
) -> Covered:
    """Evaluate the triangles of some boxes: first each triangle, then its pixels, in blocks."""
    vertices = expanded.vertices
    corners = gather(expanded.corners, boxes.owner).astype(np.intp)
    x0, y0 = boxes.low + 0.5
    x = gather(vertices.x, corners) - x0
    y = gather(vertices.y, corners) - y0
    edges = np.empty((3, 3, len(boxes)))
    for edge, (i, j) in enumerate(_SIDES):
        np.subtract(x[i] * y[j], y[i] * x[j], out=edges[0, edge])
        np.subtract(x[j], x[i], out=edges[1, edge])
        np.subtract(y[i], y[j], out=edges[2, edge])
    volume = edges[0, 0] + edges[0, 1] + edges[0, 2]  # T
    amount = np.abs(volume)
    sign = np.copysign(1.0, volume)
    edge_on = np.flatnonzero(amount <= 2 * _ET)
    if len(edge_on):
        left.append(gather(boxes.owner, edge_on))
        sign[edge_on] = np.nan  # never inside
    edges *= sign
    a, b, c, error = _nearness(film, gather(vertices.depth, corners), amount)

    found = [_inside(edges, block) for block in blocks]
    row, place, least, second, third = map(np.concatenate, zip(*found, strict=True))
    nearness = second * gather(b, row)
    nearness += third * gather(c, row)
    nearness += gather(a, row)
    error = gather(error, row)
    most = nearness + error
    nearness -= error
    pixel, ours = _pixels(depths, boxes.low, row, place)
    pairs = Covered(pixel, gather(boxes.owner, row), nearness, most, least > _E)
    return pairs.take(ours)


def _inside(edges: Floats, block: Block) -> tuple[Index, Index, Floats, Floats, Floats]:
    """Return where the triangles of a block may be hit: which triangle, and which pixel of its box.

    And the edges there: the least, ca and ab. Given are, of all triangles (k,), the `edges`
    (3, 3, k) as functions of the pixel: the coefficients of 1, y and x, of bc, ca and ab each.
    """
    start, end, h, w = block
    of_1, of_y, of_x = edges[..., start:end]
    values = of_1[:, None, None]  # (3, h, w, end - start)
    if h * w > 1:
        rows = of_1[:, None] + of_y[:, None] * np.arange(float(h))[:, None]
        columns = of_x[:, None] * np.arange(float(w))[:, None]
        values = rows[:, :, None] + columns[:, None]
    first, second, third = values.reshape(3, -1)
    least = np.minimum(first, second)
    np.minimum(least, third, out=least)
    found = (least >= -_E).nonzero()[0].astype(np.int32)  # divided faster than 64 bits
    at = found // np.int32(end - start)
    row = found - at * np.int32(end - start) + np.int32(start)
    place = gather(_PLACES[:h, :w].ravel(), at)
    return row, place, gather(least, found), gather(second, found), gather(third, found)


def _nearness(film: Film, depth: Floats, amount: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Return the nearness of first corners, what a unit of the edges ca and ab adds; and the error.

    Given the depths of the corners, (3, k), and |T|.
    """
    a, b, c = map(film.certain_nearness, depth)
    own = film.certain_error(largest(a, b, c))
    b -= a
    c -= a
    scale = 1 / np.maximum(amount, 2 * _ET)
    error = largest(np.abs(b), np.abs(c)) * scale
    error *= _PER_T
    error += _OWN * own
    b *= scale
    c *= scale
    return a, b, c, error


def _pixels(
    depths: DepthBuffer, low: Index, row: Index, place: Index
) -> tuple[Index, Index | slice]:
    """Return the pixels at places (n,) in boxes `row`; and which of them lie in the region."""
    region = depths.region
    x, y = low.astype(np.intp) - depths.corner
    steps = depths.stride * np.arange(SIDE)[:, None] + np.arange(SIDE)
    pixel = gather(y * depths.stride + x, row) + gather(steps.ravel(), place)
    near_end = (np.minimum(x, y) < 0) | (x > region.width - SIDE) | (y > region.height - SIDE)
    some = np.flatnonzero(gather(near_end, row))
    up, right = np.divmod(gather(place, some), SIDE)
    i = gather(x, gather(row, some)) + right
    j = gather(y, gather(row, some)) + up
    inside = (i >= 0) & (i < region.width) & (j >= 0) & (j < region.height)
    if inside.all():
        return pixel, slice(None)
    ours = np.ones(len(row), bool)
    ours[some] = inside
    return pixel, np.flatnonzero(ours)
