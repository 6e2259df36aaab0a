"""Vectors as component-first arrays, (3, n): the formulas read as in the textbook.

Every operation is an explicit elementwise one. A matrix product or einsum may round the same
vertex differently in arrays of different length, which would tear shared vertices apart.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

_TAKE_IS_FAST = np.lib.NumpyVersion(np.__version__) >= "2.0.0"

Vectors = NDArray[np.floating]  # (3, n), or (3, 1) where one vector serves all


def gather(values: NDArray, index: NDArray[np.integer]) -> NDArray:
    """Return the columns of (..., m) at an index (n,): (..., n).

    `take` is the fastest way, but in numpy 1 it is half as fast as indexing row by row.
    """
    if _TAKE_IS_FAST:
        return values.take(index, axis=-1)
    if values.ndim == 1:
        return values[index]
    out = np.empty((*values.shape[:-1], len(index)), values.dtype)
    if not out.size:  # of nothing, reshape cannot tell how many rows there are
        return out
    for row, target in zip(
        values.reshape(-1, values.shape[-1]), out.reshape(-1, len(index)), strict=True
    ):
        target[:] = row[index]
    return out


def in_parts(function: Callable[[slice], NDArray], count: int, size: int) -> NDArray:
    """Return what a function makes of slices of `size` columns, side by side: (..., count).

    So that the temporaries of long formulas stay in a core's cache.
    """
    parts = [function(slice(k, k + size)) for k in range(0, max(count, 1), size)]
    return np.concatenate(parts, axis=-1)


def spread(items: NDArray, counts: NDArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Repeat each item `count` times; the second array numbers its copies from 0."""
    repeated = np.repeat(items, counts)
    ends = np.cumsum(counts)
    return repeated, np.arange(len(repeated)) - np.repeat(ends - counts, counts)


def dot(a: Vectors, b: Vectors) -> NDArray[np.floating]:
    """Return a . b, (n,), summed in the order x, y, z."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vectors, b: Vectors) -> Vectors:
    """Return a x b, (3, n)."""
    return np.stack(
        (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    )


def transform_points(target_from_source: NDArray[np.float64], points: Vectors) -> Vectors:
    """Return the points in target space, (3, n) float64.

    Parameters
    ----------
    target_from_source : (4, 4) or (4, 4, n) float64
    points : (3, n)
    """
    m = target_from_source
    x, y, z = np.asarray(points, dtype=np.float64)
    return np.stack([m[i, 0] * x + m[i, 1] * y + m[i, 2] * z + m[i, 3] for i in range(3)])
