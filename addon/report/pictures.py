"""The picture of a comparison: which pixels differ, and why, in colour."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..compare.cause import Cause
from ..compare.comparison import Comparison

_DIM = 0.25
_LUMINANCE = (0.2126, 0.7152, 0.0722)  # of linear Rec. 709


def difference(comparison: Comparison) -> NDArray[np.float32]:
    """Return the map of causes over the dimmed traced picture, (h, w, 4) linear RGBA."""
    grey = _DIM * (np.nan_to_num(comparison.frame.color[..., :3]) @ np.array(_LUMINANCE))
    out = np.ones((*grey.shape, 4), np.float32)
    out[..., :3] = grey[..., None]
    for cause in Cause:
        if cause.color is not None:
            where = comparison.causes.cause == cause
            share = 0.5 if cause.see_through else 1.0
            out[where, :3] = (1 - share) * out[where, :3] + share * np.array(cause.color)
    return out
