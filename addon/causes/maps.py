"""Draws maps over a traced picture, which is dimmed and pale so that single pixels stand out.

All take and return linear RGBA (h, w, 4), or some rows of it.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Bytes, Colors, by_runs
from ..certainty import Certainty
from ..files.images import curve, curve_undone
from .cause import Color
from .explain import CAUSES

WRONG: Color = (1.0, 0.0, 0.0)
DIM = 0.25  # the share of its light that the picture keeps
HUE = 0.4  # the share of its colour: the rest is grey
LEAST = 0.35  # of white on a screen: what differs by one level of 255
RING = 6  # pixels from the one that is marked to its ring
MOST_RINGS = 500  # of more pixels none is marked: they are found without
_BLACK = np.array((0.0, 0.0, 0.0, 1.0), np.float32)
_WHITE = np.array((1.0, 1.0, 1.0, 1.0), np.float32)
_LUMINANCE = (0.2126, 0.7152, 0.0722)  # of linear Rec. 709


def dimmed(color: Colors) -> Colors:
    """Return a picture in dimmed, paler colours; what is transparent stays so.

    Some of the hue stays, so that what differs from its surroundings by that alone is still seen.
    """
    flat = color.reshape(-1, 4)

    def paler(c: Colors) -> Colors:
        rgb = np.nan_to_num(c[:, :3])
        light = rgb @ np.array(_LUMINANCE)
        shown = DIM * (HUE * rgb + (1 - HUE) * light[:, None])
        alpha = np.nan_to_num(c[:, 3:], nan=1.0)
        return np.concatenate((shown, alpha), axis=1, dtype=np.float32)

    return by_runs(paler, flat).reshape(color.shape)


def cause_map(color: Colors, cause: Bytes, opaque: bool = True) -> Colors:
    """Return a map of the causes (h, w) of pixels that do not agree.

    If it is not `opaque`, what is transparent stays so where pixels agree.
    """
    out = dimmed(color)
    if opaque:
        out[..., 3] = 1
    for c in CAUSES:
        if c.color is not None:
            where = cause == c
            share = 0.5 if c.see_through else 1.0
            out[where, :3] = (1 - share) * out[where, :3] + share * np.array(c.color)
            out[where, 3] = 1
    return out


def certainty_map(color: Colors, certainty: Bytes) -> Colors:
    """Return a map of the `Certainty` of each pixel (h, w).

    Where whole surfaces are of one certainty, the picture stays visible.
    """
    table = np.array([bytearray.fromhex(c.color[1:]) for c in Certainty])
    share = np.array([0.5 if c < Certainty.EXACT else 1.0 for c in Certainty])[certainty][..., None]
    out = dimmed(color)
    out[..., 3] = 1
    out[..., :3] += share * (curve_undone(table / 255)[certainty] - out[..., :3])
    return out


def difference_map(first: Colors, second: Colors) -> Colors:
    """Return how far apart two pictures' colours are in each channel, raised so that it is seen.

    A difference of one of 255 sRGB levels is LEAST of white on a screen, and the largest is white.
    Less than half a level, which storing may change, is black.
    """
    with np.errstate(invalid="ignore"):
        one, other = (curve(np.maximum(c[..., :3], 0)) for c in (first, second))
        apart = np.nan_to_num(np.abs(one - other), nan=1.0, posinf=1.0)
    out = np.ones(first.shape, np.float32)
    raised = curve_undone(LEAST + (1 - LEAST) * np.minimum(apart, 1))
    out[..., :3] = np.where(apart < 0.5 / 255, 0, raised)
    return out


def ringed(color: Colors, where: Bools) -> Colors:
    """Return a picture with a ring around each of a few pixels (h, w), in the pixel's colour.

    The ring is black within and white without, so it is seen on any colour.
    """
    y, x = np.nonzero(where)
    if not 0 < len(y) <= MOST_RINGS:
        return color
    out = color.copy()
    own = color[y, x]
    painted = {RING - 2: _BLACK, RING + 1: _WHITE, RING - 1: own, RING: own, 0: own}
    for distance, paint in painted.items():
        dy, dx = np.mgrid[-distance : distance + 1, -distance : distance + 1]
        ring = np.maximum(abs(dy), abs(dx)) == distance
        rows = np.clip(y[:, None] + dy[ring], 0, where.shape[0] - 1)
        columns = np.clip(x[:, None] + dx[ring], 0, where.shape[1] - 1)
        out[rows, columns] = np.broadcast_to(paint, own.shape)[:, None]
    return out
