"""Judges what is behind glass, by a second picture that Blender draws without the glass.

The colour of glass is not known, so that any colour is excused where it is seen; its own surface
must be the right one. What is behind it is judged by another picture, which must agree with the
scene without the glass. Where it does not, the pixel is unexplained.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...rendering import frame_of
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from ..cause import NOT_TRACED, UNEXPLAINED, Causes
from .probe import OpenPixels


def check(pixels: OpenPixels, find: Callable[[Case, Frame], Work[Causes]]) -> Work[None]:
    """Find pixels, of any cause, that are wrong behind what the second picture leaves out.

    `find` finds the causes of a case and what was traced of it.
    """
    behind = pixels.case.behind
    out = pixels.out
    if behind is None:
        return
    objects = enumerate(pixels.frame.scene.objects)
    left_out = [number for number, name in objects if name in behind.left_out]
    judged = np.isin(pixels.frame.object_index, left_out)
    if not judged.any():
        return
    case = behind.case
    traced = yield from frame_of(case.scene, case.settings, pixels.case.tracer)
    causes = yield from find(case, traced)
    judged &= ~causes.unjudged
    if judged.any():
        out.behind = judged
    wrong = judged & (causes.cause == UNEXPLAINED) & (out.cause != NOT_TRACED)
    out.cause[wrong], out.figure[wrong], out.allowed[wrong] = UNEXPLAINED, np.nan, np.nan
