"""Bounds how far the colours of two pictures may be apart by how each was stored."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np

from ..arrays import Array, Bools, Floats, by_runs
from ..files.images import encoded

# The units in the last place, of the larger value, by which colours may differ. Blender hands its
# viewport's colours over as half floats, 11 bits, and cuts off rather than rounds: 1 reads 0.9995.
# Next to an edge a window copies them once more, and up to 3 units are missing (measured in 4.3).
HALF_UNITS = 4

# That copy lets a little of the neighbour through: beside a white pixel, black reads 3 * 2^-14
# (measured in 4.3). Eight such steps are allowed.
LEAST_STEP = 8 * 2.0**-14

# The error of a dark colour, as Workbench adds up the logarithms of 1 + a colour in half floats.
LEAST_SUM = 2.0**-12

# A rasteriser interpolates a colour attribute between corners that it has rounded to 1/256 pixel,
# by an approximate 1/w: a ramp over a few pixels is off by as much as this (measured 0.0013).
INTERPOLATED = 2.0**-9

# A writer's own rounding of sRGB's curve, on top of half a level (float32, tables).
LEVEL_SLACK = 0.02


@dataclass(frozen=True)
class Storage:
    """How a picture's colours were rounded before they are compared."""

    levels: int = 0  # above 0, of a file that stores sRGB's curve in integers: 255; 0 for floats
    dither: float = 0.0  # noise that was added, in levels
    sums: int = 0  # how many samples were added up in half floats; 0 for one
    opaque: bool = False  # there is no alpha, which is not compared then


FLOATS = Storage()


def differing(
    first: Array,
    second: Array,
    interpolated: Bools | bool = False,
    stored: Storage = FLOATS,
) -> Bools:
    """Return which pixels of two (..., c) pictures differ by more than :func:`difference` allows.

    What is not finite differs from everything.
    """
    shape, count = first.shape[:-1], first.shape[-1]
    between = np.broadcast_to(interpolated, shape).ravel()
    sides = first.reshape(-1, count), second.reshape(-1, count)
    return by_runs(partial(_differing, stored=stored), *sides, between).reshape(shape)


def _differing(first: Array, second: Array, between: Bools, stored: Storage) -> Bools:
    if stored.levels:
        alike = (first == second) & np.isfinite(first)
    else:  # as much is always allowed, and mostly they are nearer; NaN and infinity are not less
        with np.errstate(invalid="ignore", over="ignore"):
            alike = np.abs(first - second) < LEAST_STEP
    out = ~alike.all(axis=-1)
    first, second = first[out], second[out]
    apart, allowed = difference(first, second, between[out], stored)
    finite = np.isfinite(first) & np.isfinite(second)
    out[out] = ~((apart <= allowed) & finite).all(axis=-1)
    return out


def difference(
    first: Array,
    second: Array,
    interpolated: Bools | bool = False,
    stored: Storage = FLOATS,
) -> tuple[Floats, Floats]:
    """Return how far two pictures are apart, and how far rounding may have put them, (..., c).

    Of floats, HALF_UNITS in a half float's last place are allowed, but at least LEAST_STEP, and
    half a unit for each addition. Of a file with integers, half a level and the noise are allowed
    in place of that; with 16 bits, HALF_UNITS, too.

    Parameters
    ----------
    first, second : (..., c) float
        Linear colours, or linear RGBA.
    interpolated : (...) bool
        Where a colour lies between those of corners, and INTERPOLATED more is allowed.
    stored : Storage
        How the second picture was rounded.
    """
    levels = stored.levels
    first, second = first.astype(np.float64), second.astype(np.float64)
    more = INTERPOLATED * np.asarray(interpolated, dtype=np.float64)[..., None]
    if levels:
        first, second = encoded(first), encoded(second)
    with np.errstate(invalid="ignore"):
        apart = np.abs(first - second)
        if levels:  # a half float's units are of (e + 0.055) / 2.4 at most, by the curve's slope
            halves = HALF_UNITS * 2.0**-10 / 2.4 * (np.maximum(first, second) + 0.055)
            step = (0.5 + LEVEL_SLACK + stored.dither) / levels
            return apart, step + (levels > 255) * halves + more
        size = np.maximum(np.abs(first), np.abs(second))
        unit = np.spacing(np.minimum(size, 2.0**15).astype(np.float16))  # the last binade
        unit = unit.astype(np.float64)
        more = more + stored.sums / 2 * np.maximum(unit, LEAST_SUM)
        return apart, np.maximum(HALF_UNITS * unit, LEAST_STEP) + more
