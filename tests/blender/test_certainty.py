"""Certainty in Blender: the pass in a file, and what is said where nothing can be certified."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.blender.engine import ENGINE
from reference_tracer.certainty import Certainty

SIZE = 40


@pytest.fixture
def square(build):
    """An orthographic view along a square's diagonal: the middle of the pixels there is on it."""
    scene = build.scene(SIZE, SIZE)
    scene.render.engine = ENGINE
    scene.view_layers[0].reference_tracer.passes = {"Certainty"}
    build.square(size=2.0)
    build.camera(type="ORTHO", ortho_scale=2.5)
    return scene


def test_the_pass_says_how_each_pixel_was_decided(square, rendered):
    found = rendered()["ViewLayer"]["Certainty"][..., 0]
    diagonal = np.eye(SIZE, dtype=bool)
    if (found[diagonal] == Certainty.BOUND).all():
        diagonal = diagonal[::-1]  # the square's other one
    inside = np.abs(np.arange(SIZE) - (SIZE - 1) / 2) < SIZE * 2.0 / 2.5 / 2
    met = diagonal & inside & inside[:, None]
    assert set(found[met]) == {Certainty.AMBIGUOUS}
    assert set(found[~met]) <= {Certainty.BOUND, Certainty.EXACT}


def test_a_plain_method_certifies_nothing(square, rendered):
    square.reference_tracer.method = "textbook"
    assert not rendered()["ViewLayer"]["Certainty"].any()


def test_certified_fails_where_nothing_can_be(square, broken_arithmetic, rendered):
    square.reference_tracer.method = "certified"
    with pytest.raises(RuntimeError, match="nothing can be certified in this process"):
        rendered()


def test_automatic_falls_back_and_says_so(square, broken_arithmetic, rendered, capfd):
    assert not rendered()["ViewLayer"]["Certainty"].any()
    said = capfd.readouterr()
    assert "Traced by watertight in float64, as nothing can be certified" in said.out + said.err
