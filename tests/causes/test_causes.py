"""Faults made on purpose: each is found, and what cannot be known is said to be so.

What stands in for Blender's picture here is made by the tracer itself, from a scene with a fault.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
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
from reference_tracer.pictures.bounds import differing
from reference_tracer.rendering import render
from reference_tracer.scene import Region, ViewWindow
from reference_tracer.tracer import render as rendering
from reference_tracer.tracer.camera import film_of, pixel_size
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..cases import count, explained, find_causes

WHITE = (1.0, 1.0, 1.0, 1.0)


def test_the_same_picture_agrees(room):
    assert (explained(room, render(room).color).cause == AGREE).all()


def faults():
    """Yield the name of each fault, and what makes it of a scene's picture."""

    def dropped(k):
        return lambda scene: (
            render(replace(scene, instances=[i for i in scene.instances if i.object != k])).color
        )

    def moved(matrix):
        return lambda scene: (
            render(
                replace(
                    scene,
                    instances=[
                        replace(i, world_from_object=matrix) if i.object == 1 else i
                        for i in scene.instances
                    ],
                )
            ).color
        )

    def recoloured(scene):
        first, second, third = scene.instances
        return render(
            replace(
                scene,
                instances=[
                    replace(first, colors=second.colors),
                    replace(second, colors=first.colors),
                    third,
                ],
            )
        ).color

    def window(scale, shift):
        def picture(scene):
            w, (width, _) = scene.camera.window, pixel_size(scene.camera)
            left, right = (scale * x + shift * width for x in (w.left, w.right))
            seen = ViewWindow(left, right, scale * w.bottom, scale * w.top)
            return render(replace(scene, camera=replace(scene.camera, window=seen))).color

        return picture

    turn = trimesh.transformations.rotation_matrix(0.4, (1, 2, 3))
    yield from {
        "half a pixel": window(1, 0.5),
        "mirrored": lambda s: render(s).color[:, ::-1],
        "rows flipped": lambda s: render(s).color[::-1],
        "no ball": dropped(0),
        "no box": dropped(1),
        "no wall": dropped(2),
        "turned": moved(turn),
        "transposed": moved(turn.T @ turn.T),
        "recoloured": recoloured,
        "sensor fit": window(0.75, 0),
        "black": lambda s: 0 * render(s).color,
        "one pixel up": lambda s: np.roll(render(s).color, 1, 0),
    }.items()


@pytest.mark.slow
@pytest.mark.parametrize("fault", [f for _, f in faults()], ids=[name for name, _ in faults()])
def test_a_fault_is_unexplained(room, fault):
    picture = np.ascontiguousarray(fault(room))
    found = explained(room, picture)
    differ = differing(render(room).color, picture).sum()
    assert count(found, UNEXPLAINED) > max(10, 0.8 * differ)


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


def test_a_box_covers_its_projection(room, rng):
    for _ in range(40):
        center, size = rng.normal(size=3), 10.0 ** rng.uniform(-3, 0, 3)
        bounds = np.stack((center - size, center + size))
        inside = covered(room.camera, bounds)
        points = rng.uniform(*bounds, (2000, 3))
        points[:8] = np.array(np.meshgrid(*bounds.T)).reshape(3, 8).T
        x, y, depth = film_of(room.camera, points.T)
        assert (depth > room.camera.clip_start).all()
        shown = (x >= 0) & (x < 60) & (y >= 0) & (y < 45)
        assert inside[y[shown].astype(int), x[shown].astype(int)].all()
        box = [np.floor(v.min()) <= np.arange(n) for v, n in ((y[:8], 45), (x[:8], 60))]
        box = [b & (np.arange(len(b)) <= v[:8].max()) for b, v in zip(box, (y, x), strict=True)]
        assert (inside <= np.outer(*box)).all()


def test_boxes_around_behind_and_beyond(room):
    eye, forward = room.camera.origin, room.camera.forward

    def at(depth):
        return covered(room.camera, eye + depth * forward + np.array([[-0.3], [0.3]]))

    assert at(0).all() or room.camera.projection.shares_direction
    assert not at(-2).any() and not at(2000).any()


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


def test_an_empty_scene_agrees_with_its_background(make):
    scene = make.scene(make.camera(8, 6), background=(0.2, 0.3, 0.4, 1))
    assert (explained(scene, render(scene).color).cause == AGREE).all()
    assert (explained(scene, render(scene).color * 0).cause == UNEXPLAINED).all()


def test_progress_rises(room):
    shares = []
    result_of(find_causes(room, render(room), 0 * render(room).color), shares.append)
    assert (np.diff(shares) >= 0).all() and 0 <= shares[0] and shares[-1] <= 1


@pytest.mark.parametrize("bounds", [np.nan, np.inf])
def test_bounds_that_are_not_finite_explain_nothing(room, bounds):
    """An object with a matrix that is not finite has no place in the picture."""
    hair = Unmodelled("Hair", "hair", bounds=np.full((2, 3), bounds) * [[-1], [1]])
    found = explained(room, 0 * render(room).color, [hair])
    assert count(found, UNEXPLAINED) > 100 and count(found, NOT_MODELLED) == 0


def test_a_border_has_the_causes_of_the_whole(room):
    """Away from its rim, where a pixel's neighbours are not there."""
    picture = render(room).color.copy()
    picture[::2] = WHITE
    hair = Unmodelled("Hair", "hair", bounds=np.array([(0.3, -0.8, -0.9), (1.1, 0.1, 0.3)]))
    region = Region(11, 6, 52, 41)
    part = replace(room, camera=replace(room.camera, region=region))
    whole = explained(room, picture, [hair])
    found = explained(part, picture[6:41, 11:52].copy(), [hair])
    assert len(np.unique(found.cause)) == 3
    for name in ("cause", "figure", "allowed"):
        cut = getattr(whole, name)[7:40, 12:51]
        assert np.array_equal(getattr(found, name)[1:-1, 1:-1], cut, equal_nan=True)


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
