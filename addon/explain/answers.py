"""What the tracer itself says of a pixel: every plain method in both precisions, and the proof.

In comes a `Pixel`; out go `Answer`s, the certified one last. These are the tracer's own functions,
not the steps that the derivation shows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..tracer.certified.certainty import Certainty, broken_assumptions
from ..tracer.hits import Hits, Name
from ..tracer.settings import Method, Precision
from .candidates import contest_hits, world_triangles
from .methods import PLAIN, nearest
from .pixel import Pixel

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
    triangles = world_triangles(pixel)
    out = []
    for method, precision in PLAIN:
        t, seen, s = nearest(pixel, triangles, method, precision)
        out.append(Answer(method, precision, seen, t, s))
    return out


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
