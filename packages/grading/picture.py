"""Renders a scene with a student's function, and finds which pixels are wrong.

A `Look` has the student's picture, a `Mark` for every pixel, and how many are right, the interior
and the boundary apart.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray
from reference_tracer.tracer import shading
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.nearest import within_clip
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
    found = []
    for done, (some, truth, *question) in enumerate(judged.questions()):
        t, s = ask(*question)
        raised[some.pixel[np.isneginf(t)]] = True
        hit = np.flatnonzero(np.isfinite(t) & within_clip(judged.scene.camera, t))
        pixel, instance, triangle = some.pixel[hit], some.instance[hit], some.triangle[hit]
        true = (instance == judged.instance[pixel]) & (triangle == judged.triangle[pixel])
        reported[pixel[true]] = True
        found.append((pixel, t[hit], instance, triangle, s[hit], truth.hit[hit]))
        yield Progress(done / len(judged.pairs))
    hits, really = _nearest(judged, found)
    false = (hits.triangle != NOTHING) & ~really
    return _judged(judged, hits, false, reported, raised, clock() - began)


def in_scenes(looks: Sequence[Look]) -> Fault:
    """Return as a fault what is wrong in scenes where no check shows anything."""
    wrong = {k.judged.name: k.tally.total - min(k.tally.right.values()) for k in looks}
    text = "the checks are right, and some pixels are wrong: " + ", ".join(
        f"{count:,} in {name}" for name, count in wrong.items() if count
    )
    return Fault(f"{UNRECOGNISED}pixels", text, sum(wrong.values()))


def _nearest(judged: JudgedScene, found: list[tuple]) -> tuple[Hits, NDArray[np.bool_]]:
    """Return the nearest of all that is said to be hit, and whether it truly is."""
    p = judged.planes
    hits = Hits.of(p.t.copy(), p.instance.copy(), p.triangle.copy(), p.s.copy())
    really = np.ones(len(hits.t), bool)
    if not found:
        return hits, really
    pixel, t, instance, triangle, s, true = (np.concatenate(c) for c in zip(*found, strict=True))
    order = np.lexsort((triangle, instance, t, pixel))
    first = order[np.flatnonzero(np.diff(pixel[order], prepend=-1))]
    first = first[t[first] <= hits.t[pixel[first]]]
    at = pixel[first]
    hits.t[at], hits.instance[at], hits.triangle[at] = t[first], instance[first], triangle[first]
    hits.s[:, at], really[at] = s[first].T, true[first]
    return hits, really


def _judged(
    judged: JudgedScene,
    hits: Hits,
    false: NDArray[np.bool_],
    reported: NDArray[np.bool_],
    raised: NDArray[np.bool_],
    seconds: float,
) -> Look:
    wrong = _wrong_surface(judged, hits) | raised
    mark = np.full(len(wrong), Mark.RIGHT, np.uint8)
    mark[wrong] = Mark.WRONG_ORDER
    missed = ~reported & (judged.triangle != NOTHING)
    mark[wrong & missed] = Mark.MISSED
    # What hides nothing nearer is no reason: the pixel is wrong for what is missed in front of it.
    false &= ~(missed & (hits.t > judged.t))
    shows = judged.instance != NOTHING
    mark[wrong & false & shows] = Mark.FALSE_HIT_IN_FRONT
    mark[wrong & false & ~shows] = Mark.FALSE_HIT
    edge = judged.ambiguous | judged.near_edge
    mark[wrong & edge] = Mark.EDGE
    mark[wrong & judged.near_tie & ~edge] = Mark.DEPTH_TIE
    mark[raised] = Mark.RAISED
    on_triangle = (judged.triangle != NOTHING) | (hits.triangle != NOTHING) | raised
    right = ~wrong & (hits.triangle != NOTHING)
    t_right, s_right = _values(judged, hits, np.flatnonzero(right))
    inside = right & ~judged.boundary
    mark[inside & ~s_right] = Mark.WRONG_BARYCENTRICS
    mark[inside & ~t_right] = Mark.WRONG_T
    mark[inside & ~t_right & ~s_right] = Mark.WRONG_T_AND_BARYCENTRICS
    parts = {"surface": ~wrong, "t": right & t_right, "barycentrics": right & s_right}
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


def _values(
    judged: JudgedScene, hits: Hits, pixel: NDArray
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return whether t and barycentrics are right within rounding, (n,) each, of some pixels."""
    t_right, s_right = (np.zeros(len(hits.t), bool) for _ in range(2))
    corners = world_corners(judged.scene, hits.instance[pixel], hits.triangle[pixel])
    truth = known(*arrays(judged.rays, pixel, corners))
    with np.errstate(invalid="ignore"):  # a student's NaN is wrong
        t_off = np.abs(hits.t[pixel] - truth.t)
        s_off = np.abs(hits.s[:, pixel].T - truth.s).max(axis=1)
        t_right[pixel] = (t_off <= truth.t_allowed) | ~np.isfinite(truth.t_allowed)
        s_right[pixel] = (s_off <= truth.s_allowed) | ~np.isfinite(truth.s_allowed)
    return t_right, s_right
