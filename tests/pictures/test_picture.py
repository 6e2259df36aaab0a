"""What the other side shows: a wrong colour is no wrong object, and the other way round."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.explain import (
    AGREE,
    COLOR,
    NOT_MODELLED,
    UNEXPLAINED,
    explain,
)
from reference_tracer.manifest import Effect, Unmodelled
from reference_tracer.pictures.identity import UNKNOWN
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.storage import Storage
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of

from ..cases import case_of, find_causes, owners_of, showing

LIGHT = Unmodelled("scene 'Scene'", "studio light", effect=Effect.LIGHT)


@pytest.fixture
def room(room):
    return replace(room, objects=("Ball", "Box", "Wall"))


@pytest.fixture
def seen(room):
    """Return the room's frame, and its picture with whose surfaces it shows."""
    frame = render(room)
    return frame, Picture(frame.color.copy(), owners=owners_of(room.objects, frame))


def causes(scene, frame, shown, *rest):
    return result_of(find_causes(scene, frame, shown, *rest))


@pytest.mark.parametrize("ramp", [False, True])
def test_an_owner_that_cannot_have_the_colour_is_forgotten(ramp, make):
    """The two drawings contradict one another; a colour between corners may be any."""
    quads = [make.quad(x, x + 0.3, -0.3, 0.3, -2) for x in (-0.5, 0.1)]
    if ramp:
        colors = np.linspace(0, 1, 3 * 4 * len(quads[1].triangles)).reshape(-1, 3, 4)
        quads[1] = replace(quads[1], corner_colors=colors.astype(np.float32))
    scene = make.scene(make.camera(40, 30), *quads)
    frame = render(scene)
    right = Picture(frame.color.copy(), owners=owners_of(("Plain", "Other"), frame))
    wrong = right.owners.pixels == 0
    shown = showing(right, wrong, 1)
    found = result_of(explain(case_of(scene, shown), frame))
    assert wrong.sum() > 20
    assert (found.case.picture.owners.pixels[wrong] == (1 if ramp else UNKNOWN)).all()
    unexplained = found.causes.cause == UNEXPLAINED
    assert (unexplained[wrong]).mean() > 0.8 if ramp else not unexplained.any()


def test_light_excuses_shades_but_no_object(room, seen):
    frame, shown = seen
    lit = frame.color * np.float32((0.4, 0.5, 0.6, 1))
    box = shown.owners.pixels == 1
    shown = replace(shown, color=lit)
    found = causes(room, frame, shown, [LIGHT])
    surface = frame.instance_index >= 0
    assert (found.cause[surface] == COLOR).all()
    assert (found.cause[~surface] == AGREE).all()
    assert found.transform
    found = causes(room, frame, showing(shown, box, 0), [LIGHT])
    assert (found.cause[box] == UNEXPLAINED).mean() > 0.8
    assert (found.cause[surface & ~box] == COLOR).all()


def test_light_without_identity_is_not_modelled(room):
    frame = render(room)
    lit = frame.color * np.float32((0.4, 0.5, 0.6, 1))
    found = causes(room, frame, lit, [LIGHT])
    assert (found.cause[frame.instance_index >= 0] == NOT_MODELLED).all()


def test_an_opaque_picture_has_no_alpha_to_compare(room, seen):
    frame, _ = seen
    color = frame.color.copy()
    color[..., 3] = 1
    assert (causes(room, frame, Picture(color, storage=Storage(opaque=True))).cause == AGREE).all()
    assert (causes(room, frame, Picture(color)).cause == UNEXPLAINED).any()
