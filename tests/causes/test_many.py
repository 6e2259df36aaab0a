"""Where very many pixels differ, some are asked first, and nothing is excused by it."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.causes import explain as causes
from reference_tracer.causes.explain import EDGE, UNEXPLAINED
from reference_tracer.pictures.storage import differing
from reference_tracer.rendering import render

from ..cases import count, explained, shifted


@pytest.fixture
def few(monkeypatch):
    monkeypatch.setattr(causes, "MANY", 100)
    monkeypatch.setattr(causes, "ASKED_FIRST", 50)


def test_pixels_that_are_not_asked_are_unexplained(room, few):
    frame = render(room)
    color = 1 - frame.color
    found = explained(room, color)
    assert found.not_asked == differing(frame.color, color).sum() - 50
    assert count(found, UNEXPLAINED) == found.not_asked + 50


def test_where_some_have_a_cause_all_are_asked(room, monkeypatch):
    """Samples beside the centres, and a wrong part: the same as if all were asked."""
    color = render(room.seen_by(shifted(room.camera, 0.2, 0.2))).color
    color[:8, :30] = 1
    once = explained(room, color, sample_radius=0.25)
    monkeypatch.setattr(causes, "MANY", count(once, UNEXPLAINED))
    monkeypatch.setattr(causes, "ASKED_FIRST", 60)
    again = explained(room, color, sample_radius=0.25)
    assert count(once, EDGE) > 0 and again.not_asked == 0
    np.testing.assert_array_equal(once.cause, again.cause)


@pytest.mark.parametrize("size", range(1, 400, 7))
def test_few_pixels_are_all_asked(size):
    """Whatever their number: places that are spread by floats would leave some out."""
    open_ = np.ones((1, size), bool)
    assert not len(causes._thin(open_, size)) and open_.all()
    closed = causes._thin(open_, max(1, size // 3))
    assert open_.sum() == max(1, size // 3) and len(closed) == size - open_.sum()
