"""Renders a scene with a student's function, and finds which pixels are wrong.

A `Look` has the student's picture, a `Mark` for every pixel, and how many are right, the interior
and the boundary apart.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from reference_tracer.tracer import shading
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.nearest import keep_nearest, within_clip
from reference_tracer.tracer.progress import Progress, Work
from reference_tracer.tracer.world import world_corners

from .faults import UNRECOGNISED, Fault
from .judged_scene import JudgedScene, arrays
from .known import Ask, known
from .subjects.triangle import TRIANGLE
from .tally import Tally


class Mark(IntEnum):
    """The judgement of a pixel."""

    RIGHT = 0
    EDGE = 1  # wrong, but the ray passes within float64's rounding of an edge: not counted
    DEPTH_TIE = 2  # wrong, but two surfaces are within float64's rounding of one another
    MISSED = 3  # the nearest triangle is not said to be hit
    FALSE_HIT_IN_FRONT = 4  # a triangle that the ray does not hit hides the surface that it does
    FALSE_HIT = 5  # a triangle that the ray does not hit is shown where there is nothing
    WRONG_ORDER = 6  # both are said to be hit, and the wrong one is taken for the nearer
    WRONG_T = 7  # the right triangle and barycentrics, with a t that is off by more than rounding
    WRONG_BARYCENTRICS = 8  # the right triangle and t, and not the right barycentrics
    WRONG_T_AND_BARYCENTRICS = 9  # the right triangle, and neither
    RAISED = 10  # one of the pairs that its ray needs raises an exception


EXCUSED = Mark.EDGE, Mark.DEPTH_TIE
FALSE_HITS = Mark.FALSE_HIT_IN_FRONT, Mark.FALSE_HIT


@dataclass(frozen=True, eq=False)
class Look:
    """A student's picture of a scene; arrays are (h, w) or flat (n,) as the scene's."""

    judged: JudgedScene
    hits: Hits
    color: NDArray[np.float32]  # (h, w, 4)
    mark: NDArray[np.uint8]  # (h, w)
    lost: int  # pixels that see another surface than they should, those on the boundary included
    tally: Tally
    seconds: float

    @property
    def counts(self) -> dict[str, int]:
        """How many pixels have each mark, by its name."""
        return {m.name.lower(): int((self.mark == m).sum()) for m in Mark}


def look(judged: JudgedScene, ask: Ask, clock: Callable[[], float] = float) -> Work[Look]:
    """Trace a scene with a student's function, and judge every pixel.

    Parameters
    ----------
    judged : JudgedScene
    ask : callable
        Takes origins (p, 3), directions (p, 3), triangles (p, 3, 3); returns t (p,) and
        barycentrics (p, 3).
    clock : callable, optional
        Tells the seconds that the function itself has taken so far.

    Raises
    ------
    StudentError
        If the function fails.
    """
    began, count = clock(), len(judged.t)
    reported = np.zeros(count, bool)  # the true triangle is said to be hit
    raised = np.zeros(count, bool)
    hits = judged.planes.take(np.arange(count))
    for done, (some, *question) in enumerate(judged.questions()):
        t, s = ask(*question)
        raised[some.pixel[np.isneginf(t)]] = True
        hit = np.flatnonzero(np.isfinite(t) & within_clip(judged.scene.camera, t))
        pixel, instance, triangle = some.pixel[hit], some.instance[hit], some.triangle[hit]
        true = (instance == judged.instance[pixel]) & (triangle == judged.triangle[pixel])
        reported[pixel[true]] = True
        keep_nearest(hits, None, pixel, Hits.of(t[hit], instance, triangle, s[hit].T))
        yield Progress(done / len(judged.pairs))
    return _judged(judged, hits, reported, raised, clock() - began)


def in_scenes(looks: Sequence[Look]) -> Fault:
    """Return as a fault what is wrong in scenes where no check shows anything."""
    wrong = {k.judged.name: k.tally.total - min(k.tally.right.values()) for k in looks}
    text = "the checks are right, and some pixels are wrong: " + ", ".join(
        f"{count:,} in {name}" for name, count in wrong.items() if count
    )
    return Fault(f"{UNRECOGNISED}pixels", text, sum(wrong.values()))


def _judged(
    judged: JudgedScene,
    hits: Hits,
    reported: NDArray[np.bool_],
    raised: NDArray[np.bool_],
    seconds: float,
) -> Look:
    wrong = _wrong_surface(judged, hits) | raised
    mark = np.full(len(wrong), Mark.RIGHT, np.uint8)
    mark[wrong] = Mark.WRONG_ORDER
    missed = ~reported & (judged.triangle != NOTHING)
    mark[wrong & missed] = Mark.MISSED
    held = _held(judged, hits)
    # What hides nothing nearer is no reason: the pixel is wrong for what is missed in front of it.
    false = held.beside & ~(missed & (hits.t > judged.t))
    shows = judged.instance != NOTHING
    mark[wrong & false & shows] = Mark.FALSE_HIT_IN_FRONT
    mark[wrong & false & ~shows] = Mark.FALSE_HIT
    edge = judged.ambiguous | judged.near_edge
    mark[wrong & edge] = Mark.EDGE
    mark[wrong & judged.near_tie & ~edge] = Mark.DEPTH_TIE
    mark[raised] = Mark.RAISED
    on_triangle = (judged.triangle != NOTHING) | (hits.triangle != NOTHING) | raised
    right = ~wrong & (hits.triangle != NOTHING)
    inside = right & ~judged.boundary
    mark[inside & ~held.barycentrics] = Mark.WRONG_BARYCENTRICS
    mark[inside & ~held.t] = Mark.WRONG_T
    mark[inside & ~held.t & ~held.barycentrics] = Mark.WRONG_T_AND_BARYCENTRICS
    parts = {"surface": ~wrong, "t": right & held.t, "barycentrics": right & held.barycentrics}
    tally = Tally.of(on_triangle, judged.boundary & ~raised, parts, TRIANGLE.weights)
    color = shading.colors(judged.scene, hits).reshape(judged.color.shape)
    h, w = judged.shape
    return Look(judged, hits, color, mark.reshape(h, w), int(wrong.sum()), tally, seconds)


def _wrong_surface(judged: JudgedScene, hits: Hits) -> NDArray[np.bool_]:
    wrong = (hits.instance != judged.instance) | (hits.triangle != judged.triangle)
    for pixel in np.flatnonzero(wrong).tolist():
        if may := judged.ties.get(pixel):
            wrong[pixel] = (int(hits.instance[pixel]), int(hits.triangle[pixel])) not in may
    return wrong


class _Held(NamedTuple):
    """What a picture's hits are, held against the truth about the same pairs, (n,) each."""

    beside: NDArray[np.bool_]  # the ray does not meet the triangle that is shown
    t: NDArray[np.bool_]  # it is right within rounding
    barycentrics: NDArray[np.bool_]


def _held(judged: JudgedScene, hits: Hits) -> _Held:
    out = _Held(*np.zeros((3, len(hits)), bool))
    pixel = np.flatnonzero(hits.triangle != NOTHING)
    camera = judged.scene.camera
    corners = world_corners(judged.scene, hits.instance[pixel], hits.triangle[pixel])
    pairs = arrays(judged.rays, pixel, corners)
    truth = known(*pairs, camera.clip_start, camera.clip_end)
    out.beside[pixel] = ~truth.hit
    with np.errstate(invalid="ignore"):  # a student's NaN is wrong
        t_off = np.abs(hits.t[pixel] - truth.t)
        s_off = np.abs(hits.s[:, pixel].T - truth.s).max(axis=1)
        out.t[pixel] = (t_off <= truth.t_allowed) | ~np.isfinite(truth.t_allowed)
        out.barycentrics[pixel] = (s_off <= truth.s_allowed) | ~np.isfinite(truth.s_allowed)
    return out
