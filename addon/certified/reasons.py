"""Says in words why an error bound did not decide a pair of a ray and a surface."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from ..arrays import Floats, Index
from ..certainty import Reason
from ..tracer.camera import Rays
from ..tracer.vector import Vectors, cross, largest
from .bounds import BOUND, SLACK
from .exact import Hit, sign_of_difference
from .surfaces import CLIP, EDGE, SURE, Candidates, Surfaces

# A ratio below this is ordinary: it costs three of float64's sixteen digits.
_ORDINARY = 1e3


_NUMBER = {reason: number for number, reason in enumerate(Reason)}


def of_doubts(rays: Rays, corners: Vectors) -> Index:
    """Return why the bound did not decide n pairs: what is unusual about the ray and the triangle.

    As numbers into `Reason`, (n,).

    Parameters
    ----------
    rays : Rays
        n rays.
    corners : (3, 3, n) float64
        Corner, component, triangle: that of each ray.
    """
    a, b, c = corners
    with np.errstate(all="ignore"):
        sides = [_length(side) for side in (b - a, c - b, a - c)]
        longest = largest(*sides)
        normal = cross((b - a) / longest, (c - a) / longest)  # does not underflow
        height = _length(normal)
        speed = _length(rays.directions)
        distance = _length(a - rays.origins)
        d = rays.directions / speed
        cosine = np.abs(d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2]) / height
        ratios = np.stack((distance / longest, 1 / height, 1 / cosine))
        ratios = np.nan_to_num(ratios, nan=np.inf)
        # The sizes of e, T and D: beyond these ends not digits are too few, but exponents.
        sizes = longest * np.stack((speed * distance, distance * longest, speed * longest))
        extreme = ~((sizes > SLACK / BOUND) & (sizes < np.inf)).all(axis=0)
    of_ratios = [_NUMBER[each] for each in (Reason.FAR, Reason.THIN, Reason.EDGE_ON)]
    found = np.array(of_ratios)[ratios.argmax(axis=0)]
    found[ratios.max(axis=0) <= _ORDINARY] = _NUMBER[Reason.NEAR_EDGE]
    found[extreme] = _NUMBER[Reason.EXTREME]
    return found


def _length(v: Vectors) -> Floats:
    """Return the largest |component| of vectors (3, n)."""
    return np.abs(v).max(axis=0)


def reasons(
    found: Candidates,
    met: Sequence[Hit | None],
    firsts: Sequence[Hit | None],
    rays: Rays,
    surfaces: Surfaces,
) -> Counter[Reason]:
    """Count why candidates were not decided by the error bound, one reason for each that was not.

    Parameters
    ----------
    found : Candidates
        c candidates.
    met, firsts : (c,) sequences
        The hit on each candidate, and the hit that its ray sees, in exact arithmetic.
    """
    count = Counter[Reason]()
    sure = found.doubt == SURE
    for k in np.flatnonzero(sure).tolist():  # a hit, but is it the nearest?
        hit, first = met[k], firsts[k]
        if hit is not first:
            same = hit and first and sign_of_difference(hit, first) == 0
            count[Reason.COPLANAR if same else Reason.CLOSE] += 1
    on_edge = np.array([hit is not None and hit.on_edge for hit in met], bool)
    on_edge &= found.doubt == EDGE
    rest = found.take(np.flatnonzero(~sure & ~on_edge))
    planes = len(surfaces.planes)
    number = np.full(len(rest), _NUMBER[Reason.EDGE_ON])
    some = np.flatnonzero(rest.surface >= planes)
    corners = surfaces.triangles.corners.take(rest.surface[some] - planes, axis=2)
    number[some] = of_doubts(rays.take(rest.ray[some]), corners)
    number[(rest.doubt == CLIP) & (number != _NUMBER[Reason.EXTREME])] = _NUMBER[Reason.CLIP]
    times = np.bincount(number, minlength=len(_NUMBER))
    times[_NUMBER[Reason.EDGE]] += int(on_edge.sum())
    count.update({reason: int(times[k]) for reason, k in _NUMBER.items() if times[k]})
    return count
