"""Maps over a traced picture: it is dimmed and grey there, so that single pixels stand out.

All are of pictures (h, w, 4), or of some rows of them: linear RGBA, opaque.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bytes, Colors, Mask
from ..certainty import Certainty
from ..images import curve_undone
from ..runs import by_runs
from .cause import Color
from .causes import CAUSES

WRONG: Color = (1.0, 0.0, 0.0)
DIM = 0.25  # of what lies below
RING, MOST_RINGS = 6, 500  # pixels from the one that is marked; rings, so that these are found
_LUMINANCE = (0.2126, 0.7152, 0.0722)  # of linear Rec. 709


def dimmed(color: Colors) -> Colors:
    """Return a picture's light, dimmed."""
    flat = color.reshape(-1, 4)
    light = by_runs(lambda c: DIM * (np.nan_to_num(c[:, :3]) @ np.array(_LUMINANCE)), flat)
    out = np.ones(color.shape, np.float32)
    out[..., :3] = light.reshape(*color.shape[:-1], 1)
    return out


def wrong_map(color: Colors, wrong: Mask) -> Colors:
    """Return a picture with the pixels that are wrong (h, w)."""
    out = dimmed(color)
    out[wrong, :3] = WRONG
    return out


def cause_map(color: Colors, cause: Bytes) -> Colors:
    """Return a picture with the pixels that do not agree in the colours of their causes (h, w)."""
    out = dimmed(color)
    for c in CAUSES:
        if c.color is not None:
            where = cause == c
            share = 0.5 if c.see_through else 1.0
            out[where, :3] = (1 - share) * out[where, :3] + share * np.array(c.color)
    return out


def certainty_map(color: Colors, certainty: Bytes) -> Colors:
    """Return a picture with the `Certainty` of each pixel (h, w).

    What whole surfaces have leaves these visible.
    """
    table = np.array([bytearray.fromhex(c.color[1:]) for c in Certainty])
    share = np.array([0.5 if c < Certainty.EXACT else 1.0 for c in Certainty])[certainty][..., None]
    out = dimmed(color)
    out[..., :3] += share * (curve_undone(table / 255)[certainty] - out[..., :3])
    return out


def ringed(color: Colors, where: Mask) -> Colors:
    """Return a picture with a ring of its own colour around each of few pixels (h, w)."""
    y, x = np.nonzero(where)
    if not 0 < len(y) <= MOST_RINGS:
        return color
    out, (height, width) = color.copy(), where.shape
    dy, dx = np.mgrid[-RING : RING + 1, -RING : RING + 1]
    on = np.maximum(abs(dy), abs(dx)) >= RING - 1
    at = np.clip(y[:, None] + dy[on], 0, height - 1), np.clip(x[:, None] + dx[on], 0, width - 1)
    out[at] = color[y, x][:, None]
    out[y, x] = color[y, x]
    return out
