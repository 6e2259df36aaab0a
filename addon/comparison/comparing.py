"""Compares a scene with a picture, in small steps, and finds what is wrong with that.

`compared` is the one driver, of commands, operators and scripts.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..causes.case import Case, without_colors
from ..causes.counts import count_pixels
from ..causes.excused import excused
from ..causes.explain import explain
from ..diagnosis.fault_rows import FaultRow
from ..pictures.metrics import boundary, image_metrics
from ..rendering import steps
from ..tracer.frame import Frame
from ..tracer.memory import ALWAYS, COMPARED, check_memory
from ..tracer.progress import Found, Progress, Work, scaled
from .comparison import Comparison
from .mesh_diagnosis import diagnosed as with_mesh_faults
from .methods import list_methods

# Shares of the work, roughly. A self-check takes the larger part of it.
_TRACING, _METHODS = 0.4, 0.35
_CHECKING = 0.8
_CAUSES = 0.8  # of comparing: the rest is for metrics and counts
_COMPARING = 0.6  # of the work; nobody knows how long a diagnosis takes


def compared(case: Case, diagnose: bool = False, literally: bool = False) -> Work[Comparison]:
    """Diagnose the meshes, trace, compare, check the comparison, and find what is wrong.

    The comparison is found before what is wrong is looked for.

    Parameters
    ----------
    case : Case
    diagnose : bool
        Whether to diagnose unexplained pixels, if there are any.
    literally : bool
        Whether the literal textbook's picture is wanted, where it costs little.

    Raises
    ------
    SizeError, SceneError, PictureTooLargeError
        As :func:`trace_and_compare`.
    """
    manifest = yield from with_mesh_faults(case.scene, case.manifest)
    case = replace(case, manifest=manifest)
    work = trace_and_compare(case if case.picture.has_colors else without_colors(case), literally)
    found = yield from scaled(work, 0.0, _COMPARING if diagnose else 1.0)
    return (yield from diagnosed(found)) if diagnose else found


def trace_and_compare(case: Case, literally: bool = False) -> Work[Comparison]:
    """Trace a scene and compare it with the picture, in small steps.

    `literally` is as :func:`compared` has it.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    SceneError
        If its samples lie too far from the pixels' centres.
    PictureTooLargeError
        If there is not enough memory to compare them.
    """
    region = case.scene.camera.region
    check_memory(region.width, region.height, COMPARED, 2 * ALWAYS)  # frames ask for theirs again
    frame = Frame.empty(case.scene)
    case.picture.check(frame.color.shape)
    share = 1 - _CHECKING if case.self_check else 1.0
    tracing = steps(case.scene, case.settings, frame, case.tracer)
    yield from scaled(tracing, 0.0, share * _TRACING, "tracing")
    listing = list_methods(case.scene, case.settings, frame, case.tracer, literally)
    methods = yield from scaled(
        listing, share * _TRACING, share * _METHODS, "tracing by the textbook"
    )
    done = share * (_TRACING + _METHODS)
    found = yield from scaled(compare(case, frame), done, share - done)
    checked: tuple[FaultRow, ...] = ()
    if case.self_check:
        from ..diagnosis.self_check import self_check

        checked = yield from scaled(self_check(case, frame, found.causes), share, _CHECKING)
    return replace(found, methods=methods.rows, literal=methods.literal, self_check=checked)


def diagnosed(comparison: Comparison, place: str = "", at_most: float = np.inf) -> Work[Comparison]:
    """Return a comparison with what accounts for its unexplained pixels, if it has any.

    It is found without that first, in a `place` that is said. The verdict stays. The search ends
    after `at_most` steps of work, or after its own limit.
    """
    if not comparison.counts.unexplained:
        return comparison
    yield Found(comparison, f"verdict: {comparison.verdict}{place}; what is wrong is looked for")
    from ..diagnosis.diagnosis import diagnose  # late: the faults take long to import
    from ..diagnosis.guessing import STEPS

    yield Progress(None, "looking for what is wrong")
    steps = min(STEPS, at_most)
    work = diagnose(comparison.case, comparison.frame, comparison.causes, steps=steps)
    found = yield from scaled(work, 1.0, None)
    return replace(comparison, diagnosis=found)


def compare(case: Case, frame: Frame) -> Work[Comparison]:
    """Compare a traced frame with the picture.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    SceneError
        If its samples lie too far from the pixels' centres.
    """
    case.picture.check(frame.color.shape)
    found = yield from scaled(explain(case, frame), 0.0, _CAUSES, "looking for causes")
    traced, picture = found.frame, found.case.picture  # both before the picture's own background
    color, *pair = picture.measured_with(traced)
    traced = replace(traced, color=color)
    measuring = image_metrics(*pair)
    measured = yield from scaled(measuring, _CAUSES, 1 - _CAUSES, "measuring differences")
    identity = picture.identity(traced.instance_index)
    yield None
    at_boundary = boundary(traced)
    yield None
    features = [str(u) for u in case.manifest.unmodelled]
    counts = count_pixels(found.causes, at_boundary, identity, features)
    yield None
    return Comparison(
        found.case,
        traced,
        found.causes,
        counts,
        measured,
        excused(found.case, traced, found.causes),
        identity=identity,
        background=found.background,
    )
