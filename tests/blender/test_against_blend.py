"""`reftrace compare scene.blend --against`: pictures of Blender's, made otherwise than traced."""

from __future__ import annotations

import json

import bpy
import pytest
from reference_tracer.files import images


@pytest.fixture
def scene(build):
    scene = build.room(96, 54, lens=40)
    scene.display.shading.light = "FLAT"
    scene.display.shading.show_specular_highlight = False
    scene.display.render_aa = "OFF"
    scene.render.film_transparent = True
    scene.render.engine = "BLENDER_WORKBENCH"
    return scene


@pytest.fixture
def drawn(scene, tmp_path):
    """Press F12 in the open file; leaves a PNG as the user would save it."""

    def run(mode="RGBA", depth="8", **view):
        for name, value in view.items():
            setattr(scene.view_settings, name, value)
        image = scene.render.image_settings
        if hasattr(image, "media_type"):
            image.media_type = "IMAGE"
        image.file_format, image.color_mode, image.color_depth = "PNG", mode, depth
        scene.render.filepath = str(tmp_path / "drawn.png")
        bpy.ops.render.render(write_still=True)

    return run


@pytest.fixture
def judged(tmp_path, reftrace):
    """Save the open file, and compare it with the picture as the command does."""

    def run(*options):
        blend, picture, out = (tmp_path / name for name in ("scene.blend", "drawn.png", "out"))
        bpy.ops.wm.save_as_mainfile(filepath=str(blend))
        done = reftrace("compare", blend, "--against", picture, "--out", out, *options)
        found = json.loads((out / "comparison.json").read_text(encoding="utf-8"))
        return done.returncode, found, done.stdout

    return run


def test_blenders_own_png_of_a_plain_view(scene, drawn, judged):
    drawn(view_transform="Standard")
    code, found, _ = judged()
    assert found["pixels"]["unexplained"] == 0
    assert code == 0 and found["verdict"] == "agree" and found["transform"] == ""


@pytest.mark.parametrize("engine", ["BLENDER_WORKBENCH", "REFERENCE_TRACER", "CYCLES"])
def test_the_engine_that_a_blend_is_set_to_is_not_the_pictures(engine, scene, drawn, judged):
    scene.render.engine = engine
    scene.cycles.samples = 1
    drawn(view_transform="Standard")
    _, found, text = judged("--no-diagnosis")
    assert found["blender"]["renderer"] == "rays"  # whose rounding excuses the least
    assert f", {found['blender']['renderer_known']} (--excuse renderer)" in text


@pytest.mark.parametrize("mode", ["RGB", "RGBA"])
def test_blenders_own_png_of_16_bits(mode, scene, drawn, judged, tmp_path):
    scene.render.film_transparent = mode == "RGBA"
    drawn(mode, "16", view_transform="Standard")
    assert images.open_picture(tmp_path / "drawn.png").read().levels == 65535
    code, found, _ = judged()
    assert code == 0 and found["pixels"]["agree"] == found["pixels"]["total"]


def of_the_output(scene):
    """What is saved goes through the output's own view settings, if these override the scene's."""
    settings = scene.render.image_settings
    settings.color_management = "OVERRIDE"
    settings.view_settings.view_transform = "Filmic"
    settings.view_settings.exposure = -1.0
    return {"view_transform": "Standard"}


@pytest.mark.parametrize("is_there_still", [True, False])
@pytest.mark.parametrize(
    ("view", "named"),
    [
        ({"view_transform": "Filmic"}, "the view transform 'Filmic'"),
        ({"view_transform": "AgX"}, "the view transform 'AgX'"),
        ({"view_transform": "Standard", "exposure": -1.0}, "exposure -1"),
        ({"view_transform": "Standard", "gamma": 1.5}, "gamma 1.5"),
        (of_the_output, "'Filmic' with exposure -1"),
    ],
)
def test_a_view_transform_is_named(view, named, is_there_still, scene, drawn, judged):
    """Also where the picture went through one that the scene no longer has."""
    drawn(**(view if isinstance(view, dict) else view(scene)))
    if not is_there_still:
        scene.view_settings.view_transform = "Standard"
    code, found, text = judged()
    assert named in found["transform"]
    assert found["pixels"]["unexplained"] == 0 and code == 1
    assert found["pixels"]["by_cause"]["color"] > 500
    assert f"colours: {found['transform']}" in text


def test_an_object_that_only_the_viewport_hides(scene, drawn, judged):
    """The picture is of the scene without it, as the viewport has it."""
    bpy.data.objects["Green"].hide_render = True
    drawn(view_transform="Standard")
    bpy.data.objects["Green"].hide_render = False
    bpy.data.objects["Green"].hide_viewport = True
    code, found, text = judged()
    assert found["hidden"] == [{"object": "Green", "reason": "hidden in the viewport"}]
    assert found["pixels"]["unexplained"] == 0 < found["pixels"]["by_cause"]["hidden"]
    assert code == 1 and "only one side shows 'Green': hidden in the viewport" in text


def test_objects_before_one_another_that_renders_do_not_have(scene, drawn, judged):
    """Neither alone is what the picture shows."""
    front = bpy.data.objects["Green"].copy()
    front.name = "Front"
    front.location = bpy.data.objects["Green"].location.lerp(scene.camera.location, 0.15)
    front.location.z += 0.5
    front.color = (0.1, 0.1, 0.9, 1)
    scene.collection.objects.link(front)
    drawn(view_transform="Standard")
    for name in ("Green", "Front"):
        bpy.data.objects[name].hide_render = True
    _, found, _ = judged()
    assert "Green" in str(found["hidden"]) and "Front" in str(found["hidden"])
    assert found["pixels"]["unexplained"] == 0


def test_an_object_that_is_gone_without_a_reason(scene, drawn, judged):
    drawn(view_transform="Standard")
    bpy.data.objects.remove(bpy.data.objects["Green"])
    code, found, _ = judged()
    assert code == 2 and found["hidden"] == [] and found["pixels"]["unexplained"] > 50


def test_the_wrong_frame(scene, drawn, judged):
    cube = bpy.data.objects["Red"]
    for frame, x in ((1, 0.0), (2, 0.4), (3, 0.8)):
        cube.location.x = x - 1.1
        cube.keyframe_insert("location", frame=frame)
    scene.frame_set(2)
    drawn(view_transform="Standard")
    scene.frame_set(1)
    code, found, _ = judged()
    assert [h["reason"] for h in found["hidden"]] == [
        "the picture is of frame 2, the scene is at 1"
    ]
    assert found["pixels"]["unexplained"] == 0 and code == 1
