"""Why the error bound did not decide, in words that a user understands."""

from __future__ import annotations

from enum import Enum

import numpy as np
from numpy.typing import NDArray

from ..tracer.camera import Rays
from ..tracer.vector import cross, largest
from .bounds import BOUND, SLACK


class Reason(Enum):
    """What about a ray and a surface needed exact arithmetic."""

    EDGE = "meet an edge or a corner exactly"
    NEAR_EDGE = "pass an edge within rounding error"
    FAR = "meet triangles that are tiny for their distance from the camera"
    THIN = "meet slivers: triangles that are tiny in height for their length"
    EDGE_ON = "meet surfaces that are seen edge-on"
    COPLANAR = "meet surfaces that lie exactly in one plane"
    CLOSE = "meet surfaces closer behind one another than float64 can tell"
    CLIP = "meet a surface within rounding error of the clip range's ends"
    EXTREME = "have numbers near the limits of float64"


# Below this ratio a property is nothing unusual: it costs three of float64's sixteen digits.
_ORDINARY = 1e3


def of_doubts(rays: Rays, corners: NDArray[np.float64]) -> list[Reason]:
    """Return for n rays, each in doubt of a triangle's edge (3, 3, n), what is unusual about it."""
    a, b, c = corners
    with np.errstate(all="ignore"):
        sides = [_length(side) for side in (b - a, c - b, a - c)]
        longest = largest(*sides)
        normal = cross((b - a) / longest, (c - a) / longest)  # by units, lest it underflow
        height = _length(normal)
        speed, distance = _length(rays.directions), _length(a - rays.origins)
        d = rays.directions / speed
        cosine = np.abs(d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2]) / height
        ratios = np.stack((distance / longest, 1 / height, 1 / cosine))
        ratios = np.nan_to_num(ratios, nan=np.inf)
        # Of e, T and D: beyond these, it is not the digits that are too few, but the exponent.
        sizes = longest * np.stack((speed * distance, distance * longest, speed * longest))
        extreme = ~((sizes > SLACK / BOUND) & (sizes < np.inf)).all(axis=0)
    found = np.array([Reason.FAR, Reason.THIN, Reason.EDGE_ON])[ratios.argmax(axis=0)]
    found[ratios.max(axis=0) <= _ORDINARY] = Reason.NEAR_EDGE
    found[extreme] = Reason.EXTREME
    return found.tolist()


def sentences(pairs: int, counts: dict[Reason, int]) -> list[str]:
    """Return what the scene required, a fact a line: the whole, then each reason with its count."""
    exact = sum(counts.values())
    if not exact:
        return [f"all of {pairs:,} pairs of a ray and a surface were decided by the error bound"]
    named = sorted((r for r in Reason if counts.get(r)), key=lambda r: -counts[r])
    return [
        f"{exact:,} of {pairs:,} pairs of a ray and a surface (one in {pairs / exact:,.0f}) "
        "needed exact arithmetic: rays that",
        *(f"  {reason.value}: {counts[reason]:,}" for reason in named),
    ]


def _length(v: NDArray) -> NDArray:
    return np.abs(v).max(axis=0)
