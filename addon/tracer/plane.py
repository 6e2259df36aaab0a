"""Finds where rays meet an infinite plane, by the textbook.

The plane is (x - p) . n = 0. With x = o + t d: t = -((o - p) . n) / (d . n). If d . n = 0 the ray
is parallel to the plane and does not hit it. t may be negative: `nearest.py` tests the clip range.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from .camera import Rays
from .vector import Vectors, dot


def intersect(rays: Rays, point: Vectors, normal: Vectors) -> Floats:
    """Return the t at which each ray meets the plane.

    Parameters
    ----------
    rays : Rays
        n rays in world space.
    point, normal : (3, 1), or (3, n) for a plane each
        World space; the normal need not be of unit length.

    Returns
    -------
    t : (n,)
        Ray parameter, of the rays' dtype; NaN where the ray is parallel to the plane.

    References
    ----------
    .. [1] The exercise, in docs/glossary.md: the plane.
    """
    towards = dot(rays.directions, normal)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        t = -dot(rays.origins - point, normal) / towards
    return np.where(towards == 0, np.nan, t)
