"""Why a pixel differs: the checks in their order. Each can fail, and keeps its figure of a pixel.

In come two pictures of one scene and what was traced; out goes a cause for every pixel that
differs. A cause is only given where the tracer itself, asked again, sees what Blender shows, or
where something is drawn in that very pixel that the tracer does not model. What may change a
picture anywhere, as light does, excuses anything there: the comparison says that it cannot judge.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..rendering import steps
from ..tracer import shading
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.progress import Work, scaled
from ..tracer.render import tiles
from .bounds import SNAPPING, sample_band
from .case import Case
from .cause import Cause, Causes
from .checks import anti_aliasing, clip, color, edges, hidden, identity, unmodelled
from .checks.background import Background, find_background
from .checks.probe import OpenPixels

DECIDABLE = 0.5  # pixels: within a larger band, what lies there explains nothing

# What a pixel is asked, in this order, and the weight of each check in the work. The first check
# that accounts for a pixel gives it its cause; what none accounts for is unexplained.
CHECKS: list[tuple[Callable[[OpenPixels], Work[None]], float]] = [
    (color.check, 0.02),
    (anti_aliasing.check, 0.1),
    (edges.check, 0.6),
    (clip.check, 0.1),
    (unmodelled.check_otherwise, 0.05),
    (hidden.check, 0.1),
    (unmodelled.check_everywhere, 0.01),
]
_OPENING = 0.1  # of the work, before the checks


class Explained(NamedTuple):
    """A comparison's pixels with their causes, before the background that the picture has."""

    case: Case
    frame: Frame
    background: Background | None  # where the picture has one that the scene has not
    causes: Causes


def explain(case: Case, frame: Frame, at_most: int | None = None) -> Work[Explained]:
    """Say why the pixels of a traced frame differ; the comparison and its self-check do the same.

    No more than `at_most` differing pixels are looked at, if given: see :func:`find_causes`.
    """
    background = None
    if case.curves is not None and not frame.cancelled:
        background = yield from scaled(find_background(frame, case.picture, case.curves), 0.0, 0.1)
    if background:
        case = case.before(np.array(background.picture, np.float32))
        frame = yield from scaled(_before(case, frame), 0.1, 0.1)
    case = yield from scaled(identity.without_contradictions(case, frame), 0.2, 0.05)
    causes = yield from scaled(find_causes(case, frame, at_most), 0.25, 0.75)
    return Explained(case, frame, background, causes)


def _before(case: Case, frame: Frame) -> Work[Frame]:
    """Return a traced frame before another background, the case's; traced again if it is mixed."""
    color = frame.color.copy()
    color[frame.instance_index == NOTHING] = case.scene.background
    if case.settings.samples > 1:
        again = Frame.empty(case.scene)
        yield from steps(case.scene, case.settings, again)
        color = again.color
    return replace(frame, scene=case.scene, color=color)


def find_causes(case: Case, frame: Frame, at_most: int | None = None) -> Work[Causes]:
    """Give every pixel of a traced frame its cause; yields the share of the work done.

    No more than `at_most` differing pixels are looked at, if given, spread over the picture; the
    others keep AGREE, and are in `Causes.passed_over`.
    """
    out, shape = Causes.none(frame.shape), frame.shape
    out.blind = unmodelled.blind(case, frame)
    picture = unmodelled.as_known(case)
    pixels = OpenPixels(case, frame, picture, out, np.zeros(shape, bool), np.zeros(shape))
    yield from scaled(_open(pixels), 0.0, _OPENING)
    yield from scaled(unmodelled.check_in_place(pixels), _OPENING, 0.0)
    if at_most is not None:
        out.passed_over = _thin(pixels.open, at_most)
    done, weights = _OPENING, sum(weight for _, weight in CHECKS)
    for check, weight in CHECKS:
        share = (1 - _OPENING) * weight / weights
        yield from scaled(check(pixels), done, share)
        done += share
    pixels.settle(pixels.open, Cause.UNEXPLAINED)
    yield from scaled(unmodelled.settle_drawn(pixels), 1.0, 0.0)
    yield from scaled(color.name_shades(pixels), 1.0, 0.0)
    return out


def _open(pixels: OpenPixels) -> Work[None]:
    """Open the pixels that differ, but those of which nothing can be said; find the band."""
    scene, frame, region = pixels.case.scene, pixels.frame, pixels.case.scene.camera.region
    all_rows = [slice(t.y0 - region.y0, t.y1 - region.y0) for t in tiles(scene.camera)]
    pixels.band = yield from sample_band(scene, frame, all_rows)
    pixels.band += pixels.picture.sample_radius + max(pixels.picture.snapping - SNAPPING, 0.0)
    for rows in all_rows:
        part, seen = pixels.rows(rows), frame.instance_index[rows]
        ramp = shading.interpolated(scene, seen)
        differ = part.picture.other_color(frame.color[rows], ramp)
        part.open[:] = differ | part.picture.other_object(seen)
        part.settle(~frame.rows_done[rows, None], Cause.NOT_TRACED)
        # Not only where the pictures differ: a pixel that agrees by accident proves nothing.
        part.settle(part.band > DECIDABLE, Cause.NOT_DECIDABLE, part.band, DECIDABLE)
        yield 1.0


def _thin(open_: NDArray[np.bool_], most: int) -> NDArray[np.intp]:
    """Close open pixels but so many; return which were closed."""
    found = np.flatnonzero(open_)
    kept = np.linspace(0, len(found) - 1, min(most, len(found))).astype(int)
    closed = np.delete(found, kept)
    open_.flat[closed] = False
    return closed
