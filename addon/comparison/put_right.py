"""Makes the picture that a page and an Image Editor show of a fault: put right."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..arrays import Colors
from .comparison import Comparison


class PutRight(NamedTuple):
    """One of the two pictures, with a fault and those found before it put right."""

    number: int  # of the fault, among those that the diagnosis tells
    side: str  # 'traced' or 'blender': the picture that is wrong
    color: Colors  # (h, w, 4) linear RGBA


def pictures_put_right(comparison: Comparison) -> Iterator[PutRight]:
    """Yield the picture that each fault changes, put right: none where it changes no colour.

    A tolerance, as of a filter, is in how colours are compared, not in a picture.
    """
    told = comparison.diagnosis.told if comparison.diagnosis else ()
    before = then = {"traced": comparison.frame.color, "blender": comparison.picture}
    for number, one in enumerate(told):
        if not one.alternative:  # it was found with those before it put right
            before = then
        after = {"traced": one.frame.color, "blender": one.picture}
        side = next((s for s in after if not np.array_equal(after[s], before[s], True)), None)
        if not one.alternative:
            then = after
        if side:
            yield PutRight(number, side, after[side])
