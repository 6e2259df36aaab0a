"""Faults of the picture, after all is rendered: the order of its rows, its colours, its file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array
from ...causes.case import Case
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Example, Fault, Guess, Make, with_values
from .filters import FILTER_FAULTS
from .grading import GRADING_FAULTS
from .pixels import PIXEL_FAULTS
from .recolor import alpha_divided, alpha_multiplied, recolored
from .rounding import ROUNDING_FAULTS
from .sizes import SIZE_FAULTS
from .tones import CURVE_FAULTS


def _moved_rows(change: Callable[[Array], Array]) -> Make:
    """Return what changes the order of the picture's rows."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case:
        return replace(case, picture=case.picture.at(change(np.arange(len(case.picture.color)))))

    return make


# By how many columns and rows all are off, and what is said of it.
_ROLLS = {
    (0.0, 1.0): "rows are one too high, and the topmost is at the bottom",
    (0.0, -1.0): "rows are one too low, and the lowest is at the top",
    (1.0, 0.0): "columns are one too far right, and the rightmost is at the left",
    (-1.0, 0.0): "columns are one too far left, and the leftmost is at the right",
}


def _rolled(way: int) -> Make:
    """Return what moves the picture's columns and rows; what leaves it comes in opposite."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case:
        x, y = (way * int(v) for v in guess.values)
        height, width = case.picture.color.shape[:2]
        rows, columns = np.roll(np.arange(height), y), np.roll(np.arange(width), x)
        return replace(case, picture=case.picture.at(np.ix_(rows, columns)))

    return make


def _find_rolled(evidence: Evidence) -> Work[list[Guess]]:
    return [Guess(values, words=words) for values, words in _ROLLS.items()]
    yield


def _find_partly(evidence: Evidence) -> Work[list[Guess]]:
    """Return the guess if pixels are covered in part: others have the same colour either way.

    Single pixels cannot say how good it is, as edges that are smoothed are such pixels.
    """
    alpha = evidence.picture.color[..., 3]
    return [Guess()] if ((alpha > 0) & (alpha < 1)).any() else []
    yield


PICTURE_FAULTS = (
    Fault(
        "row_off",
        "the picture's {words}",
        "check where the border begins, and from which row or column counting starts",
        _rolled(1),
        _find_rolled,
        put_right=_rolled(-1),
        examples=(Example("border", "the border off by one row", with_values(0.0, 1.0)),),
        words="rows or columns are one off, and those at the end are at the other end",
    ),
    Fault(
        "rows",
        "the picture's rows are from top to bottom, or were turned once too often",
        "Blender's row 0 is at the bottom, that of most files at the top",
        _moved_rows(np.flip),
        examples=(Example("rows", "the picture's rows from top to bottom"),),
    ),
    *CURVE_FAULTS,
    *GRADING_FAULTS,
    *ROUNDING_FAULTS,
    Fault(
        "premultiplied",
        "the picture's colours are multiplied by alpha twice",
        "store premultiplied colours as they are, straight ones as straight",
        recolored(alpha_multiplied),
        _find_partly,
        put_right=recolored(alpha_divided),
        sampled=False,
    ),
    Fault(
        "straight_alpha",
        "the picture's colours are straight, not premultiplied by alpha",
        "multiply them by alpha",
        recolored(alpha_divided),
        _find_partly,
        put_right=recolored(alpha_multiplied),
        sampled=False,
    ),
    *FILTER_FAULTS,
    *SIZE_FAULTS,
    *PIXEL_FAULTS,
)
