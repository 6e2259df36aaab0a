"""Triangles with small boxes, by their corners' film positions: most of a dense mesh.

They are counted from the pixel in which the box begins. A corner (x, y) is the p, q, w of
`edge_functions.py` with w = 1, as what is divided by a depth that is positive keeps its sign. With
n the nearness of a corner,

    nearness = n_a + (e_ca (n_b - n_a) + e_ab (n_c - n_a)) / T,

as 1 / t, and t of parallel rays, are linear on the film.

The bounds are numbers, the same for all triangles. A corner is off by DELTA pixels at most, or it
is not `certain`; and it lies in the box or less than a pixel beside it, as no edge of the picture
cuts the box off. So the bounds of `edge_functions.py` are, with R = SIDE, L = SIDE + 1, W = 1,
place = DELTA and weight = 0,

    E = 4 DELTA (R + L) + 8 u (4 R L + 2 L L),   ET = 12 DELTA L + 50 u L L.

T is the sum of the edges at the origin here, which is fewer roundings. Where it is 2 ET or less, a
triangle is nearly edge-on: it is left to `edge_functions.py`. Of a hit, an edge divided by T is off
by at most g = (E + ET) / (|T| - ET), the nearness of a corner by `own`, and what is computed of
them by

    2 g (b + 2 own) + 3 own + 8 u b + u n,

b the largest difference from the first corner. Six times and four times take the place of two and
three: E / T is more than 2 u, ET / T more than 8 u as T is at most 6 L L, and `own` more than u n.
And |T| - ET is more than half of |T|, g less than 1 + E / ET.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...tracer.vector import Index, gather, largest, parts
from ..bounds import U
from .chunks import Expanded
from .depth_buffer import DepthBuffer
from .film import DELTA, Film
from .rasterise import Covered

SIDE = 16  # pixels along the side of a box, at most
# Boxes are evaluated in blocks of few sizes, by their extent less 1.
_PADDED = np.array([1, 2, 3, 4, 6, 6, 8, 8, 10, 10, 12, 12, 14, 14, 16, 16], np.uint16)
_TRIANGLES, _VALUES = 1 << 13, 1 << 15  # and pixels, evaluated together
_L = SIDE + 1
_E = 1.01 * (4 * DELTA * (SIDE + _L) + 8 * U * (4 * SIDE * _L + 2 * _L * _L))
_ET = 1.01 * (12 * DELTA * _L + 50 * U * _L * _L)
_PER_T, _OWN = 1.01 * 12 * (_E + _ET), 1.01 * (4 + 12 * (1 + _E / _ET))  # of the nearness


def are_small(
    film: Film, expanded: Expanded, low: Index, high: Index, some: Index
) -> NDArray[np.bool_]:
    """Return which of some triangles of a chunk these bounds hold for.

    Their boxes `low` to `high`, (2, m), are those in the whole picture: what they say is the same
    however the work is divided.
    """
    low, high = gather(low, some), gather(high, some)
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
    low: Index,
    high: Index,
    triangles: Index,
    depths: DepthBuffer,
    culling: Counter[str],
    left: list[Index],
) -> Iterator[Covered]:
    """Yield the pairs of triangles that `are_small`, some thousand triangles at a time.

    `left` is added to: those of them which are nearly edge-on.
    """
    for some, h, w in _blocks(low, high, triangles):
        culling["computed"] += h * w * len(some)
        vertices, count = expanded.vertices, len(some)
        corners = [c.astype(np.intp) for c in gather(expanded.corners, some)]
        start = gather(low, some)
        x0, y0 = start + 0.5
        x = [gather(vertices.x, c) - x0 for c in corners]
        y = [gather(vertices.y, c) - y0 for c in corners]
        sides = (1, 2), (2, 0), (0, 1)
        of_1 = [x[a] * y[b] - y[a] * x[b] for a, b in sides]
        volume = of_1[0] + of_1[1] + of_1[2]
        amount, sign = np.abs(volume), np.copysign(1.0, volume)
        edge_on = np.flatnonzero(amount <= 2 * _ET)
        if len(edge_on):
            left.append(gather(some, edge_on))
            sign[edge_on] = np.nan  # never inside
        up, right = np.arange(float(h))[:, None], np.arange(float(w))[:, None]
        edges = np.empty((3, h, w, count))
        for edge, constant, (a, b) in zip(edges, of_1, sides, strict=True):
            constant *= sign
            if h == w == 1:
                edge[0, 0] = constant
            else:
                rows = constant + (x[b] - x[a]) * sign * up
                np.add(rows[:, None], (y[a] - y[b]) * sign * right, out=edge)
        # Of every triangle's nearness: that of its first corner, and what an edge's unit adds.
        a, b, c = (film.certain_nearness(gather(vertices.depth, k)) for k in corners)
        nearest = largest(a, b, c)
        own = film.certain_error(nearest)
        b -= a
        c -= a
        scale = 1 / np.maximum(amount, 2 * _ET)
        error = largest(np.abs(b), np.abs(c)) * scale
        error *= _PER_T
        error += _OWN * own
        b *= scale
        c *= scale

        first, second, third = edges
        least = np.minimum(np.minimum(first, second, out=first), third, out=first).ravel()
        found = (least >= -_E).nonzero()[0].astype(np.int32)
        at = found // np.int32(count)  # which of a box's pixels
        row = found - at * np.int32(count)
        pixel, found, row = _pixels(depths, start, w, h, at, row, found)
        nearness = gather(second.ravel(), found) * gather(b, row)
        nearness += gather(third.ravel(), found) * gather(c, row)
        nearness += gather(a, row)
        error = gather(error, row)
        most = nearness + error
        nearness -= error
        yield Covered(pixel, gather(some, row), nearness, most, gather(least, found) > _E)


def _blocks(low: Index, high: Index, some: Index) -> Iterator[tuple[Index, int, int]]:
    """Yield triangles with boxes of about one size, which is at most h pixels high and w wide."""
    width, height = gather(high, some) - gather(low, some)
    shape = _PADDED.take(height) * np.uint16(SIDE + 1) + _PADDED.take(width)
    order = np.argsort(shape, kind="stable")
    some, shape = some.take(order), shape.take(order)
    starts = np.flatnonzero(np.diff(shape, prepend=np.uint16(0)))
    for start, end in pairwise([*starts.tolist(), len(shape)]):
        h, w = divmod(int(shape[start]), SIDE + 1)
        for part in parts(end - start, max(1, min(_TRIANGLES, _VALUES // (h * w)))):
            yield some[start:end][part], h, w


def _pixels(
    depths: DepthBuffer, low: Index, w: int, h: int, at: Index, row: Index, found: Index
) -> tuple[Index, Index, Index]:
    """Return the pixels at places of boxes `row`, of h rows of w; only those in the region."""
    region, stride = depths.region, np.int32(depths.stride)
    x, y = low.astype(np.int32) - depths.corner.astype(np.int32)
    ends = region.width - w, region.height - h
    if min(x.min(), y.min()) < 0 or x.max() > ends[0] or y.max() > ends[1]:
        i, j = gather(x, row) + at % w, gather(y, row) + at // w
        ours = (i >= 0) & (i < region.width) & (j >= 0) & (j < region.height)
        ours = np.flatnonzero(ours)
        at, row, found = gather(at, ours), gather(row, ours), gather(found, ours)
    y *= stride
    y += x
    pixel = gather(y, row)
    if h * w > 1:
        steps = np.arange(h, dtype=np.int32)[:, None] * stride + np.arange(w, dtype=np.int32)
        pixel += gather(steps.ravel(), at)
    return pixel, found, row
