"""Maps over a dimmed picture: which pixels are marked, and how they are found."""

from __future__ import annotations

import numpy as np
from reference_tracer.causes.explain import AGREE, EDGE
from reference_tracer.causes.maps import (
    DIM,
    MOST_RINGS,
    RING,
    WRONG,
    cause_map,
    certainty_map,
    dimmed,
    ringed,
    wrong_map,
)
from reference_tracer.certainty import Certainty
from reference_tracer.images import to_display

RED = (*WRONG, 1)


def test_what_is_not_marked_is_its_dimmed_light(rng):
    color = rng.random((3, 5, 4)).astype(np.float32)
    light = color[..., 0] * 0.2126 + color[..., 1] * 0.7152 + color[..., 2] * 0.0722
    assert np.allclose(dimmed(color), np.stack((*[DIM * light] * 3, np.ones((3, 5))), -1))
    agree = np.zeros((3, 5), np.uint8)
    assert np.array_equal(cause_map(color, agree), dimmed(color))
    assert np.array_equal(wrong_map(color, agree.astype(bool)), dimmed(color))
    color[1, 2] = np.nan
    assert np.array_equal(dimmed(color)[1, 2], (0, 0, 0, 1))


def test_marks_are_where_they_should_be_and_nowhere_else(rng):
    color = rng.random((6, 7, 4)).astype(np.float32)
    wrong = rng.random((6, 7)) < 0.3
    found = wrong_map(color, wrong)
    assert wrong.any() and np.array_equal((found == RED).all(axis=-1), wrong)
    cause = np.where(wrong, EDGE, AGREE).astype(np.uint8)
    found = cause_map(color, cause)
    assert np.array_equal((found == np.float32((*EDGE.color, 1))).all(axis=-1), wrong)


def test_what_few_pixels_have_is_shown_in_the_colour_of_the_record():
    """On black: what whole surfaces have lets them through."""
    certainty = np.array([list(Certainty)], np.uint8)
    shown = to_display(certainty_map(np.zeros((1, 4, 4), np.float32), certainty))[0, :, :3]
    own = [list(bytes.fromhex(c.color[1:])) for c in Certainty]
    assert shown[2:].tolist() == own[2:]
    assert (shown[:2] < own[:2]).all()


def test_a_ring_is_around_each_of_few_pixels():
    color, where = np.zeros((40, 50, 4), np.float32), np.zeros((40, 50), bool)
    where[20, 30] = True
    color[20, 30] = RED
    found = (ringed(color, where) == RED).all(axis=-1)
    assert found.sum() == (2 * RING + 1) ** 2 - (2 * RING - 3) ** 2 + 1
    assert found[20, 30] and found[20 + RING, 30] and not found[20 + RING - 2, 30]
    assert (color == RED).all(axis=-1).sum() == 1  # the picture itself stays as it is


def test_rings_end_at_the_rim_and_never_hide_what_they_are_around():
    color = np.zeros((12, 12, 4), np.float32)
    where = np.zeros((12, 12), bool)
    where[0, 0] = where[RING, 0] = where[11, 11] = True
    color[where] = [(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1)]
    assert np.array_equal(ringed(color, where)[where], color[where])


def test_many_pixels_need_no_rings():
    color, where = np.zeros((40, 50, 4), np.float32), np.zeros((40, 50), bool)
    assert ringed(color, where) is color
    where.flat[: MOST_RINGS + 1] = True
    assert ringed(color, where) is color
