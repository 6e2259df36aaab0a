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

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from ...arrays import Bools, Floats, Index
from ...tracer.vector import gather, largest, parts
from ..bounds import U
from .chunks import Expanded
from .depth_buffer import DepthBuffer
from .film import DELTA, Film
from .rasterise import Boxes, Covered

SIDE = 16  # pixels along the side of a box, at most
# Boxes are evaluated in blocks of few sizes: the side of the block, by that of the box minus 1.
_PADDED = np.array([1, 2, 3, 4, 6, 6, 8, 8, 10, 10, 12, 12, 14, 14, 16, 16], np.uint16)
_TRIANGLES = 1 << 13  # triangles evaluated together
_VALUES = 1 << 15  # pixels evaluated together
_L = SIDE + 1
_E = 1.01 * (4 * DELTA * (SIDE + _L) + 8 * U * (4 * SIDE * _L + 2 * _L * _L))
_ET = 1.01 * (12 * DELTA * _L + 50 * U * _L * _L)
# The error of the nearness, in b / |T| and in `own`.
_PER_T = 1.01 * 12 * (_E + _ET)
_OWN = 1.01 * (4 + 12 * (1 + _E / _ET))
_SIDES = ((1, 2), (2, 0), (0, 1))  # the corners of the edges bc, ca, ab


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
    culling: Counter[str],
    left: list[Index],
) -> Iterator[Covered]:
    """Yield the pairs of triangles that `are_small`, some thousand triangles at a time.

    `boxes` are those of the triangles in the whole picture. Triangles that are nearly edge-on are
    appended to `left` instead.
    """
    for some, h, w in _blocks(boxes):
        culling["computed"] += h * w * len(some)
        yield _block(film, expanded, some, (h, w), depths, left)


def _blocks(boxes: Boxes) -> Iterator[tuple[Boxes, int, int]]:
    """Yield boxes of about one size, which are at most h pixels high and w wide."""
    width, height = boxes.high - boxes.low
    shape = _PADDED.take(height) * np.uint16(SIDE + 1) + _PADDED.take(width)
    order = np.argsort(shape, kind="stable")
    shape = shape.take(order)
    boxes = boxes.take(order)
    starts = np.flatnonzero(np.diff(shape, prepend=np.uint16(0)))
    for start, end in pairwise([*starts.tolist(), len(shape)]):
        h, w = divmod(int(shape[start]), SIDE + 1)
        some = boxes.take(slice(start, end))
        for part in parts(end - start, max(1, min(_TRIANGLES, _VALUES // (h * w)))):
            yield some.take(part), h, w


def _block(
    film: Film,
    expanded: Expanded,
    boxes: Boxes,
    shape: tuple[int, int],
    depths: DepthBuffer,
    left: list[Index],
) -> Covered:
    """Evaluate the triangles of some boxes, in blocks of one shape (h, w)."""
    vertices = expanded.vertices
    count = np.int32(len(boxes))
    corners = [corner.astype(np.intp) for corner in gather(expanded.corners, boxes.owner)]
    x0, y0 = boxes.low + 0.5
    x = [gather(vertices.x, corner) - x0 for corner in corners]
    y = [gather(vertices.y, corner) - y0 for corner in corners]
    of_1 = [x[a] * y[b] - y[a] * x[b] for a, b in _SIDES]
    volume = of_1[0] + of_1[1] + of_1[2]  # T
    amount = np.abs(volume)
    sign = np.copysign(1.0, volume)
    edge_on = np.flatnonzero(amount <= 2 * _ET)
    if len(edge_on):
        left.append(gather(boxes.owner, edge_on))
        sign[edge_on] = np.nan  # never inside
    first, second, third = _edges(x, y, of_1, sign, shape)
    depth = [gather(vertices.depth, corner) for corner in corners]
    a, b, c, error = _nearness(film, depth, amount)

    least = np.minimum(np.minimum(first, second, out=first), third, out=first).ravel()
    found = (least >= -_E).nonzero()[0].astype(np.int32)
    at = found // count  # which of a box's pixels
    row = found - at * count
    pixel, found, row = _pixels(depths, boxes.low, shape, at, row, found)
    nearness = gather(second.ravel(), found) * gather(b, row)
    nearness += gather(third.ravel(), found) * gather(c, row)
    nearness += gather(a, row)
    error = gather(error, row)
    most = nearness + error
    nearness -= error
    return Covered(pixel, gather(boxes.owner, row), nearness, most, gather(least, found) > _E)


def _edges(
    x: list[Floats], y: list[Floats], of_1: list[Floats], sign: Floats, shape: tuple[int, int]
) -> Floats:
    """Return the edge functions of k triangles at the pixels of their boxes, (3, h, w, k)."""
    h, w = shape
    up = np.arange(float(h))[:, None]
    right = np.arange(float(w))[:, None]
    edges = np.empty((3, h, w, len(sign)))
    for edge, constant, (a, b) in zip(edges, of_1, _SIDES, strict=True):
        constant *= sign
        if h == w == 1:
            edge[0, 0] = constant
        else:
            rows = constant + (x[b] - x[a]) * sign * up
            np.add(rows[:, None], (y[a] - y[b]) * sign * right, out=edge)
    return edges


def _nearness(
    film: Film, depth: list[Floats], amount: Floats
) -> tuple[Floats, Floats, Floats, Floats]:
    """Return the nearness of first corners, what a unit of the edges ca and ab adds; and the error.

    Given the depths of the three corners, and |T|.
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
    depths: DepthBuffer, low: Index, shape: tuple[int, int], at: Index, row: Index, found: Index
) -> tuple[Index, Index, Index]:
    """Return the pixels at places `at` in boxes `row`; and `found` and `row`.

    Of all three only what lies in the region.
    """
    h, w = shape
    region = depths.region
    stride = np.int32(depths.stride)
    x, y = low.astype(np.int32) - depths.corner.astype(np.int32)
    if min(x.min(), y.min()) < 0 or x.max() > region.width - w or y.max() > region.height - h:
        i = gather(x, row) + at % w
        j = gather(y, row) + at // w
        ours = (i >= 0) & (i < region.width) & (j >= 0) & (j < region.height)
        inside = np.flatnonzero(ours)
        at = gather(at, inside)
        row = gather(row, inside)
        found = gather(found, inside)
    y *= stride
    y += x
    pixel = gather(y, row)
    if h * w > 1:
        steps = np.arange(h, dtype=np.int32)[:, None] * stride + np.arange(w, dtype=np.int32)
        pixel += gather(steps.ravel(), at)
    return pixel, found, row
