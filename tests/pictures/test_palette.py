"""Colours that tell objects apart: clear ones for any number, and whether a scene's own do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.files.images import curve_undone
from reference_tracer.pictures.palette import (
    APART,
    MOST,
    By,
    clear_palette,
    eight_bits,
    not_told_apart,
)
from reference_tracer.scene import Plane, SceneError


def codes(palette):
    return np.array([eight_bits(color) for color in palette.colors.values()], np.int32)


def apart(first, second):
    return np.abs(first - second).max()


@pytest.mark.parametrize("count", [1, 2, 40, 10_000])
def test_each_has_its_own_in_8_bits(count):
    names = [f"Object {n}" for n in range(count)]
    palette = clear_palette(names)
    assert palette.by == By.OBJECT and list(palette.colors) == names
    found = codes(palette)
    assert len(np.unique(found, axis=0)) == count
    assert len(np.unique(found // (2 * APART), axis=0)) > 0.9 * count  # they are no neighbours
    few = found[:30]
    distances = [apart(a, b) for n, a in enumerate(few) for b in few[:n]]
    assert not distances or min(distances) > 60


def test_no_two_are_one_another_with_channels_swapped():
    found = np.sort(codes(clear_palette([str(n) for n in range(150)])), axis=1)
    assert min(apart(a, b) for n, a in enumerate(found) for b in found[:n]) > 2 * APART


def test_none_is_that_of_a_background():
    found = codes(clear_palette([str(n) for n in range(2000)]))
    for behind in (0, 255):
        assert min(apart(c, behind) for c in found) > APART


def test_too_many_are_refused():
    with pytest.raises(SceneError, match="clear colours tell apart"):
        clear_palette(["x"] * (MOST + 1))


def scene_in(make, *levels):
    """Return a scene with a square for each colour, (r, g, b) in 8 bits."""
    squares = [make.quad(k, k + 0.5, 0, 1, -3) for k in range(len(levels))]
    scene = make.scene(make.camera(8, 8), *squares)
    linear = curve_undone(np.array(levels) / 255).astype(np.float32)
    colored = [
        replace(i, object=k, colors=np.array([[*c, 1]], np.float32))
        for k, (i, c) in enumerate(zip(scene.instances, linear, strict=True))
    ]
    names = tuple(f"Square {k}" for k in range(len(levels)))
    return replace(scene, instances=tuple(colored), objects=names), names


@pytest.mark.parametrize("color", [(0, 0, 0), (7, 8, 9), (131, 128, 252), (255, 255, 255)])
@pytest.mark.parametrize("step", [0, 1, APART - 1, -1, 1 - APART])
def test_colors_that_rounding_could_exchange_are_not_told_apart(make, color, step):
    other = tuple(np.clip(np.add(color, (step, -step, step)), 0, 255))
    scene, names = scene_in(make, (90, 10, 200), color, other)
    assert set(not_told_apart(scene, names)) == {"Square 1", "Square 2"}


def test_colors_that_are_apart_are_told_apart(make):
    scene, names = scene_in(make, (90, 10, 200), (10, 90, 200), (90, 10, 200 - 3 * APART))
    assert not_told_apart(scene, names) is None
    assert not_told_apart(scene, ["one"] * 3) is None  # of one object, as of what instances them
    assert not_told_apart(replace(scene, instances=()), ()) is None


def test_each_slot_in_use_counts_and_a_plane_and_corners(make):
    scene, names = scene_in(make, (90, 10, 200), (10, 90, 200))
    first, second = scene.instances
    both = np.concatenate((second.colors, first.colors))
    scene = replace(scene, instances=(first, replace(second, colors=both)))
    assert not_told_apart(scene, names) is None  # nothing shows the second slot
    mesh = scene.meshes[second.mesh]
    slots = np.arange(len(mesh.triangles)) % 2
    meshes = [m if m is not mesh else replace(m, slots=slots) for m in scene.meshes]
    assert not_told_apart(replace(scene, meshes=tuple(meshes)), names) == names
    plane = Plane(1, np.zeros(3), np.array((0, 0, 1.0)), first.colors[0])
    assert not_told_apart(replace(scene, planes=(plane,)), (*names, "Ground"))[1] == "Ground"
    corners = np.tile(first.colors[0], (len(mesh.triangles), 3, 1))
    meshes = [m if m is not mesh else replace(m, corner_colors=corners) for m in scene.meshes]
    assert not_told_apart(replace(scene, meshes=tuple(meshes)), names) == names
