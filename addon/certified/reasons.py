"""Says in words why an error bound did not decide a pair of a ray and a surface."""

from __future__ import annotations

from enum import Enum

import numpy as np

from ..tracer.camera import Rays
from ..tracer.vector import Floats, Vectors, cross, largest
from .bounds import BOUND, SLACK


class Reason(Enum):
    """Why a ray and a surface needed exact arithmetic: the end of "rays that ..."."""

    EDGE = "meet an edge or a corner exactly"
    NEAR_EDGE = "pass an edge within rounding error"
    FAR = "meet triangles that are tiny for their distance from the camera"
    THIN = "meet slivers: triangles that are tiny in height for their length"
    EDGE_ON = "meet surfaces that are seen edge-on"
    COPLANAR = "meet surfaces that lie exactly in one plane"
    CLOSE = "meet surfaces closer behind one another than float64 can tell"
    CLIP = "meet a surface within rounding error of the clip range's ends"
    EXTREME = "have numbers near the limits of float64"


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


def sentences(pairs: int, counts: dict[Reason, int]) -> list[str]:
    """Return what the scene required, in lines: the total, then each reason with its count."""
    exact = sum(counts.values())
    if not exact:
        return [f"all of {pairs:,} pairs of a ray and a surface were decided by the error bound"]
    named = sorted((r for r in Reason if counts.get(r)), key=lambda r: -counts[r])
    return [
        f"{exact:,} of {pairs:,} pairs of a ray and a surface (one in {pairs / exact:,.0f}) "
        "needed exact arithmetic: rays that",
        *(f"  {reason.value}: {counts[reason]:,}" for reason in named),
    ]


def _length(v: Vectors) -> Floats:
    """Return the largest |component| of vectors (3, n)."""
    return np.abs(v).max(axis=0)
