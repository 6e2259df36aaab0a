"""Blender's own picture: how it is asked for, and what comes when it cannot be had.

The viewport's own drawing needs a window; what is tested of it here is what leads up to it.
"""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing import picture as picture_module
from reference_tracer.blender.drawing import shading
from reference_tracer.blender.drawing.judges import JUDGES
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.blender.temporary import temporary_scene
from reference_tracer.pictures.source import SizeError
from reference_tracer.scene import SceneError


@pytest.fixture
def scene(build):
    scene = build.room(lens=40)
    return scene


def pictured(scene, judge="workbench", like_for_like=True):
    camera = export_camera(scene)
    with temporary_scene(scene) as copy:
        picture_module.prepare_scene(copy, JUDGES[judge], like_for_like)
        return picture_module.drawn_once(copy, JUDGES[judge], camera, like_for_like)


@pytest.mark.parametrize(
    "setting",
    [
        ("display.render_aa", "32"),
        ("render.use_stamp", True),
        ("render.use_file_extension", False),
        ("render.use_overwrite", False),
        ("render.use_placeholder", True),
        ("render.use_multiview", True),
        ("render.use_motion_blur", True),
        ("render.use_freestyle", True),
        ("render.dither_intensity", 2.0),
        ("render.use_simplify", True),
        ("render.use_high_quality_normals", True),
        ("view_settings.exposure", 3.0),
        ("view_settings.view_transform", "Standard"),
        ("view_settings.gamma", 2.0),
        ("render.resolution_percentage", 100),
        ("display.shading.show_cavity", True),
        ("display.shading.show_xray", True),
        ("display.shading.show_object_outline", True),
        ("display.shading.background_type", "VIEWPORT"),
        ("render.film_transparent", False),
        ("render.filter_size", 5.0),
        ("render.use_render_cache", True),
        ("render.use_persistent_data", True),
        ("render.image_settings.file_format", "JPEG"),
        ("render.image_settings.color_mode", "BW"),
        ("render.use_single_layer", True),
        ("render.use_sequencer", True),
        ("render.use_compositing", True),
    ],
    ids=lambda setting: setting[0],
)
def test_no_setting_of_the_scene_changes_the_picture(setting, scene):
    before = pictured(scene)
    *path, name = setting[0].split(".")
    target = scene
    for step in path:
        target = getattr(target, step)
    setattr(target, name, setting[1])
    np.testing.assert_array_equal(pictured(scene), before)


def test_a_picture_of_another_size_is_an_error(scene):
    camera = export_camera(scene)
    with temporary_scene(scene) as copy:
        picture_module.prepare_scene(copy, JUDGES["workbench"], True)
        copy.render.resolution_x = 64
        with pytest.raises(SizeError, match="64 x 54 pixels, the camera's region 96 x 54"):
            picture_module.drawn_once(copy, JUDGES["workbench"], camera, True)


def test_the_viewport_needs_a_window_and_says_so(scene):
    """And leaves the preference as it was, which it sets for the drawing."""
    preferences = bpy.context.preferences
    preferences.system.viewport_aa, preferences.is_dirty = "16", False
    with pytest.raises(SceneError, match=r"viewport draws no picture: .*background"):
        pictured(scene, "viewport")
    assert (preferences.system.viewport_aa, preferences.is_dirty) == ("16", False)
    assert len(bpy.data.scenes) == 1


def test_the_shading_of_a_view_is_copied(scene):
    source = scene.copy().display.shading
    source.light, source.color_type, source.single_color = "FLAT", "SINGLE", (0.1, 0.2, 0.3)
    source.background_type, source.show_cavity = "VIEWPORT", True
    with temporary_scene(scene) as copy:
        shading.use_view_shading(copy, source)
        own = copy.display.shading
        assert (own.light, own.color_type, own.background_type, own.show_cavity) == (
            "FLAT",
            "SINGLE",
            "VIEWPORT",
            True,
        )
        assert tuple(own.single_color) == pytest.approx((0.1, 0.2, 0.3))
