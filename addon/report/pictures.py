"""The picture of a comparison: which pixels differ, and why, in colour."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..compare.cause import Cause
from ..compare.comparison import Comparison

# Linear RGB, told apart by the colour-blind, too. Pixels that agree show the traced picture, dimmed
# and grey.
CAUSE_COLORS = {
    Cause.EDGE: (1.0, 0.3, 0.0),
    Cause.DEPTH_TIE: (0.0, 0.7, 1.0),
    Cause.CLIP_PLANE: (1.0, 1.0, 0.4),
    Cause.ANTI_ALIASING: (0.7, 0.4, 0.2),
    Cause.COLOR: (0.4, 0.7, 0.7),
    Cause.HIDDEN: (0.08, 0.2, 0.08),
    Cause.NOT_MODELLED: (0.3, 0.08, 0.9),
    Cause.NOT_DECIDABLE: (0.25, 0.3, 0.6),
    Cause.UNEXPLAINED: (1.0, 0.0, 0.0),
    Cause.NOT_TRACED: (0.0, 0.0, 0.0),
}
_DIM = 0.25
_LUMINANCE = (0.2126, 0.7152, 0.0722)  # of linear Rec. 709


def difference(comparison: Comparison) -> NDArray[np.float32]:
    """Return the map of causes over the dimmed traced picture, (h, w, 4) linear RGBA."""
    grey = _DIM * (np.nan_to_num(comparison.frame.color[..., :3]) @ np.array(_LUMINANCE))
    out = np.ones((*grey.shape, 4), np.float32)
    out[..., :3] = grey[..., None]
    for cause, color in CAUSE_COLORS.items():
        where = comparison.causes.cause == cause
        if cause in (Cause.NOT_DECIDABLE, Cause.COLOR):  # of whole surfaces: they stay to be seen
            out[where, :3] = 0.5 * out[where, :3] + 0.5 * np.array(color)
        else:
            out[where, :3] = color
    return out
