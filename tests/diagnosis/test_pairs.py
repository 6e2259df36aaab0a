"""Two faults at once: after one is put right, the other is found as if it were alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.diagnosis.faults.fault import Numbers
from reference_tracer.diagnosis.faults.pose import Posed
from reference_tracer.diagnosis.trial import LOOKED_AT
from reference_tracer.files.images import curve_undone
from reference_tracer.rendering import render

from .diagnosing import diagnosis_of, names, pictured


@pytest.fixture
def scene(few):
    return few(96, 60)


def of_rgb(color, change):
    """Return a picture with its RGB changed."""
    changed = change(color[..., :3].astype(np.float64))
    return np.concatenate((changed, color[..., 3:]), axis=-1).astype(np.float32)


def linear(color):
    """Write linear colours to a file that is read as sRGB's."""
    return of_rgb(color, curve_undone)


def reversed_channels(color):
    return of_rgb(color, lambda c: c[..., ::-1])


@pytest.mark.slow
def test_half_a_pixel_is_found_in_linear_colours(scene):
    found = diagnosis_of(scene, linear(pictured(scene, "pixel_offset", Numbers((0.5, 0.5)))))
    assert found.causes.transform == "sRGB's curve left out"
    assert names(found) == ["pixel_offset"] and found.diagnosis.left == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda c: c ** (1 / 1.6), "a gamma of 1.6"),
        (lambda c: curve_undone(c ** (1 / 1.8)), "a power of 1/1.8 in place of sRGB's curve"),
        (lambda c: 0.8 * c, "an exposure of -0.322 stops"),
    ],
)
def test_a_moved_object_is_found_behind_a_curve(scene, change, told):
    moved = pictured(scene, "object_moved", Posed((0.3, -0.2, 0.1), object="Ball"))
    found = diagnosis_of(scene, of_rgb(moved, change))
    assert found.causes.transform == told
    assert names(found)[0] == "object_moved"
    assert found.diagnosis.told[0].guess.object == "Ball"


@pytest.mark.slow
def test_linear_colours_alone_are_no_fault_of_the_camera(scene):
    found = diagnosis_of(scene, linear(render(scene).color))
    assert found.counts.unexplained == 0 and not names(found)


TURNED = {"rows": np.s_[::-1], "picture_turned": np.s_[::-1, ::-1], "mirrored_x": np.s_[:, ::-1]}


@pytest.mark.slow
@pytest.mark.parametrize("name", TURNED)
def test_a_turned_picture_in_reversed_channels_is_both(scene, name):
    found = diagnosis_of(scene, reversed_channels(render(scene).color[TURNED[name]]))
    first, *others = found.diagnosis.told
    assert first.fault.name == name and found.diagnosis.left == 0
    # The colours are told as a fault, or excused by their transform once the picture is turned.
    assert "red and blue swapped" in (others[0] if others else first).sentence


@pytest.mark.slow
def test_of_very_many_pixels_all_are_counted(few):
    """The first trial looks at some of those that differ; what is told is of the whole picture."""
    scene = few(192, 108)
    found = diagnosis_of(scene, reversed_channels(render(scene).color[::-1]))
    told = found.diagnosis.told
    assert found.counts.unexplained > LOOKED_AT and found.diagnosis.left == 0
    assert sum(t.settled - t.broken for t in told) == found.counts.unexplained


@pytest.mark.slow
def test_a_picture_turned_in_a_part_is_not_turned(scene):
    color = reversed_channels(render(scene).color)
    color[:, :48] = color[::-1, :48]
    assert not set(names(diagnosis_of(scene, color))) & {*TURNED, "channels"}


def smoothed(scene, weights):
    """Render n x n samples in each pixel, and weigh their rows and columns alike."""
    n, c = len(weights), scene.camera
    more = replace(c, width=n * c.width, height=n * c.height, region=None)
    samples = render(scene.seen_by(more)).color.astype(np.float64)
    tiles = samples.reshape(c.height, n, c.width, n, 4)
    return np.einsum("ayxbc,y,b->axc", tiles, weights, weights).astype(np.float32)


@pytest.mark.slow
@pytest.mark.parametrize("weights", [(0.25, 0.25, 0.25, 0.25), (0.05, 0.25, 0.4, 0.25, 0.05)])
def test_another_angle_of_view_is_found_in_an_anti_aliased_picture(few, weights):
    """Whose edges are mixed as far as a filter reaches; one that is smooth alone has no other."""
    scene = few(160, 100)
    window = scene.camera.window.scaled(1 / 1.05, 1 / 1.05)
    wider = scene.seen_by(replace(scene.camera, window=window))
    found = diagnosis_of(scene, smoothed(wider, weights))
    first, second = found.diagnosis.told
    assert first.fault.name == "focal_length" and found.diagnosis.left == 0
    assert abs(first.guess.values[0] - 5) < 0.3
    smooth = {"supersampled", "filter_radius"}
    assert second.fault.name in smooth
    assert {*names(diagnosis_of(scene, smoothed(scene, weights)))} <= smooth


@pytest.mark.torture
def test_another_angle_of_view_is_found_in_a_picture_upside_down(scene):
    wider = pictured(scene, "focal_length", Numbers((6.0,)))
    found = diagnosis_of(scene, wider[::-1].copy())
    assert sorted(names(found)) == ["focal_length", "rows"] and found.diagnosis.left == 0
