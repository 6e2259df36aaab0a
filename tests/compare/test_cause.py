"""When two pixels differ."""

from __future__ import annotations

import numpy as np
from reference_tracer.compare.cause import LEAST, UNITS, Cause, differing
from reference_tracer.tracer.render import render

WHITE = (1.0, 1.0, 1.0, 1.0)


def test_half_float_colours_agree(room, explained):
    """Cut off to half floats, with three units in the last place missing; not with six."""
    traced = render(room).color
    cut = traced.astype(np.float16)
    for units, agree in ((3, True), (6, False)):
        worn = (cut - units * np.spacing(cut) * (cut > 0)).astype(np.float32)
        cause = explained(room, worn).cause
        assert ((cause == Cause.AGREE) == (agree | ~traced.any(axis=-1))).all()


def test_dark_colours_are_told_apart():
    """What is allowed goes with the value: near black, too, one colour is not another."""
    dark, darker = np.full((1, 1, 4), 0.0019), np.full((1, 1, 4), 0.0002)
    assert differing(dark, darker).all()
    assert not differing(dark * 1e3, dark * 1e3 * (1 - 2.0**-10)).any()
    assert differing(np.full((1, 1, 4), 1e9), np.full((1, 1, 4), 2e9)).all()


def test_differing_is_symmetric_and_strict(rng):
    first = (3 * rng.random((5, 6, 4)) + 0.01).astype(np.float16).astype(np.float64)
    unit = np.spacing(first.astype(np.float16)).astype(np.float64)
    allowed = np.maximum(UNITS * unit, LEAST)
    second = first - allowed * rng.choice([0, 0.9, 1.1], first.shape, p=[0.6, 0.3, 0.1])
    expected = (first - second > allowed).any(axis=-1)
    assert 0 < expected.sum() < 30
    assert np.array_equal(differing(first, second), expected)
    assert np.array_equal(differing(second, first), expected)


def test_half_floats_agree_and_bytes_do_not():
    """Three units of a half float are missing at most; one step of an 8-bit picture is a fault."""
    white = np.ones((1, 1, 4), np.float32)
    assert not differing(white, white - 3 * np.float32(2.0**-11)).any()
    assert differing(white, white - np.float32(1 / 255)).all()
