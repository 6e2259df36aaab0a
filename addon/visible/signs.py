"""The signs of determinants of points: which way three of them turn for an eye."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import Floats, Index
from ..certified.integers import cross, dot, integers, sub


class Signs(NamedTuple):
    """The signs of n determinants, exactly; and the values as computed, with their bounds."""

    sign: Index
    value: Floats
    error: Floats


def exact_signs(corners: list[Floats], v: Floats, parallel: bool) -> list[int]:
    """Return the signs of (a - v) . n of corners (3, n) each, or v . n, in integers."""
    lengths, _ = integers(np.hstack((*corners, *(() if parallel else (v,)))))
    count = v.shape[1]
    a, b, c = (lengths[k * count : (k + 1) * count] for k in range(3))
    along = integers(v)[0] if parallel else lengths[3 * count :]
    found = []
    for k in range(count):
        normal = cross(sub(b[k], a[k]), sub(c[k], a[k]))
        exact = dot(along[k] if parallel else sub(a[k], along[k]), normal)
        found.append((exact > 0) - (exact < 0))
    return found
