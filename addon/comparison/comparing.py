"""Compares a scene with a picture, in small steps, and finds what is wrong with that.

`compared` is the one driver, of commands, operators and scripts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ..causes.case import Case, without_colors
from ..causes.counts import count_pixels
from ..causes.excused import excused
from ..causes.explain import explain
from ..diagnosis.fault_rows import FaultRow
from ..pictures.metrics import boundary, image_metrics
from ..rendering import steps
from ..tracer.frame import Frame
from ..tracer.memory import ALWAYS, COMPARED, check_memory
from ..tracer.progress import Work, called, scaled
from .comparison import Comparison
from .mesh_diagnosis import diagnosed as with_mesh_faults
from .methods import list_methods

# Shares of the work, roughly. A self-check takes the larger part of it.
_TRACING, _METHODS = 0.4, 0.35
_CHECKING = 0.8
_CAUSES = 0.8  # of comparing: the rest is for metrics and counts


def _not_kept(comparison: Comparison) -> Work[None]:
    yield 0.0


def compared(
    case: Case,
    diagnose: bool = False,
    told: Callable[[Comparison], object] = lambda found: None,
    kept: Callable[[Comparison], Work[None]] = _not_kept,
    shares: tuple[float, float] = (0.6, 0.6),
    literally: bool = False,
) -> Work[Comparison]:
    """Diagnose the meshes, trace, compare, check the comparison, and find what is wrong.

    Yields the share of the work done; the caller stops by not asking for more, and has what was
    kept before.

    Parameters
    ----------
    case : Case
    diagnose : bool
        Whether to diagnose unexplained pixels, if there are any.
    told : callable
        Called with the comparison before the diagnosis starts.
    kept : callable
        Makes the step that saves a comparison: run after comparing, and again after diagnosing.
    shares : (float, float)
        Shares of the work done when the comparison exists, and when it is saved.
    literally : bool
        Whether the literal textbook's picture is wanted, where it costs little.

    Raises
    ------
    SizeError, SceneError, PictureTooLargeError
        As :func:`trace_and_compare`.
    """
    there, safe = shares
    manifest = yield from with_mesh_faults(case.scene, case.manifest)
    case = replace(case, manifest=manifest)
    work = trace_and_compare(case if case.picture.has_colors else without_colors(case), literally)
    found = yield from scaled(work, 0.0, there)
    yield from scaled(kept(found), there, safe - there)
    if diagnose:
        found = yield from scaled(diagnosed(found, told=told), safe, 1 - safe)
        if found.diagnosis:
            yield from scaled(kept(found), 1.0, 0.0)
    return found


def trace_and_compare(case: Case, literally: bool = False) -> Work[Comparison]:
    """Trace a scene and compare it with the picture, in small steps.

    Yields the share of the work done; the caller stops by not asking for more. `literally` is as
    :func:`compared` has it.

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
    rest = 1 - _CHECKING if case.self_check else 1.0
    tracing = called(steps(case.scene, case.settings, frame, case.tracer), "tracing")
    yield from scaled(tracing, 0.0, rest * _TRACING)
    listing = list_methods(case.scene, case.settings, frame, case.tracer, literally)
    listing = called(listing, "tracing by the textbook")
    methods = yield from scaled(listing, rest * _TRACING, rest * _METHODS)
    done = rest * (_TRACING + _METHODS)
    found = yield from scaled(compare(case, frame), done, 1 - done)
    return replace(found, methods=methods.rows, literal=methods.literal)


def diagnosed(
    comparison: Comparison,
    told: Callable[[Comparison], object] = lambda found: None,
) -> Work[Comparison]:
    """Return a comparison with what accounts for its unexplained pixels, if it has any.

    Yields the share of the work done. The verdict stays. `told` hears of the comparison if it has
    any.
    """
    if not comparison.counts.unexplained:
        return comparison
    from ..diagnosis.diagnosis import diagnose  # late: the faults take long to import

    told(comparison)
    case, frame, causes = comparison.case, comparison.frame, comparison.causes
    work = diagnose(case, frame, causes)
    found = yield from called(work, "looking for what is wrong", over=False)
    return replace(comparison, diagnosis=found)


def compare(case: Case, frame: Frame) -> Work[Comparison]:
    """Compare a traced frame with the picture; yields the share of the work done.

    Raises
    ------
    SizeError
        If the picture is not of the frame's size.
    SceneError
        If its samples lie too far from the pixels' centres.
    """
    case.picture.check(frame.color.shape)
    rest = 1 - _CHECKING if case.self_check else 1.0
    explaining = called(explain(case, frame), "looking for causes")
    found = yield from scaled(explaining, 0.0, rest * _CAUSES)
    traced, picture = found.frame, found.case.picture  # both before the picture's own background
    color, *pair = picture.measured_with(traced)
    traced = replace(traced, color=color)
    measuring = called(image_metrics(*pair), "measuring differences")
    measured = yield from scaled(measuring, rest * _CAUSES, rest * (1 - _CAUSES))
    identity = picture.identity(traced.instance_index)
    yield rest
    at_boundary = boundary(traced)
    yield rest
    features = [str(u) for u in case.manifest.unmodelled]
    counts = count_pixels(found.causes, at_boundary, identity, features)
    yield rest
    checked: tuple[FaultRow, ...] = ()
    if case.self_check:
        from ..diagnosis.self_check import self_check

        checking = self_check(case, frame, found.causes)
        checked = yield from scaled(checking, rest, _CHECKING)
    return Comparison(
        found.case,
        traced,
        found.causes,
        counts,
        measured,
        excused(found.case, traced, found.causes),
        identity=identity,
        self_check=checked,
        background=found.background,
    )
