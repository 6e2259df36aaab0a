"""Colours that went through a curve: it is named, and a wrong object is not excused by it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.explain import AGREE, COLOR, UNEXPLAINED
from reference_tracer.files.images import curve, curve_undone, decoded
from reference_tracer.pictures.metrics import boundary
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.storage import Storage
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of

from ...cases import find_causes


@pytest.fixture
def frame(room):
    return render(room)


def changed(frame, change):
    color = frame.color.astype(np.float64)
    color[..., :3] = change(color[..., :3])
    return color.astype(np.float32)


def found(scene, frame, shown, curves=()):
    return result_of(find_causes(scene, frame, shown, curves=curves))


@pytest.mark.parametrize(
    ("change", "name"),
    [
        (curve, "sRGB's curve applied once more"),
        (curve_undone, "sRGB's curve left out"),
        (lambda c: c ** (1 / 2.2), "a power of 1/2.2"),
        (lambda c: c * 4, "an exposure of +2 stops"),
        (lambda c: c**1.5, "a gamma of 0.667"),
        (lambda c: c[..., ::-1], "red and blue swapped"),
    ],
)
def test_a_transform_is_named(room, frame, change, name):
    causes = found(room, frame, Picture(changed(frame, change)))
    assert causes.transform == name
    surface = frame.instance_index >= 0
    assert set(np.unique(causes.cause[surface])) <= {COLOR, AGREE}
    own = causes.cause == COLOR
    assert own.sum() > 0.9 * surface.sum()
    assert (causes.figure[own] <= causes.allowed[own]).all()


@pytest.mark.parametrize(("other", "named"), [(True, 0), (False, 1)])
def test_what_shows_another_surface_is_in_no_other_shade(make, other, named):
    """What has the colour of another surface, also far away, may be that; a new one is its own."""
    sides = make.quad(-3, -1, -1, 1, -6), make.quad(1, 3, -1, 1, -6)
    colors = np.array([(0.9, 0.1, 0.1, 1), (0.1, 0.2, 0.9, 1)], np.float32)
    scene = make.scene(make.camera(48, 27), *sides)
    every = zip(scene.instances, colors, strict=True)
    scene = replace(scene, instances=tuple(replace(i, colors=[c]) for i, c in every))
    frame = render(scene)
    shown = frame.color.copy()
    shown[frame.instance_index == 0] = colors[1] if other else (0.5, 0.7, 0.2, 1)
    assert (frame.instance_index == 0).sum() > 50
    assert len(found(scene, frame, Picture(shown)).shades) == named


def test_none_is_looked_for_where_none_may_be(room, frame):
    causes = found(room, frame, Picture(changed(frame, curve)), curves=None)
    assert causes.transform == "" and (causes.cause == UNEXPLAINED).sum() > 500


def test_a_file_that_was_cut_off_not_rounded(room, frame):
    stored = np.floor(255 * curve(frame.color[..., :3].astype(np.float64)))
    color = frame.color.copy()
    color[..., :3] = decoded(stored / 255)
    causes = found(room, frame, Picture(color, storage=Storage(255)))
    assert causes.transform == "values cut off, not rounded"
    assert not (causes.cause == UNEXPLAINED).any()


def test_linear_values_in_a_png(room, frame):
    color = frame.color.copy()
    color[..., :3] = decoded(np.rint(255 * frame.color[..., :3].astype(np.float64)) / 255)
    causes = found(room, frame, Picture(color, storage=Storage(255)))
    assert causes.transform.startswith("sRGB's curve left out")
    assert not (causes.cause == UNEXPLAINED).any()


@pytest.mark.parametrize("power", [1 / 2.2, 2.2, 1.31])
def test_a_gamma_of_coded_values(room, frame, power):
    """As image programs apply it to an 8-bit file."""
    once = np.rint(255 * curve(frame.color[..., :3].astype(np.float64))) / 255
    color = frame.color.copy()
    color[..., :3] = decoded(np.rint(255 * once**power) / 255)
    causes = found(room, frame, Picture(color, storage=Storage(255)))
    name = causes.transform
    assert name.startswith("a gamma of ") and name.endswith(" applied to coded (sRGB) values")
    assert float(name.split()[3]) == pytest.approx(1 / power, rel=0.02)
    assert not (causes.cause == UNEXPLAINED).any()


def test_a_large_area_alone_fits_no_curve(room, frame):
    """The background and the largest object are darker by a power, the others by another."""
    largest = np.bincount(frame.instance_index[frame.instance_index >= 0]).argmax()
    room = replace(room, background=(0.3, 0.3, 0.3, 1))
    frame = render(room)
    dark = (frame.instance_index < 0) | (frame.instance_index == largest)
    power = np.where(dark, 2.18, 1.6 + 0.3 * frame.instance_index)
    color = frame.color.copy()
    color[..., :3] **= power[..., None]
    causes = found(room, frame, Picture(color))
    assert causes.transform == "" and not (causes.cause == COLOR).any()


def test_one_grey_surface_proves_no_fit(make):
    scene = make.scene(make.camera(20, 16), make.quad(-9, 9, -9, 9, -3))
    grey = replace(scene.instances[0], colors=((0.5, 0.5, 0.5, 1),))
    scene = replace(scene, instances=(grey,))
    frame = render(scene)
    causes = found(scene, frame, Picture(changed(frame, lambda c: c * 0.7)))
    assert causes.transform == "" and (causes.cause == UNEXPLAINED).all()


def test_a_missing_object_shows_through_a_transform(room, frame):
    without = replace(room, instances=[i for i in room.instances if i.object != 1])
    box = frame.object_index == 1
    color = render(without).color.astype(np.float64)
    color[..., :3] = curve(color[..., :3])
    causes = found(room, frame, Picture(color.astype(np.float32)))
    assert causes.transform == "sRGB's curve applied once more"
    assert (causes.cause[box] == UNEXPLAINED).mean() > 0.8
    assert (causes.cause[(frame.object_index == 0)] == COLOR).mean() > 0.9


def test_noise_has_no_transform(room, frame, rng):
    color = frame.color * rng.uniform(0.2, 2, (*frame.t.shape, 1)).astype(np.float32)
    color[..., 3] = frame.color[..., 3]
    causes = found(room, frame, Picture(color))
    assert causes.transform == "" and not (causes.cause == COLOR).any()


def test_boundaries_are_counted_once(make):
    """One pixel on either side of every edge, and the background is a surface, too."""
    scene = make.scene(make.camera(20, 16, half=8, orthographic=True), make.quad(-4, 3, -9, 9, -3))
    at = boundary(render(scene))
    assert at.all(axis=0).sum() == 4 == at.any(axis=0).sum()
    assert not boundary(render(make.scene(make.camera(9, 9)))).any()
