"""Fills a 3D view's picture in steps: one function for each thing that it can show.

All but the picture of F12 show how each pixel came about, by the one ray through its centre.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...arrays import Bools, Colors, parts
from ...causes.cause import AGREE, UNEXPLAINED, Causes
from ...causes.explain import CAUSES, explain
from ...causes.maps import WRONG, cause_map, certainty_map, dimmed, ringed
from ...certainty import Certainty
from ...methods import Method
from ...rendering import steps
from ...scene import Camera, Scene
from ...tracer.coloring import Color
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Event, Work
from ...tracer.settings import Settings
from . import like_for_like

ROWS = 64  # entered together, in some milliseconds
MOST_EXPLAINED = 5_000  # of the pixels that differ: in a second or two


@dataclass(eq=False)
class Picture:
    """A picture of h x w pixels in the making: a camera's region, row 0 at the bottom.

    With a new array in `color` the whole picture is shown anew.
    """

    color: Colors  # (h, w, 4) linear RGBA, alpha premultiplied
    rows_done: Bools  # (h,) whether the row's colours are known
    space: int  # the address of the 3D view's space
    is_coarse: bool  # whether its pixels are larger than the view's
    line: str = ""  # text in the view's corner
    waits: bool = False  # for others

    @classmethod
    def empty(cls, camera: Camera, space: int = 0, is_coarse: bool = False) -> Picture:
        """Return one with no row done."""
        region = camera.region
        color = np.zeros((region.height, region.width, 4), np.float32)
        return cls(color, np.zeros(region.height, bool), space, is_coarse)


# Fills a picture in steps of some milliseconds.
Steps = Callable[[Scene, Settings, Picture], Iterator[Event]]
Rows = Callable[[Frame, slice], Colors]  # what is shown of rows of a frame, linear RGBA


def picture(scene: Scene, settings: Settings, shown: Picture) -> Iterator[Event]:
    """Trace the picture of F12."""
    frame = Frame.empty(scene)
    shown.color = frame.color
    shown.rows_done = frame.rows_done
    yield from steps(scene, settings, frame)


def colored(color: Color, scene: Scene, settings: Settings, shown: Picture) -> Iterator[Event]:
    """Trace one of the things that a render can show of a surface."""
    yield from _traced(scene, replace(settings, color=color), shown, lambda f, r: f.color[r])


def wrong_pixels(scene: Scene, settings: Settings, shown: Picture) -> Iterator[Event]:
    """Trace by the settings' method, and mark where it sees another surface than is proven."""
    if settings.method.is_proven:
        frame = yield from _traced(scene, settings, shown, _quiet)
        proven = ["every pixel is proven, so none is wrong: choose another method"]
        [shown.line] = frame.statistics.notes[:1] or proven
        return
    truth = Frame.empty(scene)
    yield from steps(scene, Settings(Method.CERTIFIED), truth)

    def marked(f: Frame, rows: slice) -> Colors:
        out = _quiet(f, rows)
        out[f.wrong_against(truth)[rows]] = (*WRONG, 1)
        return out

    frame = yield from _traced(scene, settings, shown, marked)
    wrong = frame.wrong_against(truth)
    shown.color = ringed(shown.color, wrong)
    name = f"{settings.precision} {settings.method.record.words}"
    shown.line = f"{name}: {wrong.sum():,} wrong of {wrong.size:,} pixels"


def certainty(scene: Scene, settings: Settings, shown: Picture) -> Iterator[Event]:
    """Trace, and show how each pixel was decided."""
    frame = yield from _traced(
        scene, settings, shown, lambda f, r: certainty_map(f.color[r], f.certainty[r])
    )
    shown.color = ringed(shown.color, frame.certainty > Certainty.BOUND)
    counts = ((c, int((frame.certainty == c).sum())) for c in Certainty)
    shown.line = ", ".join(f"{n:,} {c.words}" for c, n in counts if n)


def difference(scene: Scene, settings: Settings, shown: Picture) -> Iterator[Event]:
    """Trace, have Blender draw the same once the view rests, and show why pixels differ."""
    settings = replace(settings, samples=1, color=Color.OBJECT)
    frame = yield from _traced(scene, settings, shown, _quiet)
    if shown.is_coarse:
        return
    shown.line = "Blender's viewport draws the same once the view rests"
    while like_for_like.is_busy():
        shown.waits = True
        yield None
    shown.waits = False
    case = like_for_like.case_of(shown.space, scene, settings)
    yield None
    frame = replace(frame, scene=case.scene)
    if scene.planes:  # which may have other colours there
        frame = Frame.empty(case.scene)
        yield from steps(case.scene, settings, frame)
    frame.color[frame.instance_index == NOTHING] = case.scene.background
    causes = (yield from explain(case, frame, MOST_EXPLAINED)).causes
    color = np.empty_like(shown.color)
    for rows in parts(len(color), ROWS):
        color[rows] = cause_map(frame.color[rows], causes.cause[rows], opaque=False)
        yield None
    nothing = (frame.instance_index == NOTHING) & (causes.cause == AGREE)
    color[nothing] = scene.background
    color.reshape(-1, 4)[causes.passed_over] = 1
    shown.color = ringed(color, causes.cause != AGREE)
    shown.line = _summary(causes)


def _summary(causes: Causes) -> str:
    """Return how many pixels differ from Blender's viewport, and why."""
    counts = {c: int((causes.cause == c).sum()) for c in CAUSES}
    passed = len(causes.passed_over)
    found = [f"{n:,} {c.label}" for c, n in counts.items() if n and c != AGREE]
    if passed:
        found.append(f"{passed:,} not checked (white)")
    differ = sum(n for c, n in counts.items() if c.explains or c == UNEXPLAINED) + passed
    line = f"{differ:,} of {causes.cause.size:,} pixels differ from Blender's viewport"
    return f"{line}: {', '.join(found)}" if found else line


def _quiet(frame: Frame, rows: slice) -> Colors:
    """Return rows of a frame, dimmed; where nothing is hit, the view's own background stays."""
    out = dimmed(frame.color[rows])
    nothing = frame.instance_index[rows] == NOTHING
    out[nothing] = frame.color[rows][nothing]
    return out


def _traced(scene: Scene, settings: Settings, shown: Picture, rows: Rows) -> Work[Frame]:
    """Trace one ray a pixel, and show the rows that are done as `rows` makes them."""
    frame = Frame.empty(scene)
    for event in steps(scene, replace(settings, samples=1), frame):
        new = np.flatnonzero(frame.rows_done & ~shown.rows_done)
        for part in parts(len(new), ROWS):
            some = slice(new[part][0], new[part][-1] + 1)
            shown.color[some] = rows(frame, some)
            shown.rows_done[some] = True
            yield event
        yield event
    return frame


# By the identifiers in `ui/choices.py`, which has Blender's words for each.
SHOWS: dict[str, Steps] = {
    "PICTURE": picture,
    "WRONG": wrong_pixels,
    "DIFFERENCE": difference,
    "CERTAINTY": certainty,
    **{color.name: partial(colored, color) for color in Color},
}
