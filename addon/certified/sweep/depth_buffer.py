"""Keeps the nearest sure hit of every pixel, so that what lies behind it need not be tested.

The nearness (`edge_functions.py`) of a hit is known to be between a least and a most. The winner of
a pixel is the surface with the greatest least nearness. A surface with a smaller most nearness is
hidden. All others may be nearer than the winner: they are returned as fragments. A winner without
fragments at the end is what the pixel sees. Theorem: `Sweep.sweep_sees_what_plain_does`.

The least nearness in a cell of pixels says what is hidden in all of the cell.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...arrays import Bools, Floats, Index
from ...scene import Camera, Region
from ...tracer.hits import NOTHING
from ...tracer.vector import Arrays, gather
from ..bounds import U

ROUNDING = 4 * U  # the relative error of a nearness that is computed from t
FINE = 8  # pixels along the side of a small cell
COARSE = 64  # and of a large cell


@dataclass(frozen=True, eq=False)
class Fragments(Arrays):
    """c pairs of a pixel and a surface that may be nearer than the pixel's winner, (c,) each.

    `surface` is its number among those of all chunks; `nearest` bounds its nearness from above.
    """

    pixel: Index
    surface: Index
    nearest: Floats


def nearness(camera: Camera, low: Floats, high: Floats, room: float) -> tuple[Floats, Floats]:
    """Return least and most nearness between two t, which are not negative, high perhaps inf.

    It is 1 / t, where `room` is for rounding, relative, and the range is surely covered if that is
    negative. Of parallel rays it is -t, exactly; where high is inf, t may be negative, too.
    """
    if camera.projection.shares_direction:
        return -high, np.where(np.isfinite(high), -low, np.inf)
    return (1 - room) / high, (1 + room) / np.maximum(low, 0)


class ClipRange:
    """The camera's clip range as nearness, with a margin for its rounding."""

    def __init__(self, camera: Camera) -> None:
        start, end = np.asarray(camera.clip_start), np.asarray(camera.clip_end)
        self._outer, self._inner = (
            (nearness(camera, end, end, room)[0], nearness(camera, start, start, room)[1])
            for room in (ROUNDING, -ROUNDING)
        )

    def inside(self, least: Floats, most: Floats) -> Bools:
        """Return which hits surely are in the range, given the ends of their nearness."""
        return (least > self._inner[0]) & (most < self._inner[1])

    def outside(self, least: Floats, most: Floats) -> Bools:
        """Return which hits surely are not in the range."""
        return (most < self._outer[0]) | (least > self._outer[1])


class DepthBuffer:
    """The depth buffer of a region, with cells of FINE and of COARSE pixels a side.

    Pixels are numbered row by row from the lowest, in rows of `stride`: the region's width, rounded
    up to whole cells.
    """

    def __init__(self, region: Region) -> None:
        self.region = region
        self.corner = np.array([[region.x0], [region.y0]])
        columns = -(-region.width // COARSE)
        rows = -(-region.height // COARSE)
        self.stride = columns * COARSE
        self.nearness = np.full(rows * COARSE * self.stride, -np.inf)  # the winners' least
        self._most = self.nearness.copy()  # the winners' most
        self._surface = np.full(len(self.nearness), NOTHING, np.int64)
        grid = self.nearness.reshape(rows * COARSE, self.stride)
        grid[region.height :] = np.inf  # beyond the region, where nothing is to be seen
        grid[:, region.width :] = np.inf
        self._fine = np.full((rows * COARSE // FINE, self.stride // FINE), -np.inf)
        self._coarse = np.full((rows, columns), -np.inf)
        self._around = self._fine.copy()  # the least of a cell, and those right of and above it
        self._stale = np.ones((rows * COARSE, columns), bool)  # pixels newer than their cell

    @property
    def winners(self) -> NDArray[np.int64]:
        """The winner of each of the region's n pixels; NOTHING where no hit is sure."""
        r = self.region
        return self._surface.reshape(-1, self.stride)[: r.height, : r.width].reshape(-1)

    def pixels(self, numbers: Index) -> Index:
        """Return the numbers of pixels (n,) in rows of the region's width."""
        if self.stride == self.region.width:
            return numbers
        y, x = np.divmod(numbers, self.stride)
        return y * self.region.width + x

    def places(self, pixels: Index) -> Index:
        """Return the numbers here of pixels (n,) as :meth:`pixels` numbers them."""
        if self.stride == self.region.width:
            return pixels
        y, x = np.divmod(pixels, self.region.width)
        return y * self.stride + x

    def enter(self, pixel: Index, surface: Index, least: Floats, most: Floats) -> list[Fragments]:
        """Enter sure hits of pixels, which may occur more than once; returns the fragments.

        numpy keeps the last of several writes to one index. So surfaces that are overwritten are
        entered again; in reverse order, as many come sorted.
        """
        fragments: list[Fragments] = []
        pixel = pixel.astype(np.intp, copy=False)
        while len(pixel) or not fragments:
            before = gather(self.nearness, pixel)
            nearer = least > before
            if not nearer.all():
                near = np.flatnonzero(~(nearer | (most < before)))
                fragments.append(
                    Fragments(gather(pixel, near), gather(surface, near), gather(most, near))
                )
                wins = np.flatnonzero(nearer)
                pixel = gather(pixel, wins)
                surface = gather(surface, wins)
                least = gather(least, wins)
                most = gather(most, wins)
            beaten = gather(self._most, pixel)
            near = np.flatnonzero(~(beaten < least))
            at = gather(pixel, near)
            fragments.append(Fragments(at, gather(self._surface, at), gather(beaten, near)))
            self.nearness[pixel] = least
            self._most[pixel] = most
            self._surface[pixel] = surface
            self._stale.ravel()[pixel // COARSE] = True
            again = np.flatnonzero(gather(self._surface, pixel) != surface)[::-1]
            pixel = gather(pixel, again)
            surface = gather(surface, again)
            least = gather(least, again)
            most = gather(most, again)
        return fragments

    def not_hidden(self, some: Fragments) -> Index:
        """Return which fragments are not surely hidden."""
        return np.flatnonzero(~(some.nearest < gather(self.nearness, some.pixel)))

    def refresh(self) -> None:
        """Compute the cells anew where pixels have changed."""
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

    def farthest(self, x: Index, y: Index, size: int) -> Floats:
        """Return the least nearness in cells (n,) of FINE or COARSE pixels, by column and row."""
        return _at(self._fine if size == FINE else self._coarse, x, y)

    def farthest_in(self, low: Index, high: Index) -> Floats:
        """Bound the least nearness in boxes of pixels from below, (b,).

        Boxes go from `low` to `high`, (2, b) each, both included. The bound of a box that is larger
        than two FINE cells is -inf.
        """
        around = self._around  # enough for boxes of FINE pixels a side that begin in the cell
        column, row = low // FINE
        out = _at(around, column, row)
        size = np.maximum(*(high - low))
        larger = np.flatnonzero(size >= FINE)
        if len(larger):
            size = gather(size, larger)
            x, y = gather(low, larger)
            farthest = gather(out, larger)
            right, up = np.minimum((x + FINE, y + FINE), gather(high, larger))
            for column, row in ((right, y), (x, up), (right, up)):
                np.minimum(farthest, _at(around, column // FINE, row // FINE), out=farthest)
            out[larger] = np.where(size < 2 * FINE, farthest, -np.inf)
        return out

    def farthest_around(self, x0: int, y0: int, x1: int, y1: int) -> float:
        """Return the least nearness in all cells that a box of any size overlaps."""
        rows = slice(y0 // FINE, y1 // FINE + 1)
        columns = slice(x0 // FINE, x1 // FINE + 1)
        return float(self._fine[rows, columns].min())


def _at(cells: Floats, x: Index, y: Index) -> Floats:
    """Return the values of cells by column and row, (n,)."""
    return gather(cells.ravel(), y.astype(np.intp) * cells.shape[1] + x)
