"""Which pixels lie at a boundary of what is traced: the score counts them apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..tracer.frame import Frame


def boundary(frame: Frame) -> NDArray[np.bool_]:
    """Return which pixels see, with the eight around them, more than one appearance of an object.

    The background is one, too. Beyond the picture's rim is what its outermost pixels see.
    """
    seen = np.pad(frame.instance_index, 1, mode="edge")
    out = np.zeros(frame.instance_index.shape, bool)
    height, width = out.shape
    for y in range(3):
        for x in range(3):
            out |= seen[y : y + height, x : x + width] != frame.instance_index
    return out
