"""Faults made on purpose: each is found, and what cannot be known is said to be so.

What stands in for Blender's picture here is made by the tracer itself, from a scene with a fault.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.checks.unmodelled import covered
from reference_tracer.causes.explain import (
    AGREE,
    NOT_DECIDABLE,
    NOT_MODELLED,
    NOT_TRACED,
    UNEXPLAINED,
)
from reference_tracer.manifest import Unmodelled
from reference_tracer.pictures.bands import band_of
from reference_tracer.rendering import render
from reference_tracer.tracer import render as rendering
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..cases import count, explained, find_causes, rising

WHITE = (1.0, 1.0, 1.0, 1.0)


def test_what_is_not_modelled_explains_only_its_own_place(room):
    bounds = np.array([(0.3, -0.8, -0.9), (1.1, 0.1, 0.3)])
    inside = covered(room.camera, bounds)
    assert 20 < inside.sum() < 0.5 * inside.size
    picture = render(room).color.copy()
    picture[::3] = WHITE
    features = [Unmodelled("Cam", "depth of field"), Unmodelled("Hair", "hair", bounds=bounds)]
    found = explained(room, picture, features)
    rows = np.zeros_like(inside)
    rows[::3] = True
    assert (found.cause[inside & rows] == NOT_MODELLED).all()
    assert (found.figure[inside & rows] == 1).all()  # its number in the manifest
    assert (found.cause[~inside & rows] == UNEXPLAINED).all()
    assert (found.cause[~rows] == AGREE).all()


def test_far_from_the_origin_nothing_is_decided(room, make):
    far = np.eye(4)
    far[:3, 3] = (3e7, -2e7, 1e7)
    scene = replace(
        room,
        camera=replace(room.camera, world_from_camera=far @ room.camera.world_from_camera),
        instances=[replace(i, world_from_object=far) for i in room.instances],
    )
    picture = render(scene).color
    for shown in (picture, picture[::-1].copy()):
        found = explained(scene, shown)
        assert (found.cause == NOT_DECIDABLE).all()
        assert (found.figure > found.allowed).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_differs(room, value):
    picture = render(room).color.copy()
    picture[20, 30, 1] = picture[2, 3, 3] = value
    found = explained(room, picture)
    assert found.cause[20, 30] == found.cause[2, 3] == UNEXPLAINED
    assert count(found, AGREE) == found.cause.size - 2


def test_rows_that_were_not_traced(room, monkeypatch):
    share = Settings().memory // (4 * room.camera.width)
    monkeypatch.setattr(rendering, "BYTES_PER_PIXEL", share)  # bands of 4 rows
    whole = render(room)
    steps = []
    frame = render(room, progress=steps.append, cancelled=lambda: steps[-1] > 0.5)
    assert frame.cancelled and frame.rows_done.any()
    found = result_of(find_causes(room, frame, whole.color))
    assert (found.cause[~frame.rows_done] == NOT_TRACED).all()
    assert (found.cause[frame.rows_done] == AGREE).all()


def test_progress_rises(room):
    shares, _ = rising(find_causes(room, render(room), 0 * render(room).color))
    assert len(set(shares)) > 1


@pytest.mark.parametrize("bounds", [np.nan, np.inf])
def test_bounds_that_are_not_finite_explain_nothing(room, bounds):
    """An object with a matrix that is not finite has no place in the picture."""
    hair = Unmodelled("Hair", "hair", bounds=np.full((2, 3), bounds) * [[-1], [1]])
    found = explained(room, 0 * render(room).color, [hair])
    assert count(found, UNEXPLAINED) > 100 and count(found, NOT_MODELLED) == 0


def test_a_near_surface_does_not_excuse_the_background(make):
    """It may be off by many pixels itself; what is farther from it than that is still judged."""
    eye = (1000.0, 0.0, 0.0)
    camera = make.camera(200, 150, eye=eye, clip_start=0.001)
    near = make.quad(1000 - 0.012, 1000 - 0.011, -0.0005, 0.0005, -0.03)
    far = make.quad(1001, 1002, -1, 1, -8)
    scene, without = make.scene(camera, near, far), make.scene(camera, near)
    found = result_of(find_causes(without, render(without), render(scene).color))
    frame = render(without)
    band = band_of(without, frame)
    result_of(band.find(np.ones(frame.shape, bool)))
    assert band.values.max() > 2 and (found.cause == NOT_DECIDABLE).any()
    seen = render(scene).object_index == 1
    assert seen.sum() > 100 and (found.cause[seen] == UNEXPLAINED).all()
