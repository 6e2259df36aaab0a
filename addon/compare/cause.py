"""What can be said of a pixel, and when two pixels differ at all."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Blender hands its viewport's colours over as half floats, 11 bits, and cuts off rather than
# rounds: 1 reads 0.9995. Next to an edge a window copies them once more, and up to 3 units in the
# last place are missing (measured in 4.3). So many units of the larger value are allowed.
UNITS = 4

# That copy lets a little of the neighbour through: beside a white pixel, black reads 3 * 2^-14
# (measured in 4.3). Eight such steps are allowed.
LEAST = 8 * 2.0**-14

# A rasteriser interpolates a colour attribute between corners that it has rounded to 1/256 pixel,
# by an approximate 1/w: a ramp over a few pixels is off by as much as this (measured 0.0013).
INTERPOLATED = 2.0**-9


class Cause(IntEnum):
    """What is said of a pixel."""

    AGREE = 0
    EDGE = 1  # within Blender's own error of the centre, the tracer sees what Blender shows
    DEPTH_TIE = 2  # what Blender shows lies behind, by less than the depth buffer resolves
    NOT_MODELLED = 3  # something that the tracer does not model is drawn there
    NOT_DECIDABLE = 4  # float32 moves Blender's surfaces by more than half a pixel
    UNEXPLAINED = 5
    NOT_TRACED = 6  # a cancelled picture does not have it


@dataclass(eq=False)
class Causes:
    """What is said of every pixel, with the figure that says it.

    `cause` is (h, w) uint8, a `Cause` each; `figure` (h, w) float64, NaN where there is none. That
    of an edge is how far from the centre (pixels) the tracer sees what Blender shows; of a depth
    tie the gap between the surfaces (metres); of a pixel that is not decidable, how far (pixels)
    Blender's surfaces may be off; of an unmodelled feature its number in the manifest.
    `allowed` (h, w) is the bound that the figure was held against: pixels or metres.
    """

    cause: NDArray[np.uint8]
    figure: NDArray[np.float64]
    allowed: NDArray[np.float64]


@dataclass(eq=False)
class Settler:
    """Writes a cause and takes its pixels off the open ones."""

    out: Causes
    open: NDArray[np.bool_]

    def __call__(
        self,
        where: NDArray[np.bool_],
        cause: Cause,
        figure: ArrayLike | None = None,
        allowed: ArrayLike = np.nan,
    ) -> None:
        """Give the pixels of `where` a cause, but those that have one already."""
        where = where & (self.out.cause == Cause.AGREE)
        self.out.cause[where] = cause
        if figure is not None:
            self.out.figure[where] = np.broadcast_to(figure, where.shape)[where]
            self.out.allowed[where] = np.broadcast_to(allowed, where.shape)[where]
        self.open &= ~where

    def rows(self, rows: slice) -> Settler:
        """Return the same for some rows; it writes into the whole."""
        out = Causes(self.out.cause[rows], self.out.figure[rows], self.out.allowed[rows])
        return Settler(out, self.open[rows])


def differing(
    first: NDArray, second: NDArray, interpolated: NDArray[np.bool_] | bool = False
) -> NDArray[np.bool_]:
    """Return which pixels of two (..., c) pictures differ by more than Blender's own rounding.

    UNITS of a half float's last place are allowed, but at least LEAST; where a colour is
    `interpolated` (...), INTERPOLATED more. What is not finite differs from everything.
    """
    first, second = first.astype(np.float64), second.astype(np.float64)
    more = INTERPOLATED * np.asarray(interpolated, dtype=np.float64)[..., None]
    size = np.maximum(np.abs(first), np.abs(second))
    with np.errstate(invalid="ignore"):
        unit = np.spacing(np.minimum(size, 2.0**15).astype(np.float16))  # the last binade
        allowed = np.maximum(UNITS * unit.astype(np.float64), LEAST) + more
        same = (np.abs(first - second) <= allowed) & np.isfinite(size)
        return ~same.all(axis=-1)
