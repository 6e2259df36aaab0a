"""When two pixels differ."""

from __future__ import annotations

import numpy as np
from reference_tracer.compare.cause import TOLERANCE, Cause, differing
from reference_tracer.tracer.render import render

WHITE = (1.0, 1.0, 1.0, 1.0)


def test_half_float_colours_agree(room, explained):
    cut = render(room).color.astype(np.float16).astype(np.float32) - 2.0**-11
    assert (explained(room, cut).cause == Cause.AGREE).all()
    assert (explained(room, cut - 2 * TOLERANCE).cause != Cause.AGREE).all()


def test_differing_is_symmetric_and_strict(rng):
    first = rng.random((5, 6, 4)).astype(np.float32)
    second = first + rng.choice([0, 0.9 * TOLERANCE, 1.1 * TOLERANCE], first.shape)
    expected = (np.abs(first - second) > TOLERANCE).any(axis=-1)
    assert 0 < expected.sum() < 30
    assert np.array_equal(differing(first, second), expected)
    assert np.array_equal(differing(second, first), expected)
