"""An object that only one side shows, or another frame: traced, and named with the reason."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.case import Alternative
from reference_tracer.causes.cause import Hidden
from reference_tracer.causes.checks.hidden import with_object
from reference_tracer.causes.explain import HIDDEN, UNEXPLAINED
from reference_tracer.manifest import ObjectEntry
from reference_tracer.pictures.identity import Owners
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.scene import without
from reference_tracer.tracer.progress import result_of

from ...cases import find_causes, owners_of

WHY = "hidden in the viewport"


def found(scene, picture, *alternatives):
    return result_of(find_causes(scene, render(scene), picture, alternatives=alternatives))


@pytest.fixture
def named(room):
    return replace(room, objects=("Ball", "Box", "Wall"))


def test_an_object_that_the_picture_lacks(named):
    lacking = without(named, ["Box"])
    causes = found(named, render(lacking).color, Alternative("Box", WHY, lacking))
    assert causes.hidden == [Hidden("Box", WHY)]
    assert not (causes.cause == UNEXPLAINED).any()
    assert (causes.cause == HIDDEN).sum() > 50
    assert (causes.figure[causes.cause == HIDDEN] == 0).all()


def test_an_object_that_only_the_picture_has(named):
    lacking = without(named, ["Box"])
    whole = with_object(lacking, named, "Box")
    assert whole.triangle_count == named.triangle_count
    np.testing.assert_array_equal(render(whole).color, render(named).color)
    causes = found(lacking, render(named).color, Alternative("Box", WHY, whole))
    assert causes.hidden == [Hidden("Box", WHY)]
    assert not (causes.cause == UNEXPLAINED).any()


def test_a_flag_that_explains_nothing_is_not_named(named):
    """The ball is hidden for one side, but it is the box that the picture lacks."""
    picture = render(without(named, ["Box"])).color
    causes = found(named, picture, Alternative("Ball", WHY, without(named, ["Ball"])))
    assert causes.hidden == []
    assert (causes.cause == UNEXPLAINED).sum() > 50


def test_an_object_that_is_known_to_be_shown(named):
    """By whose surface the picture shows: the reason comes from the manifest."""
    lacking = without(named, ["Box"])
    names, why = ("Ball", "Box", "Wall"), "hidden in renders"
    frame = render(lacking)
    whole = render(named)
    owner = owners_of(names, whole).pixels
    there = [lacking.objects[i.object] for i in lacking.instances]
    shown = Picture(whole.color, owners=Owners.of(names, owner, there))
    entry = ObjectEntry("Box", "MESH", False, why, hidden=True)
    causes = result_of(find_causes(lacking, frame, shown, objects=[entry]))
    assert causes.hidden == [Hidden("Box", why)]
    assert (causes.cause[owner == 1] == HIDDEN).mean() > 0.9
    causes = result_of(find_causes(lacking, frame, shown))
    assert (causes.cause[owner == 1] == UNEXPLAINED).mean() > 0.9


def moved(scene, name, by):
    """Return a scene with an object elsewhere, `by` (3,) metres."""
    number, shift = scene.objects.index(name), np.eye(4)
    shift[:3, 3] = by
    instances = [
        replace(i, world_from_object=shift @ i.world_from_object) if i.object == number else i
        for i in scene.instances
    ]
    return replace(scene, instances=tuple(instances))


@pytest.mark.parametrize("by", [(0.15, 0, 0), (0, 0.15, 0)])
def test_a_hidden_object_beside_its_place_is_not_excused(named, by):
    """Most of it is where it would be; that is a piece of the truth."""
    lacking = without(named, ["Box"])
    shown = render(moved(named, "Box", by)).color
    whole = Alternative("Box", WHY, with_object(lacking, named, "Box"))
    causes = found(lacking, shown, whole)
    changed = (shown != render(lacking).color).any(axis=-1)
    assert causes.hidden == [] and (causes.cause[changed] == UNEXPLAINED).mean() > 0.9


def test_pieces_of_two_frames_are_not_excused(named):
    """A picture that is moved as a whole agrees here and there with the frames beside."""
    others = [moved(named, "Ball", (x, 0, 0)) for x in (-0.14, 0.14)]
    rolled = np.roll(render(named).color, 1, axis=1)
    frames = [Alternative("what is animated", f"frame {n}", s) for n, s in enumerate(others)]
    causes = found(named, rolled, *frames)
    assert causes.hidden == []
    assert (causes.cause == UNEXPLAINED).sum() == (
        (found(named, rolled).cause == UNEXPLAINED).sum()
    )


def test_the_frame_beside_is_still_told(named):
    other = moved(named, "Ball", (0.06, 0, 0))
    causes = found(named, render(other).color, Alternative("what is animated", WHY, other))
    assert causes.hidden == [Hidden("what is animated", WHY)]
    assert not (causes.cause == UNEXPLAINED).any()
