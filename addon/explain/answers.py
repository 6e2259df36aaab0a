"""What the tracer itself says of a pixel: every plain method in both precisions, and the proof.

In comes a `Pixel`; out go `Answer`s. These are the tracer's own functions, not the steps that the
derivation shows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..methods import Method
from ..tracer import plane
from ..tracer.camera import corner_rays
from ..tracer.candidates import Pairs
from ..tracer.certified.certainty import Certainty, broken_assumptions
from ..tracer.certified.contest import Contest
from ..tracer.hits import NOWHERE, Hits, Name, Statistics
from ..tracer.nearest import within_clip
from ..tracer.progress import result_of
from ..tracer.settings import Precision
from ..tracer.world import WorldTriangles
from .pixel import Pixel

PLAIN = tuple((m, p) for m in Method if m.is_plain for p in Precision)

SENTENCES = {
    Certainty.NOT_CERTIFIED: "by floating point alone: this machine's arithmetic allows no proof",
    Certainty.BOUND: "proven by the error bound of float64: no rounding could change it",
    Certainty.EXACT: "proven by whole numbers: float64's error bound left some doubt",
    Certainty.AMBIGUOUS: "decided by the rule, as exact arithmetic leaves several answers: the ray "
    "meets an edge, a corner, or two surfaces at once, and is taken to pass infinitesimally beside "
    "itself",
}


@dataclass(frozen=True, eq=False)
class Answer:
    """What one method in one precision sees; `seen` is NOWHERE, and `t` inf, for nothing."""

    method: Method
    precision: Precision
    seen: Name
    t: float
    s: NDArray[np.float64]  # (3,) barycentrics of the corners; zeros of a plane and of nothing
    certainty: Certainty = Certainty.NOT_CERTIFIED
    ties: frozenset[Name] = frozenset()  # all that an ambiguous ray may be said to see


def plain_answers(pixel: Pixel) -> list[Answer]:
    """Return the answers of the plain methods, in the tracer's order.

    They are the pictures' own, except where float32 rounds a triangle so far that its box on the
    film, which float64 keeps away from the pixel, holds it: that triangle is no candidate.
    """
    triangles = pixel.world_triangles()
    return [plain_answer(pixel, triangles, *plain) for plain in PLAIN]


def plain_answer(
    pixel: Pixel, triangles: WorldTriangles, method: Method, precision: Precision
) -> Answer:
    """Return what a plain method sees of these triangles and the pixel's planes."""
    rays = pixel.rays(precision.dtype)
    with np.errstate(over="ignore"):  # what float32 cannot hold is inf, and is not hit
        corners = triangles.corners.astype(precision.dtype)
        planes = [(c.name, *c.points.astype(precision.dtype)) for c in pixel.planes]
    met = [(np.inf, NOWHERE, np.zeros(3))]
    if len(triangles.instance):
        hit, t, s = method.function(rays, *corners)
        for k in np.flatnonzero(hit & within_clip(pixel.camera, t)):
            name = int(triangles.instance[k]), int(triangles.triangle[k])
            met.append((float(t[k]), name, s[:, k].astype(float)))
    for name, point, normal in planes:
        t = plane.intersect(rays, point[:, None], normal[:, None])
        if within_clip(pixel.camera, t)[0]:
            met.append((float(t[0]), name, np.zeros(3)))
    t, seen, s = min(met, key=lambda m: m[:2])
    return Answer(method, precision, seen, t, s)


def contest_hits(pixel: Pixel, triangles: WorldTriangles) -> Hits:
    """Return the certified `Hits` of the pixel's one ray among these triangles and its planes."""
    planes = [(c.points[0], c.points[1]) for c in pixel.planes]
    camera = pixel.camera
    around = corner_rays(camera)  # the bounds are those for all of the picture's rays
    clip = camera.clip_start, camera.clip_end
    contest = Contest(pixel.rays(), planes, pixel.first_plane, *clip, around)
    every = np.arange(len(triangles.instance))
    if len(every):
        contest.enter(Pairs(np.zeros_like(every), every, triangles))
    return result_of(contest.hits(Statistics()))


def certified_answer(pixel: Pixel) -> Answer:
    """Return the answer that is proven; NOT_CERTIFIED where this process can prove nothing."""
    hits = contest_hits(pixel, pixel.world_triangles())
    proven = not broken_assumptions()
    return Answer(
        Method.CERTIFIED,
        Precision.FLOAT64,
        (int(hits.instance[0]), int(hits.triangle[0])),
        float(hits.t[0]),
        hits.s[:, 0],
        Certainty(int(hits.certainty[0])) if proven else Certainty.NOT_CERTIFIED,
        hits.ties.get(0, frozenset()),
    )
