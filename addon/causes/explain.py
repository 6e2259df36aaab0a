"""Finds out why each pixel differs: the causes, and their checks in order.

A check can fail. It gives its cause only if the tracer itself, asked again, sees what Blender
shows, or if something that the tracer does not model is drawn in that very pixel. What may change a
picture anywhere, as light does, excuses anything: the comparison then says that it cannot judge.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..arrays import Bools, Floats, Places
from ..pictures.bands import band_of
from ..pictures.bounds import DECIDABLE
from ..rendering import frame_of
from ..tracer import shading
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.progress import Work, scaled
from .case import Case
from .cause import AGREE, NOT_DECIDABLE, NOT_TRACED, UNEXPLAINED, Cause, Causes
from .checks import anti_aliasing, behind, clip, color, edges, hidden, identity, unmodelled
from .checks.anti_aliasing import ANTI_ALIASING
from .checks.background import Background, find_background
from .checks.clip import CLIP_PLANE
from .checks.color import COLOR
from .checks.edges import DEPTH_TIE, EDGE
from .checks.hidden import HIDDEN
from .checks.probe import OpenPixels, by_blocks, other_color
from .checks.unmodelled import NOT_MODELLED
from .embree import not_decidable

# All causes, in the order of the legend.
CAUSES: tuple[Cause, ...] = (
    AGREE,
    EDGE,
    DEPTH_TIE,
    CLIP_PLANE,
    ANTI_ALIASING,
    COLOR,
    NOT_MODELLED,
    HIDDEN,
    NOT_DECIDABLE,
    UNEXPLAINED,
    NOT_TRACED,
)
BY_NUMBER = {cause.number: cause for cause in CAUSES}

Checks = list[tuple[Callable[[OpenPixels], Work[None]], float]]  # with their shares of the work

# The checks in their order: the first that accounts for a pixel gives its cause.
# If none does, it is unexplained. With the share of each in the work, roughly. The first one looks
# at the whole picture.
CHECKS: Checks = [
    (color.check, 0.02),
    (anti_aliasing.check, 0.1),
    (edges.check, 0.6),
    (clip.check, 0.1),
    (unmodelled.check_otherwise, 0.05),
    (hidden.check, 0.1),
    (unmodelled.check_everywhere, 0.01),
]
_OPENING = 0.1  # of the work, before the checks

MANY = 1 << 16  # differing pixels: of more, a sample is checked first
ASKED_FIRST = 1 << 14  # of these
NEARLY_NONE = 0.01  # of the sample: where fewer have a cause, the others are not checked


class Explained(NamedTuple):
    """The causes of a comparison, and the case and frame on the picture's own background."""

    case: Case
    frame: Frame
    background: Background | None  # where the picture's is not the scene's
    causes: Causes


def explain(case: Case, frame: Frame, at_most: int | None = None) -> Work[Explained]:
    """Find out why the pixels of a traced frame differ, as a comparison and its self-check do.

    With `at_most`, no more differing pixels are checked: see :func:`find_causes`.
    """
    background = None
    if case.curves is not None and not frame.cancelled:
        background = yield from find_background(frame, case.picture, case.curves)
    if background:
        case = case.before(np.array(background.picture, np.float32))
        frame = yield from scaled(_before(case, frame), 0.1, 0.1)
    case = yield from identity.without_contradictions(case, frame)
    causes = yield from scaled(find_causes(case, frame, at_most), 0.25, 0.75)
    return Explained(case, frame, background, causes)


def _before(case: Case, frame: Frame) -> Work[Frame]:
    """Put a traced frame on the case's background; trace again if pixels mix several samples."""
    color = frame.color.copy()
    color[frame.instance_index == NOTHING] = case.scene.background
    if case.settings.samples > 1:
        again = yield from frame_of(case.scene, case.settings)
        color = again.color
    return replace(frame, scene=case.scene, color=color)


def find_causes(case: Case, frame: Frame, at_most: int | None = None) -> Work[Causes]:
    """Give every pixel of a traced frame its cause.

    With `at_most`, no more differing pixels are checked, spread over the picture. The others keep
    AGREE, and are in `Causes.passed_over`; no objects in another shade are named.

    Where very many differ, some are asked first. If nearly none of these has a cause, something is
    wrong as a whole: the others are unexplained, too, without being asked (`Causes.not_asked`).
    """
    out = Causes.none(frame.shape)
    out.blind = unmodelled.blind(case, frame)
    picture = unmodelled.as_known(case)
    band = band_of(case.scene, frame, picture.sampling.renderer)
    pixels = OpenPixels(case, frame, picture, out, np.zeros(frame.shape, bool), band)
    yield from _open(pixels)
    yield from unmodelled.check_in_place(pixels)
    if at_most is not None:
        out.passed_over = _thin(pixels.open, at_most)
        yield from scaled(_checked(pixels, CHECKS), _OPENING, 1 - _OPENING)
    else:
        coloring, *others = CHECKS
        yield from scaled(_checked(pixels, [coloring]), 0.0, _OPENING)
        yield from scaled(_some_first(pixels, others), _OPENING, 1 - _OPENING)
    pixels.give(pixels.open, UNEXPLAINED)
    yield from scaled(behind.check(pixels, find_causes), 1.0, 0.0)
    yield from unmodelled.name_drawn(pixels)
    if at_most is None:
        yield from color.name_shades(pixels)
    return out


def _checked(pixels: OpenPixels, checks: Checks) -> Work[None]:
    """Ask the open pixels by some checks, one after the other."""
    done, weights = 0.0, sum(weight for _, weight in checks)
    for check, weight in checks:
        yield from scaled(check(pixels), done, weight / weights)
        done += weight / weights


def _some_first(pixels: OpenPixels, checks: Checks) -> Work[None]:
    """Ask the open pixels; where they are many, the others only if some of the first have a cause.

    They are open again in the end, so that they become unexplained.
    """
    others = _thin(pixels.open, ASKED_FIRST if pixels.open.sum() > MANY else pixels.open.size)
    yield from scaled(_checked(pixels, checks), 0.0, 0.1 if len(others) else 1.0)
    explained = len(others) and ASKED_FIRST - int(pixels.open.sum())
    pixels.open.flat[others] = True
    if explained > NEARLY_NONE * ASKED_FIRST:
        yield from scaled(_checked(pixels, checks), 0.1, 0.9)
    else:
        pixels.out.not_asked = len(others)


def _open(pixels: OpenPixels) -> Work[None]:
    """Open the pixels that differ and are decidable."""
    scene = pixels.case.scene
    frame = pixels.frame
    seen = frame.instance_index
    moved = yield from _moved(pixels)
    if not pixels.picture.has_colors:
        finding = by_blocks(frame.shape, lambda rows: ~pixels.picture.at(rows).shows(frame, rows))
    else:
        ramp = shading.interpolated(scene, seen)
        finding = other_color(pixels.picture, frame.color, ramp)
    differ = yield from finding
    pixels.open[:] = differ | pixels.picture.other_object(seen)
    pixels.give(np.broadcast_to(~frame.rows_done[:, None], frame.shape), NOT_TRACED)
    # Not only where the pictures differ: a pixel that agrees by accident proves nothing.
    pixels.give(moved > DECIDABLE, NOT_DECIDABLE, moved, DECIDABLE)


def _moved(pixels: OpenPixels) -> Work[Floats]:
    """Return how far float32 may move what pixels show, (h, w) px; 0 where that is decidable."""
    frame = pixels.frame
    sampling = pixels.picture.sampling
    out: Floats = np.zeros(frame.shape)
    if not pixels.band.most + sampling.off_center <= DECIDABLE:
        yield from pixels.band.find(np.ones(frame.shape, bool))
        out = pixels.bands(slice(None))
    if sampling.farthest < np.inf:
        out[not_decidable(pixels.case.scene, frame, sampling.farthest)] = np.inf
    return out


def _thin(open_: Bools, most: int) -> Places:
    """Close open pixels until no more than `most` are left; return which were closed."""
    found = np.flatnonzero(open_)
    count = min(most, len(found))
    left = np.arange(count) * len(found) // max(count, 1)  # all of them, if they are few enough
    closed = np.delete(found, left)
    open_.flat[closed] = False
    return closed
