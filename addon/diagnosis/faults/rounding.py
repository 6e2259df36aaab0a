"""Faults of all colours of a picture by rounding, and by noise.

They allow for more than one picture, so they give way to what is exact: they are `vague`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays import Array
from ...causes.case import Case
from ...images import EIGHT_BITS, curve, curve_undone
from ...pictures.curves import FITTED_SHARE
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Example, Fault, Guess, with_values
from .recolor import of_straight, with_slack
from .surfaces import Surfaces, surfaces

MOST_NOISE = 2  # levels that dithering adds, at most
_SEED = 27


def _of_levels(case: Case, frame: Frame, guess: Guess) -> Case:
    """Allow for some levels of 8 bits."""
    return replace(case, picture=with_slack(case.picture, guess.values[0]))


def _is_noisy(found: Surfaces | None) -> bool:
    """Return whether nearly all surfaces are, of those that can be measured."""
    if found is None or not found.measured.any():
        return False
    return bool(found.noisy[found.measured].mean() > FITTED_SHARE)


def _find_rounding(evidence: Evidence) -> Work[list[Guess]]:
    """Return how many levels rounding is off, if each surface is shown in one colour."""
    if _is_noisy(surfaces(evidence)):
        return []
    more = Guess((1.0,), words=", and up to one level more off")
    return [more] if evidence.picture.levels else [Guess((0.0,)), more]
    yield


def _find_noise(evidence: Evidence) -> Work[list[Guess]]:
    """Return how many levels of noise there are, if all surfaces have it."""
    if not _is_noisy(surfaces(evidence)):
        return []
    return [Guess((float(n),), words="s" if n > 1 else "") for n in range(1, MOST_NOISE + 1)]
    yield


def _dithered(color: Array, levels: float) -> Array:
    """Return straight RGB with noise of up to some levels of 8 bits, rounded to these."""
    noise = np.random.default_rng(_SEED).uniform(-levels, levels, color.shape)
    stored = np.rint(EIGHT_BITS * curve(np.clip(color, 0, 1)) + noise)
    return curve_undone(np.clip(stored / EIGHT_BITS, 0, 1))


ROUNDING_FAULTS = (
    Fault(
        "rounding_level",
        "the picture's colours are rounded to 8 bits{words}",
        "round, do not cut off; or store 16 bits or floats",
        _of_levels,
        _find_rounding,
        ("levels",),
        put_right=_of_levels,
        vague=True,
    ),
    Fault(
        "dithered",
        "noise of up to {levels:.0f} level{words} of 8 bits lies over the picture, as of dithering",
        "switch dithering off, or compare a PNG with --dither {levels:.0f}",
        of_straight(_dithered),
        _find_noise,
        ("levels",),
        put_right=_of_levels,
        vague=True,
        examples=(Example("dithered", "noise of two levels, as of dithering", with_values(2.0)),),
        words="s",
    ),
)
