"""Says in words why an error bound did not decide a pair of a ray and a surface."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Floats
from ..certainty import Reason
from ..tracer.camera import Rays
from ..tracer.vector import Vectors, cross, largest
from .bounds import BOUND, SLACK
from .exact import Hit, sign_of_difference
from .surfaces import CLIP, EDGE, SURE, Candidates, Surfaces

# A ratio below this is ordinary: it costs three of float64's sixteen digits.
_ORDINARY = 1e3


def of_doubts(rays: Rays, corners: Vectors) -> list[Reason]:
    """Return why the bound did not decide n pairs: what is unusual about the ray and the triangle.

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
    found = np.array([Reason.FAR, Reason.THIN, Reason.EDGE_ON])[ratios.argmax(axis=0)]
    found[ratios.max(axis=0) <= _ORDINARY] = Reason.NEAR_EDGE
    found[extreme] = Reason.EXTREME
    return found.tolist()


def _length(v: Vectors) -> Floats:
    """Return the largest |component| of vectors (3, n)."""
    return np.abs(v).max(axis=0)


def reasons(
    found: Candidates,
    met: Sequence[Hit | None],
    firsts: Sequence[Hit | None],
    rays: Rays,
    surfaces: Surfaces,
) -> list[Reason]:
    """Return why candidates were not decided by the error bound, one reason for each that was not.

    Parameters
    ----------
    found : Candidates
        c candidates.
    met, firsts : (c,) sequences
        The hit on each candidate, and the hit that its ray sees, in exact arithmetic.
    """
    out, unusual = [], []
    planes = len(surfaces.planes)
    for k, (hit, first) in enumerate(zip(met, firsts, strict=True)):
        doubt = found.doubt[k]
        if doubt == SURE:  # a hit, but the bounds do not tell whether it is the nearest
            if hit is not first:
                same = hit and first and sign_of_difference(hit, first) == 0
                out.append(Reason.COPLANAR if same else Reason.CLOSE)
        elif doubt == EDGE and hit and hit.on_edge:
            out.append(Reason.EDGE)
        elif found.surface[k] < planes:
            out.append(Reason.CLIP if doubt == CLIP else Reason.EDGE_ON)
        else:
            unusual.append(k)
    which = np.array(unusual, np.intp)
    corners = surfaces.triangles.corners.take(found.surface[which] - planes, axis=2)
    properties = of_doubts(rays.take(found.ray[which]), corners)
    for doubt, reason in zip(found.doubt[which], properties, strict=True):
        out.append(Reason.CLIP if doubt == CLIP and reason != Reason.EXTREME else reason)
    return out
