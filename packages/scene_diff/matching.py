"""Which triangles of two sets lie in the same place, on the same side, however they are ordered."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from reference_tracer.arrays import Bools, Floats, Integers

# A generic direction: of triangles that lie apart, few are as far along it.
_ALONG = np.array((0.5361, 0.3127, 0.7841))
_ALONG /= np.sqrt((_ALONG * _ALONG).sum())
_SAME = ((0, 1, 2), (1, 2, 0), (2, 0, 1))  # orders of the corners on the same side
_TURNED = ((0, 2, 1), (2, 1, 0), (1, 0, 2))
_MOST = 256  # triangles that are as far along, at most: of more, some count as others


class Matched(NamedTuple):
    """How many triangles of another set lie where each of n does."""

    same: Integers  # (n,) with the same side
    turned: Integers  # (n,) with the other side

    @property
    def there(self) -> Bools:
        """Whether one lies where each does, (n,)."""
        return (self.same > 0) | (self.turned > 0)


def matched(first: Floats, second: Floats, tolerance: float) -> Matched:
    """Match triangles, corner by corner.

    Parameters
    ----------
    first, second : (n, 3, 3) and (m, 3, 3) float64
        Corners, in metres.
    tolerance : float
        How far apart each coordinate of a corner may be, in metres.
    """
    near = first.mean(axis=1) @ _ALONG
    far = second.mean(axis=1) @ _ALONG
    order = np.argsort(far, kind="stable")
    far = far[order]
    reach = 2 * tolerance  # a unit vector's components add up to less than twice it
    start = np.searchsorted(far, near - reach, "left")
    end = np.searchsorted(far, near + reach, "right")
    out = np.zeros((2, len(first)), np.int32)
    some = np.arange(len(first))
    for number in range(_MOST):
        some = some[start[some] + number < end[some]]
        if not len(some):
            break
        other = second[order[start[some] + number]]
        for way, orders in enumerate((_SAME, _TURNED)):
            out[way, some] += _any_alike(first[some], other, orders, tolerance)
    return Matched(*out)


def _any_alike(
    first: Floats, second: Floats, orders: tuple[tuple[int, ...], ...], tolerance: float
) -> Bools:
    alike = np.zeros(len(first), bool)
    for corners in orders:
        alike |= (np.abs(first - second[:, list(corners)]) <= tolerance).all(axis=(1, 2))
    return alike


def points_alike(first: Floats, second: Floats, tolerance: float) -> bool:
    """Return whether two sets of points (n, 3) and (m, 3) are the same, but for repeated ones."""
    as_triangles = [np.repeat(np.unique(p, axis=0)[:, None], 3, axis=1) for p in (first, second)]
    ways = (as_triangles, as_triangles[::-1])
    return all((matched(a, b, tolerance).same > 0).all() for a, b in ways)
