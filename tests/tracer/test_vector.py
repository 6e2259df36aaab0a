"""Vectors: what is fast in numpy 2 and what is fast in numpy 1 give the same."""

from __future__ import annotations

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
