"""The pixels that differ and have no cause yet, with all that a check may look at."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...tracer.frame import Frame
from ..case import Case
from ..cause import Cause, Causes
from ..picture import Picture

BLOCK = 1 << 15  # pixels looked at in one step, where that needs no rays


def blocks(shape: tuple[int, ...]) -> list[slice]:
    """Split a picture (h, w, ...) into whole rows of about BLOCK pixels."""
    rows = max(1, BLOCK // shape[1])
    return [slice(y, min(y + rows, shape[0])) for y in range(0, shape[0], rows)]


@dataclass(eq=False)
class OpenPixels:
    """What a check takes: it gives some of the open pixels their cause.

    Parameters
    ----------
    case : Case
    frame : Frame
        What was traced.
    picture : Picture
        (h, w): the case's, as it is seen once a transform of its colours is found.
    out : Causes
        What has been found.
    open : (h, w) bool
    band : (h, w) float64
        How far from its pixel's centre Blender's sample may lie, in pixels.
    """

    case: Case
    frame: Frame
    picture: Picture
    out: Causes
    open: NDArray[np.bool_]
    band: NDArray[np.float64]

    def settle(
        self,
        where: NDArray[np.bool_],
        cause: Cause,
        figure: ArrayLike | None = None,
        allowed: ArrayLike = np.nan,
    ) -> None:
        """Give the pixels of `where` (h, w) a cause, but for those that have one."""
        where = where & (self.out.cause == Cause.AGREE)
        self.out.cause[where] = cause
        if figure is not None:
            self.out.figure[where] = np.broadcast_to(figure, where.shape)[where]
            self.out.allowed[where] = np.broadcast_to(allowed, where.shape)[where]
        self.open &= ~where

    def rows(self, rows: slice) -> OpenPixels:
        """Return those of some rows; their causes are written into the whole."""
        o = self.out
        out = replace(o, cause=o.cause[rows], figure=o.figure[rows], allowed=o.allowed[rows])
        open_, band = self.open[rows], self.band[rows]
        return replace(self, picture=self.picture.at(rows), out=out, open=open_, band=band)
