"""How far a surface's error reaches, however the picture is divided."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.compare.bounds import SNAPPING
from reference_tracer.compare.checks import band
from reference_tracer.tracer.progress import result_of


@pytest.mark.parametrize("rows", [1, 3, 1000])
@pytest.mark.parametrize("shape", [(1, 1), (9, 13), (40, 7)])
def test_every_error_reaches_as_far_as_it_is_large(rng, monkeypatch, rows, shape):
    monkeypatch.setattr(band, "_ROWS", rows)
    for scale in (0.0, 0.5, 4.0, 60.0):
        own = np.where(rng.random(shape) < 0.3, scale * rng.random(shape) ** 4, 0.0)
        expected = np.full(shape, SNAPPING)
        for y, x in np.argwhere(own > 0):
            reach = int(2 ** np.ceil(np.log2(max(own[y, x], 1))))
            near = expected[max(0, y - reach) : y + reach + 1, max(0, x - reach) : x + reach + 1]
            np.maximum(near, own[y, x], out=near)
        assert np.array_equal(result_of(band.spread(own)), expected)
