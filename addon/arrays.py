"""Short names for the types of arrays, runs of equal items, and parts to work on at a time.

The types of vectors are in `tracer/vector.py`. A picture in constant colours has some thousand
runs, and millions of pixels: what follows from a pixel alone is computed once a run.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]  # of any one type; of dtype object where they are fractions
Bools = NDArray[np.bool_]
Bytes = NDArray[np.uint8]
Colors = NDArray[np.float32]  # (..., 4) linear RGBA, premultiplied alpha
Floats = NDArray[np.floating]  # float64, but where an unproven method is asked for float32
Index = NDArray[np.integer]
Integers = NDArray[np.int32]
Where = Array | slice | tuple[Array, ...]  # some of the items of an array
Places = NDArray[np.intp]  # what numpy's searches return


def run_starts(*values: Array) -> Places:
    """Return where the runs of n items begin, (k,).

    Each of `values` is (n, ...). In a run, all of them have the same bits.
    """
    count = len(values[0])
    new = np.zeros(count, bool)
    new[:1] = True
    for value in values if count > 1 else ():
        rows = np.ascontiguousarray(value).reshape(count, -1)
        size = next(s for s in (8, 4, 2, 1) if rows[0].nbytes % s == 0)
        for column in rows.view(f"u{size}").T:
            new[1:] |= column[1:] != column[:-1]
    return np.flatnonzero(new)


def places(mask: Bools) -> tuple[Places, ...]:
    """Return what `numpy.nonzero` does: where a mask is True, an array for each of its axes.

    numpy goes through a mask of two dimensions several times as slowly as through a flat one.
    """
    return np.unravel_index(np.flatnonzero(mask), mask.shape)


def by_runs(of: Callable[..., Array], *values: Array) -> Array:
    """Return what a function makes of n items, (n, ...); it has to treat each item by itself.

    `values` are its arguments, (n, ...) each. The function is asked about the first of each run.
    """
    first, count = run_starts(*values), len(values[0])
    if 2 * len(first) > count:
        return of(*values)
    return np.repeat(of(*(v[first] for v in values)), np.diff(first, append=count), axis=0)


def parts(count: int, size: int) -> list[slice]:
    """Split `count` items into parts of at most `size`."""
    return [slice(first, min(first + size, count)) for first in range(0, count, size)]


def groups(counts: Index, limit: int) -> Iterator[tuple[int, int]]:
    """Yield the ends of groups of items with a sum of `counts` of at most `limit`.

    An item with a larger count is a group by itself.
    """
    ends = np.cumsum(counts)
    start = 0
    while start < len(ends):
        done = ends[start - 1] if start else 0
        end = max(start + 1, int(np.searchsorted(ends, done + limit, side="right")))
        yield start, end
        start = end
