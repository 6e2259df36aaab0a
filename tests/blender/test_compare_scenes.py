"""Blender as the judge: sample scenes and camera settings against Workbench, 0 unexplained."""

from __future__ import annotations

import json
from pathlib import Path

import bpy
import numpy as np
import pytest
from reference_tracer.report.lines import describe

from .scenes import HALF_FLOAT

NAMES = sorted(
    path.stem for path in (Path(__file__).resolve().parents[2] / "sample_scenes").glob("*.blend")
)
FILES = [
    "blender.png",
    "comparison.json",
    "difference.png",
    "frame.npz",
    "page.html",
    "traced.png",
]
WIDTH = 240  # pixels: every scene is made smaller, to keep the tests quick
# Share of pixels that may differ at all: edges of one or two pixels, by the scenes' own look.
MAY_DIFFER = 0.01
NOT_DECIDABLE = {"far_away"}


@pytest.mark.parametrize("name", NAMES)
def test_sample_scene_has_no_unexplained_pixel(name, opened, tmp_path):
    opened(name, WIDTH)
    assert bpy.ops.reference_tracer.compare(directory=str(tmp_path)) == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.iterdir()) == FILES
    found = json.loads((tmp_path / "comparison.json").read_text(encoding="utf-8"))
    pixels = found["pixels"]
    assert pixels["unexplained"] == 0
    assert found["certificate"]["passed"]
    identity = found["identity"]["pixels"]
    assert identity["not_known"] == 0
    assert identity["other_object"] <= MAY_DIFFER * pixels["total"]
    assert pixels["differ"] <= MAY_DIFFER * pixels["total"]
    assert found["scene"]["unmodelled"] == []
    undecided = name in NOT_DECIDABLE
    assert (pixels["not_decidable"] > 0) == undecided
    assert found["verdict"] == ("warnings" if undecided else "agree")


@pytest.mark.parametrize(
    ("name", "width"),
    [("exercise_orthographic", 71), ("exercise_orthographic", 135), ("shifted_room", 80)],
)
def test_the_edge_of_a_solid_that_stands_on_another(name, width, opened, compare):
    """Within a sample's error of the edge, the solid's underside lies as near as what it is on."""
    opened(name, width)
    assert compare().verdict == "agree"


def test_blenders_picture_is_its_own(opened, compare, workbench):
    """What was compared is what Workbench itself draws of the user's scene with flat light."""
    opened("suzanne", 96)
    picture = compare().picture
    scene = bpy.context.scene
    scene.render.film_transparent = True
    drawn = workbench(
        light="FLAT",
        show_shadows=False,
        show_cavity=False,
        show_object_outline=False,
        show_specular_highlight=False,
        render_aa="OFF",
    )
    np.testing.assert_allclose(picture, drawn, rtol=0, atol=HALF_FLOAT)


def pixel_aspect(build):
    bpy.context.scene.render.pixel_aspect_x = 1.7
    build.corner_camera(lens=40)


def mirrored(build):
    build.corner_camera(lens=40).scale = (-1, 1, 1)


def clipped(build):
    build.corner_camera(lens=40, clip_start=4.6, clip_end=6.7)


def through_the_eye(build):
    """The floor's triangles cross the plane of the eye."""
    build.camera((-2.4, -1.6, -0.4), (1.5, 0, -1.05), lens=18, clip_start=0.01)


@pytest.mark.parametrize(
    "setting",
    [
        pixel_aspect,
        mirrored,
        clipped,
        through_the_eye,
    ],
    ids=lambda setting: setting.__name__,
)
def test_camera_setting_has_no_unexplained_pixel(setting, build, compare):
    """Such as change more than where the rays are: test_camera.py has these."""
    build.scene(160, 90)
    build.solids()
    setting(build)
    comparison = compare()
    pixels = comparison.counts
    assert pixels.unexplained == pixels.not_decidable == 0
    assert pixels.differ <= 0.01 * pixels.total
    assert comparison.verdict == "agree"
    seen = {comparison.scene.objects[i] for i in np.unique(comparison.frame.object_index) if i >= 0}
    assert len(seen) >= 2  # or nothing would have been compared


def test_an_empty_scene_is_a_valid_picture_and_a_warning(build, compare):
    build.scene()
    build.camera()
    comparison = compare()
    assert comparison.verdict == "warnings"
    assert "the picture is empty: no ray meets anything" in describe(comparison)
    assert comparison.counts.agree == comparison.counts.total == 96 * 54
    assert not comparison.frame.color.any()
