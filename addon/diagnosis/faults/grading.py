"""Faults of all colours of a picture by grading: saturation, white balance.

They are told with no more slack than the picture's own rounding, and a level where it was graded
in 8 bits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Colors, Floats
from ...causes.case import Case
from ...images import curve, curve_undone
from ...pictures.bounds import difference
from ...pictures.curves import FIT, FITTED_SHARE, LEAST_CHANGE, saturated, several, through
from ...pictures.picture import Picture, Transform, straight
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Example, Fault, Find, Numbers, Values, with_values
from .recolor import by_curve, of_straight, with_slack
from .surfaces import agree, surfaces

LINEAR: Transform = lambda c: c  # noqa: E731
# In which values a picture is graded, and what is said of it.
SPACES: tuple[tuple[Transform, Transform, str], ...] = (
    (LINEAR, LINEAR, "in linear values"),
    (lambda c: curve(np.clip(c, 0, 1)), lambda c: curve_undone(np.clip(c, 0, 1)), "in sRGB values"),
)
# What of a colour is its grey: Rec. 709 and Rec. 601, as ITU-R BT.709-6 and BT.601-7 have them.
GREYS = {"Rec. 709": (0.2126, 0.7152, 0.0722), "Rec. 601": (0.299, 0.587, 0.114)}
SLACKS = (-1.0, 0.0, 1.0)  # levels of 8 bits that grading may be off; below 0: it is not rounded


@dataclass(frozen=True, eq=False)
class Graded(Numbers):
    """A grading of the colours, and its tolerance."""

    of: Transform = LINEAR
    slack: float = 0.0  # levels, of `SLACKS`


Grading = Iterator[tuple[Values, Transform, str]]  # the numbers, what it is, in words


def _ends(picture: Picture, shown: Colors) -> tuple[Floats, Floats]:
    """Return the straight linear values between which rounding leaves colours (k, 4)."""
    _, allowed = difference(shown, shown, stored=picture.storage)
    middle = straight(shown)
    if not picture.storage.levels:
        return middle - allowed[..., :3], middle + allowed[..., :3]
    coded = curve(np.clip(middle, 0, 1))
    low, high = coded - allowed[..., :3], coded + allowed[..., :3]
    with np.errstate(invalid="ignore"):
        ends = np.where(low > 0, curve_undone(low), -np.inf), curve_undone(high)
    return ends[0], np.where(high < 1, ends[1], np.inf)


def _most_covered(low: Floats, high: Floats) -> float:
    """Return the middle of where the most of n intervals overlap."""
    places = np.concatenate((low, high))
    step = np.repeat((1, -1), len(low))
    order = np.lexsort((-step, places))
    most = int(np.argmax(np.cumsum(step[order])))
    ends = places[order[most : most + 2]]
    return float(ends.mean()) if np.isfinite(ends).all() else float(places[order[most]])


def _balances(traced: Floats, ends: tuple[Floats, Floats]) -> Grading:
    """Yield a factor for each channel, if each has several values to fit it to."""
    for into, back, words in SPACES:
        a, low, high = (into(v) for v in (traced, *ends))
        factors = []
        for channel in range(3):
            fits = a[:, channel] > FIT
            value = a[fits, channel]
            if several(value):
                first, second = low[fits, channel] / value, high[fits, channel] / value
                factors.append(_most_covered(first, second))
        if len(factors) < 3 or not np.isfinite(factors).all() or min(factors) <= 0:
            continue
        if np.ptp(factors) > LEAST_CHANGE:
            yield tuple(factors), through(into, back, np.array(factors).__mul__), words


def _saturations(traced: Floats, ends: tuple[Floats, Floats]) -> Grading:
    """Yield the factor of the colours' distance from their grey, if it is not 1."""
    for into, back, space in SPACES:
        a, low, high = (into(v) for v in (traced, *ends))
        for name, weights in GREYS.items():
            grey = (a @ np.array(weights))[:, None]
            apart = a - grey
            fits = np.abs(apart) > FIT
            if not several(apart[fits]):
                continue
            first, second = ((v - grey)[fits] / apart[fits] for v in (low, high))
            share = _most_covered(np.minimum(first, second), np.maximum(first, second))
            if np.isfinite(share) and share >= 0 and abs(share - 1) > LEAST_CHANGE:
                of = through(into, back, saturated(share, weights))
                yield (share,), of, f"{space}, with the grey of {name}"


def _find_graded(gradings: Callable[[Floats, tuple[Floats, Floats]], Grading]) -> Find[Graded]:
    """Return a function that finds the grading with the least slack for nearly all surfaces.

    A picture that was graded in 8 bits is rounded twice, or cut off: a level is allowed then,
    unless that alone makes the surfaces agree.
    """

    def find(evidence: Evidence) -> Work[list[Graded]]:
        found = surfaces(evidence)
        for slack in SLACKS if found else ():
            assert found
            picture = with_slack(evidence.picture, slack)
            if agree(picture, found, None).mean() > FITTED_SHARE:
                return []
            ends = _ends(picture, found.shown)
            for values, of, words in gradings(straight(found.traced), ends):
                if agree(picture, found, of).mean() > FITTED_SHARE:
                    return [Graded(values, values, values, of, slack, words=words)]
            yield 0.0
        return []

    return find


def _by_grading(case: Case, guess: Graded) -> Case:
    """Return the case whose traced colours are graded."""
    return by_curve(replace(case, picture=with_slack(case.picture, guess.slack)), guess.of)


GRADING_FAULTS = (
    Fault(
        "white_balance",
        "the picture's white balance is another: red times {red:.4g}, green times {green:.4g}, "
        "blue times {blue:.4g}, {words}",
        "Blender's color management has a white balance from 4.3 on, and photo programs apply "
        "one by themselves.",
        "switch off white balance and colour grading",
        _by_grading,
        _find_graded(_balances),
        ("red", "green", "blue"),
        examples=(
            Example(
                "white_balance",
                "a warmer white balance",
                with_values(1.1, 1.0, 0.85),
                of_straight(lambda color, *factors: color * np.array(factors)),
            ),
        ),
    ),
    Fault(
        "saturation",
        "the picture's saturation is {saturation:.4g} times what it should be, {words}",
        "Set by a look in Blender's color management, or by a filter of a photo program.",
        "switch off colour grading, and filters of the viewer that saved it",
        _by_grading,
        _find_graded(_saturations),
        ("saturation",),
        examples=(
            Example(
                "saturation",
                "more saturated by a quarter",
                with_values(1.25),
                of_straight(lambda color, share: saturated(share, GREYS["Rec. 709"])(color)),
            ),
        ),
    ),
)
