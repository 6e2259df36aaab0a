"""How near the nearest sure hit of every pixel is, so that what lies behind it need not be tested.

In come pixels with the nearness (`edge_functions.py`) that a hit of theirs surely has at least;
out goes what a surface must reach to be seen: at a pixel, or anywhere in a cell of pixels. What
reaches it is kept as a fragment.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....scene import Camera, Region
from ...vector import Arrays, Index, gather
from ..bounds import U

ROUNDING = 4 * U  # relative, of a nearness that was computed from t
FINE, COARSE = 8, 64  # pixels along the side of a cell: the sizes of `farthest`


@dataclass(frozen=True, eq=False)
class Fragments(Arrays):
    """c pairs of a pixel and a surface that may be its nearest, (c,) each.

    `surface` counts the triangles of all chunks; `nearest` is the most that its nearness can be;
    `sure` whether it is hit for sure.
    """

    pixel: Index
    surface: Index
    nearest: NDArray[np.float64]
    sure: NDArray[np.bool_]


class ClipRange:
    """The camera's clip range as nearness, with room for its own rounding."""

    def __init__(self, camera: Camera) -> None:
        ends, nearness = (camera.clip_start, camera.clip_end), camera.projection.nearness
        self._outer, self._inner = nearness(*ends, ROUNDING), nearness(*ends, -ROUNDING)

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
        self.region = region
        columns, rows = -(-region.width // COARSE), -(-region.height // COARSE)
        self.stride = columns * COARSE
        self.nearness = np.full(rows * COARSE * self.stride, -np.inf)
        grid = self.nearness.reshape(rows * COARSE, self.stride)
        grid[region.height :] = grid[:, region.width :] = np.inf  # no pixels, so never in the way
        self._fine = np.full((rows * COARSE // FINE, self.stride // FINE), -np.inf)
        self._coarse = np.full((rows, columns), -np.inf)
        self._stale = np.ones(rows, bool)  # whose cells are older than their pixels

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

    def enter(self, pixel: Index, nearness: NDArray[np.float64]) -> None:
        """Enter that these pixels, which may occur more than once, see something as near or nearer.

        Of several writes to one place the last one stays: so those that are nearer come again, the
        other way round, as many may be sorted. (`np.maximum.at` is slow before numpy 1.25.)
        """
        while len(pixel):
            nearer = np.flatnonzero(nearness > gather(self.nearness, pixel))[::-1]
            pixel, nearness = gather(pixel, nearer), gather(nearness, nearer)
            self.nearness[pixel] = nearness
            if len(pixel):
                low, high = (int(v) // (COARSE * self.stride) for v in (pixel.min(), pixel.max()))
                self._stale[low : high + 1] = True

    def not_hidden(self, some: Fragments) -> Index:
        """Return which fragments are not surely behind something."""
        return np.flatnonzero(~(some.nearest < gather(self.nearness, some.pixel)))

    def refresh(self, y0: int, y1: int) -> None:
        """Bring the cells of rows y0 <= y < y1 up to date."""
        per = COARSE // FINE
        rows = self.nearness.reshape(-1, per, FINE, self.stride)
        for row in range(y0 // COARSE, -(-y1 // COARSE)):
            if self._stale[row]:
                fine = rows[row].min(axis=1).reshape(per, -1, FINE).min(axis=2)
                self._fine[row * per : (row + 1) * per] = fine
                self._coarse[row] = fine.reshape(per, -1, per).min(axis=2).min(axis=0)
                self._stale[row] = False

    def farthest(self, x: Index, y: Index, size: int) -> NDArray[np.float64]:
        """Return the least nearness in the cells of FINE or COARSE pixels with these numbers."""
        cells = self._fine if size == FINE else self._coarse
        return gather(cells.ravel(), y.astype(np.intp) * cells.shape[1] + x)

    def farthest_in(self, x0: Index, x1: Index, y0: Index, y1: Index) -> NDArray[np.float64]:
        """Return the least nearness in the cells around boxes of at most FINE pixels a side.

        Lowest and highest x and y, both included.
        """
        columns = self._fine.shape[1]
        x0, x1, y0, y1 = (v // FINE for v in (x0, x1, y0, y1))
        cell = y0.astype(np.intp) * columns + x0
        right, up = x1 - x0, (y1 - y0).astype(np.intp) * columns
        cells = self._fine.ravel()
        out = gather(cells, cell)
        for other in (cell + right, cell + up, cell + right + up):
            np.minimum(out, gather(cells, other), out=out)
        return out

    def farthest_around(self, x0: int, y0: int, x1: int, y1: int) -> float:
        """Return the least nearness in the cells around one box of any size."""
        rows, columns = (slice(a // FINE, b // FINE + 1) for a, b in ((y0, y1), (x0, x1)))
        return float(self._fine[rows, columns].min())
