"""Renders a scene with a student's function, and finds which pixels are wrong.

A `Look` has the student's picture, a `Mark` for every pixel, and how many are right, the interior
and the boundary apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from reference_tracer.arrays import Bools, Bytes, Colors
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
from .wrong_case import WrongCase


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
    color: Colors  # (h, w, 4)
    mark: Bytes  # (h, w)
    lost: int  # pixels that see another surface than they should, those on the boundary included
    tally: Tally
    seconds: float = 0.0  # that the function itself has taken
    examples: Sequence[WrongCase] = ()  # some of the wrong pixels

    @property
    def counts(self) -> dict[str, int]:
        """How many pixels have each mark, by its name."""
        return {m.name.lower(): int((self.mark == m).sum()) for m in Mark}


def look(judged: JudgedScene, ask: Ask) -> Work[Look]:
    """Trace a scene with a student's function, and judge every pixel.

    Parameters
    ----------
    judged : JudgedScene
    ask : callable
        Takes origins (p, 3), directions (p, 3), triangles (p, 3, 3); returns t (p,) and
        barycentrics (p, 3).

    Raises
    ------
    StudentError
        If the function fails.
    """
    count = len(judged.t)
    # The true triangle is said to be hit; a pair raises.
    reported, raised = np.zeros((2, count), bool)
    hits = judged.planes.take(np.arange(count))
    for done, some in enumerate(judged.pairs):
        t, s = ask(*arrays(judged.rays, some.pixel, some.corners))
        raised[some.pixel[np.isneginf(t)]] = True
        hit = np.flatnonzero(np.isfinite(t) & within_clip(judged.scene.camera, t))
        pixel, instance, triangle = some.pixel[hit], some.instance[hit], some.triangle[hit]
        true = (instance == judged.instance[pixel]) & (triangle == judged.triangle[pixel])
        reported[pixel[true]] = True
        keep_nearest(hits, None, pixel, Hits.of(t[hit], instance, triangle, s[hit].T))
        yield Progress(done / len(judged.pairs))
    return _judged(judged, hits, reported, raised)


def in_scenes(looks: Sequence[Look]) -> Fault:
    """Return as a fault what is wrong in scenes where no check shows anything."""
    wrong = {k.judged.name: k.tally.total - min(k.tally.right.values()) for k in looks}
    text = "the checks are right, and some pixels are wrong: " + ", ".join(
        f"{count:,} in {name}" for name, count in wrong.items() if count
    )
    return Fault(f"{UNRECOGNISED}pixels", text, sum(wrong.values()))


def _judged(judged: JudgedScene, hits: Hits, reported: Bools, raised: Bools) -> Look:
    differs = (hits.instance != judged.instance) | (hits.triangle != judged.triangle)
    wrong = differs & ~judged.ties.may_see(judged.chosen, hits.instance, hits.triangle) | raised
    missed = ~reported & (judged.triangle != NOTHING)
    beside, right_t, right_s = _held(judged, hits)
    # What hides nothing nearer is no reason: the pixel is wrong for what is missed in front of it.
    false = wrong & beside & ~(missed & (hits.t > judged.t))
    right = ~wrong & (hits.triangle != NOTHING)
    inside = right & ~judged.boundary
    marks = {  # the first that holds
        Mark.RAISED: raised,
        Mark.EDGE: wrong & (judged.ambiguous | judged.near_edge),
        Mark.DEPTH_TIE: wrong & judged.near_tie,
        Mark.FALSE_HIT_IN_FRONT: false & (judged.instance != NOTHING),
        Mark.FALSE_HIT: false,
        Mark.MISSED: wrong & missed,
        Mark.WRONG_ORDER: wrong,
        Mark.WRONG_T_AND_BARYCENTRICS: inside & ~right_t & ~right_s,
        Mark.WRONG_T: inside & ~right_t,
        Mark.WRONG_BARYCENTRICS: inside & ~right_s,
    }
    mark = np.select([*marks.values()], [*marks], Mark.RIGHT).astype(np.uint8)
    on_triangle = (judged.triangle != NOTHING) | (hits.triangle != NOTHING) | raised
    parts = {"surface": ~wrong, "t": right & right_t, "barycentrics": right & right_s}
    tally = Tally.of(on_triangle, judged.boundary & ~raised, parts, TRIANGLE.weights)
    color = shading.colors(judged.scene, hits).reshape(judged.color.shape)
    mark = mark.reshape(judged.shape)
    return Look(judged, hits, color, mark, int(wrong.sum()), tally)


def _held(judged: JudgedScene, hits: Hits) -> tuple[Bools, Bools, Bools]:
    """Hold a picture's hits against the truth about the same pairs, (n,) each.

    Whether the ray does not meet the triangle that is shown; whether its t, and its barycentrics,
    are right within rounding.
    """
    beside, right_t, right_s = np.zeros((3, len(hits)), bool)
    pixel = np.flatnonzero(hits.triangle != NOTHING)
    camera = judged.scene.camera
    corners = world_corners(judged.scene, hits.instance[pixel], hits.triangle[pixel])
    pairs = arrays(judged.rays, pixel, corners)
    truth = known(*pairs, camera.clip_start, camera.clip_end)
    beside[pixel] = ~truth.hit
    with np.errstate(invalid="ignore"):  # a student's NaN is wrong
        t_off = np.abs(hits.t[pixel] - truth.t)
        s_off = np.abs(hits.s[:, pixel].T - truth.s).max(axis=1)
        right_t[pixel] = (t_off <= truth.t_allowed) | ~np.isfinite(truth.t_allowed)
        right_s[pixel] = (s_off <= truth.s_allowed) | ~np.isfinite(truth.s_allowed)
    return beside, right_t, right_s
