"""Runs of equal items: what is computed once for each is what is computed of every item."""

import numpy as np
import pytest
from reference_tracer.arrays import by_runs, places, run_starts


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int32, np.uint8, bool])
@pytest.mark.parametrize("shape", [(1, 4), (2, 3), (400, 4), (400, 3), (400,)])
@pytest.mark.parametrize("distinct", [1, 2, 200])
def test_runs_give_what_all_items_do(rng, dtype, shape, distinct):
    table = rng.integers(0, distinct, (distinct, *shape[1:])).astype(dtype)
    values = np.repeat(table[rng.integers(0, distinct, shape[0])], 3, axis=0)
    number = np.repeat(np.arange(shape[0]) // 2, 3)
    asked = []

    def twice(some, numbers):
        asked.append(len(some))
        return np.stack((some.reshape(len(some), -1).sum(axis=1), numbers), axis=1)

    assert np.array_equal(by_runs(twice, values, number), twice(values, number))
    rows = np.column_stack((values.reshape(len(values), -1), number))
    expected = np.append(0, np.flatnonzero((rows[1:] != rows[:-1]).any(axis=1)) + 1)
    assert np.array_equal(run_starts(values, number), expected)
    assert asked[0] == (len(expected) if 2 * len(expected) <= len(values) else len(values))


def test_bits_tell_items_apart():
    """NaN is one with itself, -0 is another than 0; a part of a larger array may be asked."""
    values = np.array([np.nan, np.nan, 0.0, -0.0, -0.0])
    assert run_starts(values).tolist() == [0, 2, 3]
    assert len(run_starts(values[:0])) == len(by_runs(np.abs, values[:0])) == 0
    wide = np.arange(24.0).reshape(4, 6)
    wide[1] = wide[0]
    assert run_starts(wide[:, 1::2]).tolist() == [0, 2, 3]


@pytest.mark.parametrize("shape", [(0, 3), (7,), (5, 9), (9, 5)])
def test_places_of_a_mask_are_those_of_numpy(rng, shape):
    for mask in (rng.random(shape) < 0.3, (rng.random(shape[::-1]) < 0.3).T):
        for own, known in zip(places(mask), np.nonzero(mask), strict=True):
            assert np.array_equal(own, known)
