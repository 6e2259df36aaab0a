"""Vectors as component-first arrays, (3, n): the formulas read as in the textbook.

And records of arrays whose last axis counts the same things.

Every operation is an explicit elementwise one. A matrix product or einsum may round the same
vertex differently in arrays of different length, which would tear shared vertices apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import reduce
from typing import Self

import numpy as np
from numpy.typing import NDArray

rational = np.vectorize(lambda x: Fraction(float(x)), otypes=[object])  # of floats, exactly
_TAKE_IS_FAST = np.lib.NumpyVersion(np.__version__) >= "2.0.0"

Floats = NDArray[np.float64]
Index = NDArray[np.integer]
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


class Arrays:
    """What all records of arrays have in common that count the same things in their last axis."""

    def __len__(self) -> int:
        return next(iter(vars(self).values())).shape[-1]

    def take(self, index: NDArray[np.integer] | slice) -> Self:
        """Return those at `index`."""
        if isinstance(index, slice):
            return type(self)(*(v[..., index] for v in vars(self).values()))
        return type(self)(*(gather(v, index) for v in vars(self).values()))

    @classmethod
    def joined(cls, parts: Iterable[Self]) -> Self:
        """Return them all as one."""
        fields = zip(*(vars(part).values() for part in parts), strict=True)
        return cls(*(np.concatenate(f, axis=-1) for f in fields))

    @classmethod
    def together(cls, parts: Iterable[Self], size: int) -> Iterator[Self]:
        """Yield them all, small parts joined, at least `size` at a time but at the end."""
        some, count = [], 0
        for part in parts:
            some.append(part)
            count += len(part)
            if count >= size:
                yield cls.joined(some)
                some, count = [], 0
        if some:
            yield cls.joined(some)


def parts(count: int, size: int) -> list[slice]:
    """Split `count` items into parts of at most `size`."""
    return [slice(first, first + size) for first in range(0, count, size)]


def groups(counts: NDArray[np.integer], limit: int) -> Iterator[tuple[int, int]]:
    """Yield where groups of items begin and end, whose counts sum to `limit` at most, or of one."""
    ends = np.cumsum(counts)
    start = 0
    while start < len(ends):
        done = ends[start - 1] if start else 0
        end = max(start + 1, int(np.searchsorted(ends, done + limit, side="right")))
        yield start, end
        start = end


def grouped(number: NDArray[np.integer], count: int) -> list[NDArray[np.intp]]:
    """Return for each number below `count` where it stands."""
    ends = np.cumsum(np.bincount(number, minlength=count))[:-1]
    return np.split(np.argsort(number, kind="stable"), ends)


def occurring(number: Index, count: int) -> tuple[NDArray[np.intp], NDArray[np.int32]]:
    """Return which numbers below `count` occur, ascending, and which of these each is."""
    occurs = np.zeros(count, bool)
    occurs[number] = True
    which, place = np.flatnonzero(occurs), np.empty(count, np.int32)
    place[which] = np.arange(len(which), dtype=np.int32)
    return which, place.take(number)


def largest(*values: NDArray) -> NDArray:
    """Return the largest of several arrays, place by place."""
    return reduce(np.maximum, values)


def spread(items: NDArray, counts: NDArray) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Repeat each item `count` times; the second array numbers its copies from 0."""
    repeated = np.repeat(items, counts)
    ends = np.cumsum(counts)
    return repeated, np.arange(len(repeated)) - np.repeat(ends - counts, counts)


def dot(a: Vectors, b: Vectors) -> NDArray[np.floating]:
    """Return a . b, (n,), summed in the order x, y, z."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vectors, b: Vectors, out: Vectors | None = None) -> Vectors:
    """Return a x b, (3, n), in `out` where that is given."""
    if out is None:
        out = np.empty((3, *np.broadcast(a[0], b[0]).shape), np.result_type(a, b))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(a[i] * b[j], a[j] * b[i], out=out[k, ...])
    return out


def transform_points(target_from_source: NDArray[np.float64], points: Vectors) -> Vectors:
    """Return the points in target space, (3, n) float64; fractions, if both are.

    Parameters
    ----------
    target_from_source : (4, 4) or (4, 4, n) float64
    points : (3, n)
    """
    m, dtype = target_from_source, np.result_type(target_from_source, np.float64)
    x, y, z = np.asarray(points, dtype)
    out = np.empty((3, *np.broadcast(m[0, 0], x).shape), dtype)
    for i, to in enumerate((out[0, ...], out[1, ...], out[2, ...])):
        np.multiply(m[i, 0], x, out=to)
        to += m[i, 1] * y
        to += m[i, 2] * z
        to += m[i, 3]
    return out
