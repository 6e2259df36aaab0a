"""Numbers as colours: they survive what a renderer and a file do to them, and a mix is nobody's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.pictures.identity import (
    MOST_OBJECTS,
    NOTHING,
    UNKNOWN,
    Identity,
    Owners,
    Shows,
    colors_of,
    decode,
)


def picture(count):
    rgb = colors_of(count)
    return np.concatenate((rgb, np.ones((count, 1), np.float32)), axis=1)[None]


def test_every_number_comes_back_through_half_floats_and_bytes():
    shown = picture(MOST_OBJECTS)
    numbers = np.arange(MOST_OBJECTS)[None]
    for stored in (
        shown,
        shown.astype(np.float16).astype(np.float32),
        np.nextafter(shown.astype(np.float16), np.float16(0)).astype(np.float32),
        np.rint(255 * shown) / 255,
        np.concatenate((shown[..., :3] * 0.999, shown[..., 3:]), axis=-1),
    ):
        np.testing.assert_array_equal(decode(stored.astype(np.float32), MOST_OBJECTS), numbers)
    assert len(np.unique(shown[0], axis=0)) == MOST_OBJECTS


def test_more_than_there_are_colours_is_refused():
    with pytest.raises(ValueError, match=str(MOST_OBJECTS)):
        colors_of(MOST_OBJECTS + 1)


def test_background_and_what_is_nobodys():
    shown = picture(40)[0]
    assert decode(np.zeros((1, 1, 4)), 40) == NOTHING
    assert decode(shown[None, 39:], 39) == UNKNOWN  # a number that nothing has
    assert decode(np.array([[[0, 0, 0, 0.5]]]), 40) == UNKNOWN
    assert decode(np.array([[[np.nan, 0, 0, 1]]]), 40) == UNKNOWN


def test_a_wrong_digit_is_noticed():
    """One channel off by a digit."""
    shown = picture(MOST_OBJECTS)
    for channel in range(3):
        for step in (-1, 1):
            wrong = shown.copy()
            wrong[..., channel] = np.clip(wrong[..., channel] + step / 31, 0, 1)
            moved = np.abs(wrong - shown).max(axis=-1) > 1e-3
            assert moved.sum() > 100
            assert (decode(wrong, MOST_OBJECTS)[moved] == UNKNOWN).all()


def test_counts():
    traced = np.array([[0, 1, NOTHING], [1, 1, 0]], np.int32)
    shown = np.array([[0, 0, NOTHING], [UNKNOWN, 1, NOTHING]], np.int32)
    found = Identity(("A", "B"), traced, shown)
    assert found.shows() == Shows(same_object=3, other_object=2, not_known=1)
    assert found.shows(traced == 1) == Shows(same_object=1, other_object=1, not_known=1)
    assert found.to_dict() == {"names": ["A", "B"], "pixels": found.shows()._asdict()}


def test_the_owners_of_another_scene_are_those_of_the_same_names(make):
    """An object that two others instance has two owners: whose it is there is not known."""
    whole = make.scene(make.camera(), *(make.quad(x, x + 1, 0, 1, -2) for x in range(4)))
    names = ("Hut", "Tree", "First", "Second")
    scene = replace(whole, objects=("Hut", "Leaf", "Leaf", "Tree"))
    owners = Owners.of(names, np.zeros(2, np.int32), ("Hut", "First", "Second", "Second"))
    assert owners.in_scene(replace(scene), scene) is owners
    lacking = replace(scene, instances=scene.instances[1:])
    found = owners.in_scene(lacking, scene).instances
    nobody = len(names)
    assert found.tolist() == [nobody, nobody, 3, NOTHING]
    back = replace(whole, objects=("New", "Tree", "First", "Hut"))
    assert owners.in_scene(back, scene).instances.tolist() == [nobody, 3, 2, 0, NOTHING]
