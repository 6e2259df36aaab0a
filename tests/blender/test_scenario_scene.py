"""Scenarios as scenes in Blender: what is exported from them is the study's, but for float32."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.camera_object import add_camera
from reference_tracer.blender.engine import ENGINE
from reference_tracer.blender.reading.camera import window_of
from reference_tracer.blender.ui.scenario_scene import CHANGED
from reference_tracer.rendering import render
from reference_tracer.scene import Camera, ViewWindow
from reference_tracer.study.scenarios.sweeps import SCENARIOS

from .test_unchanged import differences, state

BY_NAME = {s.name: s for s in SCENARIOS}
FLOAT32 = 2.0**-23  # relative; a corner goes through two roundings
# Those that need numbers no float32 has, even at their first scale.
STORED_ELSEWHERE = {"non_finite"}
PLAIN = sorted(BY_NAME.keys() - STORED_ELSEWHERE)


def opened(name, **options):
    assert bpy.ops.reference_tracer.extreme_scene(scenario=name, **options) == {"FINISHED"}
    return bpy.context.scene


def first(name):
    return repr(float(BY_NAME[name].scales[0]))


def corners(scene):
    """All corners of a Scene's triangles in world space, (n, 3)."""
    out = []
    for i in scene.instances:
        mesh, m = scene.meshes[i.mesh], i.world_from_object
        points = mesh.vertices.astype(float)[mesh.triangles].reshape(-1, 3)
        out.append(points @ m[:3, :3].T + m[:3, 3])
    return np.concatenate(out)


@pytest.mark.parametrize("name", PLAIN)
def test_what_is_exported_is_the_studys_scene(name, export):
    scenario = BY_NAME[name]
    scene = opened(name, scale=first(name))
    wanted = scenario.build(scenario.scales[0], scenario.width, scenario.height)
    got, manifest = export.viewport()
    assert (scene.render.engine, scene.display.shading.light) == (ENGINE, "FLAT")
    assert manifest.unmodelled == ()
    c, w = got.camera, wanted.camera
    assert (c.width, c.height, c.projection) == (w.width, w.height, w.projection)
    size = np.abs(corners(wanted)).max() + np.abs(w.origin).max()
    np.testing.assert_allclose(
        c.world_from_camera[:3, :3], w.world_from_camera[:3, :3], atol=4 * FLOAT32
    )
    np.testing.assert_allclose(c.origin, w.origin, rtol=0, atol=size * FLOAT32)
    np.testing.assert_allclose(
        [c.clip_start, c.clip_end], [w.clip_start, w.clip_end], rtol=2 * FLOAT32
    )
    for side in ("left", "right", "bottom", "top"):
        extent = w.window.right - w.window.left
        assert getattr(c.window, side) == pytest.approx(
            getattr(w.window, side), rel=0, abs=8 * FLOAT32 * extent
        )
    np.testing.assert_allclose(corners(got), corners(wanted), rtol=0, atol=4 * size * FLOAT32)
    np.testing.assert_array_equal(got.background, wanted.background)
    assert [i.colors.tolist() for i in got.instances] == [
        i.colors.tolist() for i in wanted.instances
    ]


@pytest.mark.parametrize("name", ["sheared", "squashed", "far_camera", "tiny", "grazing"])
def test_the_traced_picture_is_the_studys(name, export):
    scenario = BY_NAME[name]
    opened(name, scale=first(name))
    got = render(export.viewport()[0])
    wanted = render(scenario.build(scenario.scales[0], scenario.width, scenario.height))
    assert (got.triangle_index >= 0).any()
    assert (got.triangle_index != wanted.triangle_index).mean() < 0.01


def test_trace_and_compare_works_there():
    opened("far_from_origin", scale="1e6")
    assert bpy.ops.reference_tracer.compare() == {"FINISHED"}


def test_every_scale_is_a_scene_or_says_why_not():
    opened_ones = {}
    for scenario in SCENARIOS:
        for scale in scenario.scales:
            try:
                opened(scenario.name, scale=repr(float(scale)))
                opened_ones.setdefault(scenario.name, []).append(scale)
            except RuntimeError as error:
                assert "cannot be a scene in Blender" in str(error)
    assert opened_ones.keys() == BY_NAME.keys() | STORED_ELSEWHERE
    assert opened_ones["far_from_origin"] == list(BY_NAME["far_from_origin"].scales)
    assert max(opened_ones["huge"]) == 1e38
    assert 1 in opened_ones["tiny"]


def test_what_float32_changed_is_said(capfd):
    scene = opened("far_corners", scale="123456789")
    assert "corners of Sheet moved by up to " in scene[CHANGED]
    assert "camera moved by up to " in scene[CHANGED]
    assert scene[CHANGED].split("\n")[0] in capfd.readouterr().out
    assert opened("integer_cube_ortho", scale="1")[CHANGED] == (
        "float32 holds this scene without a change"
    )


def test_what_blenders_camera_cannot_is_said():
    assert (
        "view window's height 0.003 in place of 9e-06" in opened("grazing", scale="1e-5")[CHANGED]
    )
    assert "clip start 1e-06 m in place of 1e-09 m" in opened("sheared", scale="1e3")[CHANGED]


def test_corners_beyond_float32_are_left_out_and_counted(export):
    scene = opened("non_finite", scale="0.1")
    assert "triangles of Front left out: beyond float32" in scene[CHANGED]
    frame = render(export.viewport()[0])
    assert set(np.unique(frame.object_index)) == {0, 1}  # through the holes, the wall behind


def test_the_last_scale_and_the_studys_size_by_default():
    scene = opened("closed_fan")
    assert scene.name == "Closed fan, triangles 128"
    assert (scene.render.resolution_x, scene.render.resolution_y) == (32, 24)
    scene = opened("closed_fan", scale="4", width=64)
    assert (scene.render.resolution_x, scene.render.resolution_y) == (64, 48)


@pytest.mark.parametrize("scale", ["much", "nan", "inf", "-1e3x"])
def test_a_scale_that_is_no_number(scale):
    with pytest.raises(RuntimeError, match="it must be a number"):
        bpy.ops.reference_tracer.extreme_scene(scenario="tiny", scale=scale)


def test_the_users_scene_stays_and_a_failure_leaves_nothing(build):
    user = build.scene()
    build.solids()
    build.corner_camera()
    bpy.context.view_layer.update()
    before = state()
    with pytest.raises(RuntimeError, match="cannot be a scene in Blender"):
        bpy.ops.reference_tracer.extreme_scene(scenario="huge", scale="1e300")
    assert differences(before, state()) == []
    assert opened("sheared") != user
    bpy.context.window.scene = user
    changed = differences(before, state())
    assert {path.split("/")[1] for path, *_ in changed} == {"names"}


def test_a_pixel_that_blender_cannot_have_is_the_nearest():
    camera = Camera(np.eye(4), ViewWindow(-1, 1, -1e-6, 1e-6), 20, 10)
    scene = bpy.context.scene
    add_camera(scene, camera)
    assert scene.render.pixel_aspect_x == 200
    shown = window_of(scene)
    assert (shown.left, shown.right) == pytest.approx((-1, 1))
    assert shown.top == pytest.approx(2 / 20 * 10 / 200 / 2)
