"""Faults of the finished picture: the order of its rows, its colours, its file."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...causes.case import Case
from ...tracer.progress import at_once
from ..evidence import Evidence
from .fault import AnyFault, Effort, Example, Fault, Guess, Make, Option, always, with_option
from .filters import FILTER_FAULTS
from .processed import PROCESSED
from .recolor import alpha_divided, alpha_multiplied, recolored
from .sizes import SIZE_FAULTS
from .tones import CURVE_FAULTS


def _upside_down(case: Case, guess: Guess) -> Case:
    """Flip the picture of a case upside down."""
    return replace(case, picture=case.picture.moved(np.arange(len(case.picture.color))[::-1]))


# By how many columns and rows all are off, and the sentence.
_ROLLS = (
    (0, 1, "rows are one too high, and the topmost is at the bottom"),
    (0, -1, "rows are one too low, and the lowest is at the top"),
    (1, 0, "columns are one too far right, and the rightmost is at the left"),
    (-1, 0, "columns are one too far left, and the leftmost is at the right"),
)


def _rolled(way: int) -> Make[Option]:
    """Return a function that rolls the picture's columns and rows, or rolls them back."""

    def make(case: Case, guess: Option) -> Case:
        height, width = case.picture.color.shape[:2]
        x, y, _ = _ROLLS[guess.number]
        rows = np.roll(np.arange(height), way * y)
        columns = np.roll(np.arange(width), way * x)
        return replace(case, picture=case.picture.moved(np.ix_(rows, columns)))

    return make


@at_once
def _find_partly(evidence: Evidence) -> list[Guess]:
    """Return the guess if pixels are covered in part: others have the same colour either way.

    Single pixels cannot say how good it is, as edges that are smoothed are such pixels.
    """
    alpha = evidence.picture.color[..., 3]
    return [Guess()] if ((alpha > 0) & (alpha < 1)).any() else []


PICTURE_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "row_off",
        "the picture's {words}",
        "A buffer is read or written from one pixel or row too far, as when counting from 1.",
        "check where the border begins, and from which row or column counting starts",
        _rolled(-1),
        always(*(Option(n, words=words) for n, (*_, words) in enumerate(_ROLLS))),
        examples=(Example("border", "the border off by one row", with_option(0), _rolled(1)),),
        words="rows or columns are one off, and those at the end are at the other end",
        witness="steel1990/tga#1",
    ),
    Fault(
        "rows",
        "the picture is upside down",
        "Blender and OpenGL begin with the lowest row, most files with the topmost.",
        "turn its rows over: the first row of a .png or .exr is the topmost. Of a .npy or .npz in "
        "which it is so, too, say --holds KIND first-row=top. A picture whose camera is shifted up "
        "tells this from a camera that is mirrored",
        _upside_down,
        turns=True,
        effort=Effort.VIEW,  # with the mirrored camera, which shows the same
        examples=(Example("rows", "the picture's rows from top to bottom"),),
        witness="glium/glium#1526",
    ),
    *CURVE_FAULTS,
    Fault(
        "premultiplied",
        "the picture's colours are multiplied by alpha twice",
        "Blender's render results and EXR files are premultiplied already.",
        "store premultiplied colours as they are, straight ones as straight",
        recolored(alpha_divided),
        _find_partly,
        sampled=False,
        witness="Tom94/tev#87",
    ),
    Fault(
        "straight_alpha",
        "the picture's colours are straight, not premultiplied by alpha",
        "PNG stores straight colours, EXR premultiplied ones; the values were copied from one "
        "to the other.",
        "multiply them by alpha",
        recolored(alpha_multiplied),
        _find_partly,
        sampled=False,
        witness="RxLaboratory/Bluik#32",
    ),
    *FILTER_FAULTS,
    *SIZE_FAULTS,
    *PROCESSED,
)
