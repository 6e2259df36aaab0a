"""What the tracer itself says of a pixel: every plain method in both precisions, and the proof.

In comes a `Pixel`; out go `Answer`s, the certified one last. These are the tracer's own functions,
not the steps that the derivation shows.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ..tracer import plane
from ..tracer.certainty import Certainty, broken_assumptions
from ..tracer.hits import NOTHING, Hits, Name
from ..tracer.settings import Method, Precision
from ..tracer.triangle import METHODS
from ..tracer.visibility import within_clip
from .candidates import contest_hits, world_triangles
from .pixel import Pixel

NOWHERE: Name = (NOTHING, NOTHING)  # what a ray sees that meets nothing

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
    """Return the answers of the plain methods, in the tracer's order."""
    methods = [m for m in Method if m.is_plain]
    return [_plain(pixel, m, p) for m, p in product(methods, Precision)]


def _plain(pixel: Pixel, method: Method, precision: Precision) -> Answer:
    rays, triangles = pixel.rays(precision.dtype), world_triangles(pixel)
    with np.errstate(over="ignore"):  # what float32 cannot hold is inf, and is not hit
        corners = triangles.corners.astype(precision.dtype)
    met: list[tuple[float, Name, NDArray]] = []
    if len(triangles.instance):
        hit, t, s = METHODS[method](rays, *corners)
        for k in np.flatnonzero(hit & within_clip(pixel.camera, t)):
            name = int(triangles.instance[k]), int(triangles.triangle[k])
            met.append((float(t[k]), name, s[:, k].astype(float)))
    for c in pixel.candidates:
        if c.is_plane:
            point, normal = (v[:, None].astype(precision.dtype) for v in c.points)
            t = plane.intersect(rays, point, normal)
            if within_clip(pixel.camera, t)[0]:
                met.append((float(t[0]), c.name, np.zeros(3)))
    t, seen, s = min(met, key=lambda m: m[:2], default=(np.inf, NOWHERE, np.zeros(3)))
    return Answer(method, precision, seen, t, s)


def certified_answer(pixel: Pixel) -> Answer:
    """Return the answer that is proven; NOT_CERTIFIED where this process can prove nothing."""
    hits: Hits = contest_hits(pixel, world_triangles(pixel))
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
