"""Judges what is behind glass, by a second picture that Blender draws without the glass.

The colour of glass is not known, so that any colour is excused where it is seen; its own surface
must be the right one. What is behind it is judged by another picture, which must agree with the
scene without the glass. Where it does not, the pixel is unexplained.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...arrays import Bools
from ...rendering import steps
from ...scene import Scene
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from ..case import Behind, Case
from ..cause import UNEXPLAINED, Causes

FindCauses = Callable[[Case, Frame], Work[Causes]]


def seen_through(scene: Scene, frame: Frame, behind: Behind) -> Bools:
    """Return which pixels (h, w) show an object that the second picture leaves out."""
    left_out = [n for n, name in enumerate(scene.objects) if name in behind.left_out]
    return np.isin(np.append(scene.instance_objects[:-1], NOTHING)[frame.instance_index], left_out)


def wrong_behind(case: Case, frame: Frame, find: FindCauses) -> Work[tuple[Bools, Bools]]:
    """Return the pixels (h, w) that were judged behind glass, and those that are wrong there.

    `find` finds the causes of a case and what was traced of it.
    """
    none = np.zeros(frame.shape, bool)
    behind = case.behind
    judged = none if behind is None else seen_through(case.scene, frame, behind)
    if behind is None or not judged.any():
        return none, none
    own = Frame.empty(behind.case.scene)
    yield from steps(own.scene, behind.case.settings, own, case.tracer)
    causes: Causes = yield from find(behind.case, own)
    judged = judged & ~causes.unjudged
    return judged, judged & (causes.cause == UNEXPLAINED)
