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
from ...tracer.progress import at_once
from ..evidence import Evidence
from .fault import Example, Fault, Numbers, with_values
from .recolor import of_straight, with_slack
from .surfaces import Surfaces, surfaces

MOST_NOISE = 2  # levels that dithering adds, at most
_SEED = 27


def _of_levels(case: Case, guess: Numbers) -> Case:
    """Allow a tolerance of some levels of 8 bits."""
    return replace(case, picture=with_slack(case.picture, guess.values[0]))


def _is_noisy(found: Surfaces | None) -> bool:
    """Return whether nearly all measured surfaces are noisy."""
    if found is None or not found.measured.any():
        return False
    return bool(found.noisy[found.measured].mean() > FITTED_SHARE)


@at_once
def _find_rounding(evidence: Evidence) -> list[Numbers]:
    """Guess the levels by which rounding is off, if each surface is shown in one colour."""
    if _is_noisy(surfaces(evidence)):
        return []
    more = Numbers((1.0,), words=", and up to one level more off")
    return [more] if evidence.picture.storage.levels else [Numbers((0.0,)), more]


@at_once
def _find_noise(evidence: Evidence) -> list[Numbers]:
    """Guess the levels of noise, if all surfaces have it."""
    if not _is_noisy(surfaces(evidence)):
        return []
    return [Numbers((float(n),), words="s" if n > 1 else "") for n in range(1, MOST_NOISE + 1)]


def _dithered(color: Array, levels: float) -> Array:
    """Return straight RGB with noise of up to some levels of 8 bits, rounded to these."""
    noise = np.random.default_rng(_SEED).uniform(-levels, levels, color.shape)
    stored = np.rint(EIGHT_BITS * curve(np.clip(color, 0, 1)) + noise)
    return curve_undone(np.clip(stored / EIGHT_BITS, 0, 1))


ROUNDING_FAULTS = (
    Fault(
        "rounding_level",
        "the picture's colours are rounded to 8 bits{words}",
        "Programs round to 8 bits differently: to the nearest level, down, or after one more "
        "conversion.",
        "round, do not cut off; or store 16 bits or floats",
        _of_levels,
        _find_rounding,
        ("levels",),
        vague=True,
    ),
    Fault(
        "dithered",
        "noise of up to {levels:.0f} level{words} of 8 bits lies over the picture, as of dithering",
        "Blender adds noise to files of 8 bits, by the output setting *Dither*.",
        "switch dithering off, or compare a PNG with --dither {levels:.0f}",
        _of_levels,
        _find_noise,
        ("levels",),
        vague=True,
        examples=(
            Example(
                "dithered",
                "noise of two levels, as of dithering",
                with_values(2.0),
                of_straight(_dithered, alike=False),
            ),
        ),
        words="s",
    ),
)
