"""Depth ties: what Blender shows lies behind, nearer than its depth buffer can tell apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...tracer.nearest import NOTHING, Hits
from ...tracer.progress import Work
from ..cause import Cause
from .probe import LAYERS, Part


def behind(part: Part, first: Hits, lost: NDArray[np.bool_]) -> Work[None]:
    """Settle open pixels that show a surface which ties with the first one.

    Colours and whose surfaces they are come from two drawings, in which a tie may go either way:
    each must be found among the surfaces that tie.

    Parameters
    ----------
    part : Part
        Of n pixels.
    first : Hits
        Through their centres.
    lost : (n,) bool
        Where the picture's own method lost what its centre shows.
    """
    scene, picture = part.scene, part.picture
    allowed = np.where(first.instance != NOTHING, part.resolution(first), -1.0)
    hits = first
    color, owner = picture.same_color(scene, first) & ~lost, ~picture.other_object(first.instance)
    for _ in range(LAYERS):
        hits = yield from part.probe.tracing(after=hits)
        with np.errstate(invalid="ignore"):  # inf - inf, where nothing is hit
            gap = hits.t - first.t
            tied = gap <= allowed
        color |= tied & picture.same_color(scene, hits)
        owner |= tied & ~picture.other_object(hits.instance)
        part.settle(tied & color & owner, Cause.DEPTH_TIE, gap, allowed)
        yield 0.0
        if part.settled:
            return
