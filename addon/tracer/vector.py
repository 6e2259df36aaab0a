"""Vectors as component-first arrays, (3, n), so that formulas read as in the textbook.

And records of arrays.

Every operation is an explicit elementwise one. A matrix product or einsum may round the same
vertex differently in arrays of different length, which would tear shared vertices apart.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import reduce
from typing import Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array, Floats, Index

Vectors = NDArray[np.floating]  # (3, n), or (3, 1) where one vector serves all

D = TypeVar("D", bound=np.generic)

# In numpy 1 `take` is half as fast as indexing row by row.
_TAKE_IS_FAST = np.lib.NumpyVersion(np.__version__) >= "2.0.0"


def gather(values: NDArray[D], index: Index) -> NDArray[D]:
    """Return the columns of (..., m) at an index (n,), (..., n), in the fastest way."""
    if _TAKE_IS_FAST:
        return values.take(index, axis=-1)
    if values.ndim == 1:
        return values[index]
    out = np.empty((*values.shape[:-1], len(index)), values.dtype)
    if not out.size:  # reshape cannot tell how many rows an empty array has
        return out
    rows = values.reshape(-1, values.shape[-1])
    for row, target in zip(rows, out.reshape(-1, len(index)), strict=True):
        target[:] = row[index]
    return out


@dataclass(frozen=True, eq=False)
class Arrays:
    """A record of arrays; the last axis of each counts the same things."""

    def arrays(self) -> list[Array]:
        """Return the arrays in the order of the record's fields."""
        return [getattr(self, name) for name in self.__dataclass_fields__]  # `fields` is slow

    def __len__(self) -> int:
        first: Array = getattr(self, next(iter(self.__dataclass_fields__)))
        return first.shape[-1]

    def take(self, index: Index | slice) -> Self:
        """Return those at `index`."""
        if isinstance(index, slice):
            return type(self)(*(values[..., index] for values in self.arrays()))
        return type(self)(*(gather(values, index) for values in self.arrays()))

    @classmethod
    def joined(cls, parts: Iterable[Self]) -> Self:
        """Return several records, at least one, as one."""
        columns = zip(*(part.arrays() for part in parts), strict=True)
        return cls(*(np.concatenate(column, axis=-1) for column in columns))

    @classmethod
    def together(cls, parts: Iterable[Self], size: int) -> Iterator[Self]:
        """Yield records, small ones joined until they have at least `size`; the last may be less.

        Nothing is yielded where there are none.
        """
        some: list[Self] = []
        count = 0
        for part in parts:
            some.append(part)
            count += len(part)
            if count >= size:
                yield cls.joined(some)
                some = []
                count = 0
        if some:
            yield cls.joined(some)


def grouped(number: Index, count: int) -> list[NDArray[np.intp]]:
    """Return for each number below `count` where it occurs."""
    ends = np.cumsum(np.bincount(number, minlength=count))[:-1]
    return np.split(np.argsort(number, kind="stable"), ends)


def occurring(number: Index, count: int) -> tuple[NDArray[np.intp], NDArray[np.int32]]:
    """Return which numbers below `count` occur, ascending, and the place of each among these."""
    occurs = np.zeros(count, bool)
    occurs[number] = True
    which = np.flatnonzero(occurs)
    place = np.empty(count, np.int32)
    place[which] = np.arange(len(which), dtype=np.int32)
    return which, place.take(number)


def largest(*values: NDArray[D]) -> NDArray[D]:
    """Return the elementwise maximum of several arrays."""
    return reduce(np.maximum, values)


def spread(items: Index, counts: Index) -> tuple[Index, NDArray[np.intp]]:
    """Repeat each item `count` times; the second array numbers its copies from 0."""
    repeated = np.repeat(items, counts)
    ends = np.cumsum(counts)
    return repeated, np.arange(len(repeated)) - np.repeat(ends - counts, counts)


def dot(a: Vectors, b: Vectors) -> Floats:
    """Return a . b, (n,), summed in the order x, y, z."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vectors, b: Vectors, out: Vectors | None = None) -> Vectors:
    """Return a x b, (3, n), in `out` where that is given."""
    if out is None:
        out = np.empty((3, *np.broadcast(a[0], b[0]).shape), np.result_type(a, b))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(a[i] * b[j], a[j] * b[i], out=out[k, ...])
    return out


def transform_points(target_from_source: Array, points: Array) -> Array:
    """Return points in target space, (3, n).

    Parameters
    ----------
    target_from_source : (4, 4) or (4, 4, n) float64
    points : (3, n) of any float, in source space

    Returns
    -------
    (3, n) float64; of dtype object, exact, where both are fractions.
    """
    matrix = target_from_source
    dtype = np.result_type(matrix, np.float64)
    x, y, z = np.asarray(points, dtype)
    out = np.empty((3, *np.broadcast(matrix[0, 0], x).shape), dtype)
    for i, to in enumerate((out[0, ...], out[1, ...], out[2, ...])):
        np.multiply(matrix[i, 0], x, out=to)
        to += matrix[i, 1] * y
        to += matrix[i, 2] * z
        to += matrix[i, 3]
    return out
