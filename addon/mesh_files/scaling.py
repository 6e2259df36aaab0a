"""Many faces of equally many corners at once: their corners near 1, and their normals.

Vectors are arrays whose first axis is x, y, z.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..tracer.vector import cross


def local(points: Floats) -> Floats:
    """Return the corners of faces from the first of each, scaled to be at most 1.

    By a power of two, so that each is off by the rounding of one difference.

    Parameters
    ----------
    points : (3, k, n) float64
        The corners of k faces, finite.

    Returns
    -------
    (3, k, n) float64
    """
    with np.errstate(over="ignore"):
        out = points - points[..., :1]
    if not np.isfinite(out).all():
        out = points / 2 - points[..., :1] / 2
    largest = np.abs(out).max(axis=(0, 2))[:, None]
    exponents = np.frexp(np.where(largest > 0, largest, 1))[1]
    half = exponents // 2  # 2^-exponent itself may overflow
    return np.ldexp(np.ldexp(out, -half), half - exponents)


def normals(at: Floats) -> Floats:
    """Return Newell's normals (3, k) of faces (3, k, n) whose first corner is 0."""
    return cross(at[..., 1:-1], at[..., 2:]).sum(axis=-1)
