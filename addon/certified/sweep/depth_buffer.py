"""The nearest sure hit of every pixel, and how near it is: what lies behind need not be tested.

In come pixels with a surface that they surely hit, and the least and the most that its nearness
(`edge_functions.py`) can be there; out goes what a surface must reach to be seen: at a pixel, or
anywhere in a cell of pixels. Whose least is the greatest of a pixel is its winner. Every other that
may reach that is a rival, and kept: so a winner without rivals at the end is what the pixel sees.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...scene import Camera, Region
from ...tracer.hits import NOTHING
from ...tracer.vector import Arrays, Index, gather
from ..bounds import U

ROUNDING = 4 * U  # relative, of a nearness that was computed from t
FINE, COARSE = 8, 64  # pixels along the side of a cell: the sizes of `farthest`


@dataclass(frozen=True, eq=False)
class Fragments(Arrays):
    """c pairs of a pixel and a surface that may be nearer than its winner, (c,) each.

    `surface` counts the triangles of all chunks; `nearest` is the most that its nearness can be.
    """

    pixel: Index
    surface: Index
    nearest: NDArray[np.float64]


class ClipRange:
    """The camera's clip range as nearness, with room for its own rounding."""

    def __init__(self, camera: Camera) -> None:
        start, end, nearness = camera.clip_start, camera.clip_end, camera.projection.nearness
        self._outer, self._inner = (
            (nearness(end, end, room)[0], nearness(start, start, room)[1])
            for room in (ROUNDING, -ROUNDING)
        )

    def inside(self, least: NDArray, most: NDArray) -> NDArray[np.bool_]:
        """Return which surely are in the range, of nearnesses between these."""
        return (least > self._inner[0]) & (most < self._inner[1])

    def outside(self, least: NDArray, most: NDArray) -> NDArray[np.bool_]:
        """Return which surely are not."""
        return (most < self._outer[0]) | (least > self._outer[1])


class DepthBuffer:
    """The depth buffer of a region, in cells of FINE and of COARSE pixels.

    Pixels are numbered row by row from the lowest, in rows of `stride`, which is the region's width
    rounded up to whole cells.
    """

    def __init__(self, region: Region) -> None:
        self.region, self.corner = region, np.array([[region.x0], [region.y0]])
        columns, rows = -(-region.width // COARSE), -(-region.height // COARSE)
        self.stride = columns * COARSE
        self.nearness = np.full(rows * COARSE * self.stride, -np.inf)  # the least of the winner
        self._most = self.nearness.copy()
        self._surface = np.full(len(self.nearness), NOTHING, np.int64)
        grid = self.nearness.reshape(rows * COARSE, self.stride)
        grid[region.height :] = grid[:, region.width :] = np.inf  # no pixels, so never in the way
        self._fine = np.full((rows * COARSE // FINE, self.stride // FINE), -np.inf)
        self._coarse = np.full((rows, columns), -np.inf)
        self._around = self._fine.copy()  # of each cell with those to its right and above it
        self._stale = np.ones((rows * COARSE, columns), bool)  # which of each row are newer

    @property
    def winners(self) -> NDArray[np.int64]:
        """The surface that wins each of the region's pixels, (n,); NOTHING where none is sure."""
        r = self.region
        return self._surface.reshape(-1, self.stride)[: r.height, : r.width].reshape(-1)

    def pixels(self, numbers: Index) -> Index:
        """Return the region's own numbers, in rows of its width, of pixels (n,)."""
        if self.stride == self.region.width:
            return numbers
        y, x = np.divmod(numbers, self.stride)
        return y * self.region.width + x

    def places(self, pixels: Index) -> Index:
        """Return the numbers here of pixels (n,) that have the region's own numbers."""
        if self.stride == self.region.width:
            return pixels
        y, x = np.divmod(pixels, self.region.width)
        return y * self.stride + x

    def enter(
        self, pixel: Index, surface: Index, least: NDArray[np.float64], most: NDArray[np.float64]
    ) -> list[Fragments]:
        """Enter surfaces that pixels, which may occur more than once, surely hit; returns rivals.

        Of several writes to one place the last one stays: so those that find another there come
        again, the other way round, as many may be sorted.
        """
        rivals = []
        while len(pixel) or not rivals:
            before = gather(self.nearness, pixel)
            nearer = least > before
            if not nearer.all():
                near = np.flatnonzero(~(nearer | (most < before)))
                rivals.append(Fragments(*(gather(v, near) for v in (pixel, surface, most))))
                nearer = np.flatnonzero(nearer)
                pixel, surface, least, most = (
                    gather(v, nearer) for v in (pixel, surface, least, most)
                )
            beaten = gather(self._most, pixel)
            near = np.flatnonzero(~(beaten < least))
            at = gather(pixel, near)
            rivals.append(Fragments(at, gather(self._surface, at), gather(beaten, near)))
            self.nearness[pixel], self._most[pixel], self._surface[pixel] = least, most, surface
            self._stale.ravel()[pixel // COARSE] = True
            again = np.flatnonzero(gather(self._surface, pixel) != surface)[::-1]
            pixel, surface, least, most = (gather(v, again) for v in (pixel, surface, least, most))
        return rivals

    def not_hidden(self, some: Fragments) -> Index:
        """Return which fragments are not surely behind something."""
        return np.flatnonzero(~(some.nearest < gather(self.nearness, some.pixel)))

    def refresh(self) -> None:
        """Bring the cells up to date."""
        per = COARSE // FINE
        rows, columns = self._coarse.shape
        stale = self._stale.reshape(rows, COARSE, columns).any(axis=1)
        pixels = self.nearness.reshape(rows, per, FINE, columns, COARSE)
        fine = self._fine.reshape(rows, per, columns, per)
        for row in np.flatnonzero(stale.any(axis=1)):
            own = np.flatnonzero(stale[row])
            some = slice(own[0], own[-1] + 1)
            cells = pixels[row, :, :, some].min(axis=1).reshape(per, -1, per, FINE).min(axis=3)
            fine[row, :, some] = cells
            self._coarse[row, some] = cells.min(axis=(0, 2))
        self._stale[:] = False
        self._around[:] = self._fine
        np.minimum(self._around[:-1], self._fine[1:], out=self._around[:-1])
        np.minimum(self._around[:, :-1], self._around[:, 1:], out=self._around[:, :-1])

    def farthest(self, x: Index, y: Index, size: int) -> NDArray[np.float64]:
        """Return the least nearness in the cells of FINE or COARSE pixels with these numbers."""
        return _at(self._fine if size == FINE else self._coarse, x, y)

    def farthest_in(self, low: Index, high: Index) -> NDArray[np.float64]:
        """Return at most the least nearness in boxes of pixels from `low` to `high`, (2, b) each.

        Both included. Of boxes that are larger than two cells of FINE pixels it says nothing: -inf.
        """
        around = self._around  # of boxes of FINE pixels a side, in the cell where these begin
        out, size = _at(around, *(low // FINE)), np.maximum(*(high - low))
        larger = np.flatnonzero(size >= FINE)
        if len(larger):
            size, (x, y), farthest = (gather(v, larger) for v in (size, low, out))
            right, up = np.minimum((x + FINE, y + FINE), gather(high, larger))
            for other in ((right, y), (x, up), (right, up)):
                np.minimum(farthest, _at(around, *(v // FINE for v in other)), out=farthest)
            out[larger] = np.where(size < 2 * FINE, farthest, -np.inf)
        return out

    def farthest_around(self, x0: int, y0: int, x1: int, y1: int) -> float:
        """Return the least nearness in the cells around one box of any size."""
        rows, columns = (slice(a // FINE, b // FINE + 1) for a, b in ((y0, y1), (x0, x1)))
        return float(self._fine[rows, columns].min())


def _at(cells: NDArray[np.float64], x: Index, y: Index) -> NDArray[np.float64]:
    return gather(cells.ravel(), y.astype(np.intp) * cells.shape[1] + x)
