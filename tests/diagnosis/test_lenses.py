"""Faults of a camera's lens: shifts, and pixels that are no squares."""

from __future__ import annotations

from dataclasses import replace

import pytest
from reference_tracer.diagnosis.faults.fault import Option
from reference_tracer.rendering import render
from reference_tracer.scene import ViewWindow

from .diagnosing import pictured, told

SHIFTS = "shift_length", "shift_left_out", "shift_sign", "shift_unit"


@pytest.mark.slow
@pytest.mark.parametrize("factor", [1 / 36, 64.0])
def test_a_shift_in_another_length(few, factor):
    scene = few()
    w = scene.camera.window
    small = 0.2 if factor > 1 else 2.0  # so that something is seen with either
    x, y = small * (w.left + w.right) / 2, small * (w.bottom + w.top) / 2
    right = replace(scene.camera, window=_about(w, x, y))
    wrong = replace(scene.camera, window=_about(w, factor * x, factor * y))
    scene = scene.seen_by(right)
    color = render(scene.seen_by(wrong)).color
    assert "shift_length" in told(scene, color, *SHIFTS)


def test_a_shift_of_another_sign_is_in_no_other_length(few):
    color = pictured(few(), "shift_sign", Option(0))
    assert "shift_length" not in told(few(), color, *SHIFTS)


def _about(window, x, y):
    half_x, half_y = (window.right - window.left) / 2, (window.top - window.bottom) / 2
    return ViewWindow(x - half_x, x + half_x, y - half_y, y + half_y)


def test_pixels_taken_for_squares_about_the_windows_own_centre(few):
    scene = few()
    w = scene.camera.window
    tall = replace(w, bottom=0.02 + 1.4 * (w.bottom - 0.02), top=0.02 + 1.4 * (w.top - 0.02))
    tall = scene.seen_by(replace(scene.camera, window=tall))
    color = render(scene).color
    assert list(told(tall, color, "pixel_aspect_left_out", "focal_lengths")) == [
        "pixel_aspect_left_out"
    ]
