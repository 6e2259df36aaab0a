"""The truth about pairs of a ray and a triangle, and how far a sound float64 answer may be off.

Whether a ray meets its triangle is decided by the certified tracer. How far a student's numbers may
be off is a bound, so that nobody is blamed for rounding: each of three right programs, the
textbook's, Möller and Trumbore's and that of signed volumes, is computed with a bound on its own
rounding (`bounded.py`), and an answer may be off by ROUNDINGS times the largest of these. Where
n . n leaves float64's range there is no bound at all. What is nearer to an edge than that is *in
doubt*: float64 may say either.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Bools, Floats
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.bounds import FromPoint, U
from reference_tracer.tracer.camera import Rays

from .form import Arrays
from .subjects.triangle import SIGNED_VOLUMES, TRIANGLE, WEIGHTS
from .truth import ROUNDINGS, bounded

LEAST = 2.0**-960  # of n . n: below it, products have lost digits at float64's lower end

SOUND = *TRIANGLE.programs, SIGNED_VOLUMES

# A student's function: origins, directions, triangles -> t, barycentrics.
Ask = Callable[..., Arrays]


@dataclass(frozen=True, eq=False)
class Known:
    """The truth of n pairs.

    `t` (n,) and `s` (n, 3) are those of the triangle's plane, also where the ray passes beside the
    triangle; NaN where it is parallel to it.
    """

    hit: Bools  # (n,) the certified ray meets the triangle, in the clip range
    doubt: Bools  # (n,) sound float64 may say otherwise
    t: Floats
    t_allowed: Floats  # (n,) how far an answer may be off; NaN or inf: as far as it likes
    s: Floats
    s_allowed: Floats


def known(
    origins: Floats,
    directions: Floats,
    triangles: Floats,
    start: float = 0.0,
    end: float = np.inf,
) -> Known:
    """Return the truth of n pairs, seen with start <= t <= end, and t > 0.

    Parameters
    ----------
    origins, directions : (n, 3) float64
    triangles : (n, 3, 3) float64
        Pair, corner, component.
    start, end : float
    """
    rays = Rays(origins.T, directions.T)
    corners = triangles.transpose(1, 2, 0)
    hit = decide(rays, corners, start, end).crossed
    letters = TRIANGLE.letters(origins, directions, triangles)
    with np.errstate(all="ignore"):  # what over- or underflows is in doubt
        t, s = plane_hits(rays, corners)
        every = [bounded(program, letters) for program in SOUND]
        square = every[0]["‖n‖²"].value
        is_bounded = (square >= LEAST) & np.isfinite(square)
        t_allowed, s_allowed = (
            np.where(is_bounded, ROUNDINGS * U * _largest(every, labels), np.inf)
            for labels in (("t",), WEIGHTS)
        )
        near_edge = (np.abs(s) <= s_allowed).any(axis=0) & (s >= -s_allowed).all(axis=0)
        near_end = (np.abs(t - start) <= t_allowed) | (np.abs(t - end) <= t_allowed)
        doubt = near_edge | near_end | ~np.isfinite(s_allowed)
    return Known(hit, doubt, t, t_allowed, s.T, s_allowed)


def plane_hits(rays: Rays, corners: Floats) -> tuple[Floats, Floats]:
    """Return t (n,) and barycentrics (3, n) where rays meet their triangles' planes."""
    count = corners.shape[2]
    prepared = FromPoint(rays.origins, np.abs(rays.directions), corners)
    edges, _ = prepared.edges(np.arange(count), rays)
    fractions = prepared.fractions(np.arange(count), rays)
    towards = np.where(fractions.denominator == 0, np.nan, fractions.denominator)
    return fractions.numerator / towards, edges[[1, 2, 0]] / towards


def _largest(every: list, labels: tuple[str, ...]) -> Floats:
    """Return the largest bound of some numbers that any program has, in roundings, (n,)."""
    bounds = [names[label].error for names in every for label in labels]
    return np.max(np.broadcast_arrays(*bounds), axis=0)
