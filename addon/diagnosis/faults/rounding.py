"""The fault of all colours of a picture by rounding.

It allows for more than one picture, so it gives way to what is exact: it is `vague`.
"""

from __future__ import annotations

from dataclasses import replace

from ...causes.case import Case
from ...pictures.curves import FITTED_SHARE
from ...tracer.progress import at_once
from ..evidence import Evidence
from .fault import Fault, Numbers
from .recolor import with_slack
from .surfaces import Surfaces, surfaces


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
        witness="Tom94/tev#150",
    ),
)
