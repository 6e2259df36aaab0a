"""EEVEE as a judge: where its sample lies, and what it draws like for like.

Its shaders take a quarter of a minute to compile in software, so the scenes are `torture`.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.judges import JUDGES
from reference_tracer.blender.drawing.rasteriser import OFFSETS, covered, snapping_of
from reference_tracer.cli import in_blender
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.pictures.bounds import SNAPPING
from reference_tracer.pictures.palette import By
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import result_of

from . import hard_cases as hard
from .scenes import save

# Meshes that are drawn as they are edited, which EEVEE gives one material; and others.
_EDITED = "in Edit Mode, in one material"
REFUSED = {
    "edited": _EDITED,
    "edited_without_its_modifier": _EDITED,
    "edited_and_changed": _EDITED,
    "no_active_color": "shows a mesh black that lacks the colour attribute of another",
}

SAMPLES = sorted(p.stem for p in (Path(__file__).parents[2] / "sample_scenes").glob("*.blend"))
WIDTH = 128
EEVEE = JUDGES["eevee"]


@pytest.fixture
def solids(build):
    build.scene(96, 54, "OBJECT")
    build.solids()
    for number, obj in enumerate(bpy.data.objects):
        obj.color = (0.2 * number, 0.5, 1 - 0.2 * number, 1)
    build.corner_camera(lens=40)


def test_a_small_scene(solids, compare):
    """Its sample lies in the pixel's centre; a picture from beside the centre is not excused."""
    moved = np.stack((-OFFSETS, OFFSETS), axis=1).ravel()
    is_wrong = covered(EEVEE, moved, turned=True) != (moved > 0)
    assert np.abs(moved[is_wrong]).max(initial=0) <= SNAPPING
    assert snapping_of(EEVEE) == SNAPPING and EEVEE.sample_radius == 0
    found = compare(judge="EEVEE", identity=False)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    assert found.counts.differ <= 0.01 * found.counts.total
    assert found.case.picture.source.name == "eevee"
    assert set(np.unique(found.picture[..., 3])) == {0.0, 1.0}  # nothing is mixed
    aside = replace(found.case.picture, color=np.roll(found.picture, 1, axis=1))
    wrong = result_of(trace_and_compare(replace(found.case, picture=aside)))
    assert wrong.verdict == "differences" and wrong.counts.unexplained > 50


def test_every_engine_in_one_table(solids, tmp_path, capsys):
    """Here, as EEVEE's shaders are compiled once in a process."""
    save(tmp_path / "scene.blend")
    out = tmp_path / "out"
    assert in_blender.run(["compare", "--judge", "all", "--out", str(out)]) == 0
    found = json.loads((out / "engines.json").read_text(encoding="utf-8"))
    assert [row["engine"] for row in found["engines"]] == ["workbench", "cycles", "eevee"]
    assert found["verdict"] == "agree"
    assert {row["verdict"] for row in found["engines"]} == {"agree"}
    assert (out / "workbench/comparison.json").exists() and (out / "cycles/traced.png").exists()
    assert "verdict: agree" in capsys.readouterr().out


@pytest.mark.torture
@pytest.mark.parametrize("name", SAMPLES)
def test_a_sample_scene(name, opened, compare):
    opened(name, WIDTH)
    found = compare(judge="EEVEE")
    assert found.counts.unexplained == 0
    assert found.verdict == ("warnings" if name == "far_away" else "agree")


@pytest.fixture
def is_black(build, export):
    """Give what says whether EEVEE is known to show a mesh black; one has a colour attribute."""
    build.scene(48, 27, "VERTEX")
    build.color_attribute(build.cube("Own", 1.0), "POINT")
    build.corner_camera(lens=40)

    def refused() -> bool:
        scene, _ = export.render()
        try:
            EEVEE.check_colors(scene, "VERTEX", bpy.context.view_layer.objects)
        except SceneError as error:
            assert "shows a mesh black" in str(error)
            return True
        return False

    return refused


def test_what_is_not_drawn_needs_no_colour_attribute(is_black, build):
    hidden = build.cube("Hidden", 1.0)
    hidden.hide_render = True
    picture = build.empty("Picture")
    picture.empty_display_type = "IMAGE"
    picture.data = bpy.data.images.new("Reference", 4, 4)
    assert not is_black()
    build.color_attribute(hidden, "POINT").name = "Other"
    assert not is_black()
    hidden.hide_render = False
    assert is_black()


def test_what_stands_for_a_plane_has_no_colour_attribute(is_black, build):
    build.square("Plane", 1.0).reference_tracer.infinite_plane = True
    assert is_black()


def test_what_is_only_instanced_needs_a_colour_attribute(is_black, build):
    empty = build.empty("Instances", location=(1, 0, 0))
    empty.instance_type = "COLLECTION"
    child = build.cube("Child", 0.5, link=False)
    empty.instance_collection = build.collection("Kit", child)
    assert is_black()
    build.color_attribute(child, "POINT")
    assert not is_black()
    elsewhere = build.cube("Elsewhere", 0.5, link=False)
    build.color_attribute(elsewhere, "POINT").name = "Other"
    assert is_black()  # it may be instanced


@pytest.mark.torture
def test_a_colour_attribute_that_all_have(solids, build, compare):
    bpy.context.scene.display.shading.color_type = "VERTEX"
    for name in ("Floor", "Red", "Green", "Blue"):
        build.color_attribute(bpy.data.objects[name], "POINT")
    found = compare(judge="EEVEE", colors=By.VIEWPORT)
    assert found.counts.unexplained == 0 and found.verdict == "agree"


@pytest.mark.torture
@pytest.mark.parametrize("make", hard.ALL, ids=lambda make: make.__name__)
def test_a_hard_scene(make, build, compare):
    """What it draws otherwise than the solid viewport is explained, or said."""
    make(build)
    if make.__name__ in REFUSED:
        with pytest.raises(SceneError, match=REFUSED[make.__name__]):
            compare(judge="EEVEE")
    else:
        assert compare(judge="EEVEE").counts.unexplained == 0


def test_a_mesh_in_edit_mode_is_refused_where_it_has_several_materials(build, compare):
    make = next(make for make in hard.ALL if make.__name__ == "edited")
    make(build)
    with pytest.raises(SceneError, match="leave Edit Mode"):
        compare(judge="EEVEE")
