"""Maps over a dimmed picture: which pixels are marked, and how they are found."""

from __future__ import annotations

import numpy as np
from reference_tracer.causes.explain import AGREE, EDGE
from reference_tracer.causes.maps import (
    DIM,
    HUE,
    LEAST,
    MOST_RINGS,
    RING,
    WRONG,
    cause_map,
    certainty_map,
    difference_map,
    dimmed,
    ringed,
)
from reference_tracer.certainty import Certainty
from reference_tracer.files.images import curve, curve_undone, to_display


def test_what_is_not_marked_is_dimmed_and_paler(rng):
    color = rng.random((3, 5, 4)).astype(np.float32)
    light = color[..., 0] * 0.2126 + color[..., 1] * 0.7152 + color[..., 2] * 0.0722
    found = dimmed(color)
    own = found[..., 0] * 0.2126 + found[..., 1] * 0.7152 + found[..., 2] * 0.0722
    assert np.allclose(own, DIM * light, atol=1e-6)
    assert np.allclose(np.ptp(found[..., :3], -1), HUE * DIM * np.ptp(color[..., :3], -1))
    assert np.array_equal(found[..., 3], color[..., 3])
    agree = np.zeros((3, 5), np.uint8)
    assert np.array_equal(cause_map(color, agree, opaque=False), found)
    opaque = cause_map(color, agree)
    assert np.array_equal(opaque[..., :3], found[..., :3]) and (opaque[..., 3] == 1).all()
    color[1, 2] = np.nan
    assert np.array_equal(dimmed(color)[1, 2], (0, 0, 0, 1))


def test_marks_are_where_they_should_be_and_nowhere_else(rng):
    color = rng.random((6, 7, 4)).astype(np.float32)
    wrong = rng.random((6, 7)) < 0.3
    assert wrong.any()
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


RED = (*WRONG, 1)
LUMINANCE = np.array((0.2126, 0.7152, 0.0722))


def test_a_ring_is_around_each_of_few_pixels_and_seen_on_any_colour():
    orange = np.float32((1.0, 0.352, 0.021, 1.0))  # as Blender outlines the active object
    color, where = np.full((40, 50, 4), orange), np.zeros((40, 50), bool)
    where[20, 30] = True
    color[20, 30] = RED
    shown = ringed(color, where)
    found = (shown == RED).all(axis=-1)
    assert found.sum() == (2 * RING + 1) ** 2 - (2 * RING - 3) ** 2 + 1
    assert found[20, 30] and found[20 + RING, 30] and not found[20 + RING - 2, 30]
    assert (color == RED).all(axis=-1).sum() == 1  # the picture itself stays as it is
    within, without = shown[20 + RING - 2, 30, :3], shown[20 + RING + 1, 30, :3]
    around = contrast(within, orange[:3]), contrast(without, orange[:3])
    assert max(around) > 4.5 > 2 > contrast(RED[:3], orange[:3])  # WCAG 2: red alone is not seen
    assert (shown[20 + RING + 2, 30] == orange).all() and (shown[20, 31] == orange).all()


def contrast(one, other):
    """The contrast of two linear colours (WCAG 2)."""
    low, high = sorted(float(np.dot(c, LUMINANCE)) for c in (one, other))
    return (high + 0.05) / (low + 0.05)


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


def test_a_difference_of_one_level_is_seen_and_rounding_is_not():
    """Between any two neighbouring levels of sRGB, dark or bright."""
    levels = np.arange(255)[None, :, None] / 255 * np.ones(4)
    first = curve_undone(levels).astype(np.float32)
    for step, least, most in ((1, LEAST, LEAST + 0.01), (0.4, 0, 0), (255, 1, 1)):
        second = curve_undone(np.minimum(levels + step / 255, 1)).astype(np.float32)
        if step == 255:
            first, second = first[:, :1], second[:, :1]
        shown = curve(difference_map(first, second)[..., :3])
        assert (shown >= least - 1e-3).all() and (shown <= most + 1e-3).all()
    assert (difference_map(np.full((1, 1, 4), np.nan), np.ones((1, 1, 4))) == 1).all()
