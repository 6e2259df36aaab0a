"""Vectors and records of arrays; what is fast in numpy 2 and in numpy 1 gives the same."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pytest
from reference_tracer.tracer import vector


@pytest.mark.parametrize("take_is_fast", [True, False])
@pytest.mark.parametrize("shape", [(7,), (2, 7), (3, 3, 7), (2, 0), (0, 7)])
@pytest.mark.parametrize("count", [0, 1, 20])
def test_gather(monkeypatch, rng, take_is_fast, shape, count):
    monkeypatch.setattr(vector, "_TAKE_IS_FAST", take_is_fast)
    values = rng.random(shape)
    index = rng.integers(0, shape[-1], count) if shape[-1] else np.zeros(0, int)
    np.testing.assert_array_equal(vector.gather(values, index), values[..., index])


@dataclass(frozen=True, eq=False)
class Points(vector.Arrays):
    x: np.ndarray
    y: np.ndarray

    @cached_property
    def product(self):
        return self.x * self.y


def test_what_a_record_of_arrays_has_computed_is_none_of_its_arrays():
    points = Points(np.arange(5.0), np.arange(5.0) + 1)
    assert points.product[2] == 6
    some = points.take(np.array([3, 1]))
    np.testing.assert_array_equal(some.product, [12, 2])
    np.testing.assert_array_equal(points.take(slice(1, 3)).product, [2, 6])
    assert len(Points.joined((points, some))) == 7
    assert list(map(len, Points.together((points, some), 6))) == [7]
