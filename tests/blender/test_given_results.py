"""The Render Result is judged by what is known of the engine that rendered it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.engine import ENGINE
from reference_tracer.blender.reading import rendered
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.blender.versions import set_format
from reference_tracer.scene import SceneError

from .given import rendered_png, solids, toy

__all__ = ["rendered_png", "solids", "toy"]  # fixtures
OPS = bpy.ops.reference_tracer


def test_a_result_has_no_excuse_of_a_rasteriser_that_did_not_render_it(
    toy, rendered_png, solids, compare
):
    """An add-on's engine, or one that is not known, as it was rendered before the add-on heard."""

    def renderer(says_what_to_do=False):
        found = compare(judge="RENDER_RESULT", diagnose=False)
        assert found.verdict == "agree"
        assert ("render again with F12" in str(found.manifest.notes)) == says_what_to_do
        return found.case.picture.sampling.renderer.name, found.case.picture.source.known

    unknown = "rays", "as Blender wrote it, but nothing says that it was rasterised"
    rendered_png()
    assert renderer() == ("raster", "as Blender wrote it, and its engine is BLENDER_WORKBENCH")
    rendered.forget()
    assert renderer(says_what_to_do=True) == unknown
    made_by = compare(judge="RENDER_RESULT", diagnose=False, renderer="raster")
    assert not made_by.manifest.notes
    solids.render.engine = "TOY_TRACER"
    bpy.ops.render.render()
    solids.render.engine = "BLENDER_WORKBENCH"
    compare(judge="WORKBENCH")  # which renders a copy of the scene
    assert renderer() == unknown


def test_the_engine_of_a_result_goes_with_its_scene(rendered_png, solids):
    """Not with its name, which another scene may have by the time that it is compared."""
    rendered_png()
    name, solids.name = solids.name, "Renamed"
    other = bpy.data.scenes.new(name)
    assert rendered.engine_of_result(solids) == "BLENDER_WORKBENCH"
    assert rendered.engine_of_result(other) == ""


def test_the_engine_of_a_result_goes_with_its_slot(rendered_png, solids, compare):
    """Another slot may show what another engine rendered before: that has no excuse of this one."""
    rendered_png()
    slots = rendered.result_image().render_slots
    alone = {"judge": "RENDER_RESULT", "diagnose": False}
    assert compare(**alone).case.picture.sampling.renderer.name == "raster"
    slots.active_index = 1
    rendered_png()
    assert compare(**alone).case.picture.sampling.renderer.name == "raster"
    slots.active_index = 0
    try:
        found = compare(**alone)
    finally:
        slots.active_index = 0
    assert found.verdict == "agree" and found.case.picture.sampling.renderer.name == "rays"
    assert "which engine rendered it is not known" in str(found.manifest.notes)


def test_a_result_of_no_engine_has_no_excuse_of_the_last_one(rendered_png, solids, compare):
    """The Sequencer draws its strips, as View > Render draws a 3D view: no engine is asked."""
    rendered_png()
    alone = {"judge": "RENDER_RESULT", "diagnose": False}
    assert compare(**alone).case.picture.sampling.renderer.name == "raster"
    editor = solids.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    several = {"length": 9} if bpy.app.version >= (5, 0) else {"frame_end": 9}
    strips.new_effect("Red", "COLOR", channel=1, frame_start=1, **several)
    rendered_png()
    assert rendered.engine_of_result(solids) == "BLENDER_WORKBENCH"  # all that is heard
    found = compare(**alone)
    assert found.verdict == "differences" and found.case.picture.sampling.renderer.name == "rays"
    [drawn, unknown] = [note for note in found.manifest.notes if "of the picture" in note]
    assert "no engine rendered it, but a 3D view (View > Render) or the Sequencer" in drawn
    assert "render again with F12" in unknown and "choose Made By" in unknown


@pytest.mark.parametrize("kind", ["PNG", "OPEN_EXR"])
def test_the_render_result_leaves_the_output_settings(kind, rendered_png, solids):
    """A scene may save by another color management than it shows."""
    rendered_png()
    set_format(solids.render, kind, "RGB", "16")
    solids.reference_tracer.judge = "RENDER_RESULT"
    settings = solids.render.image_settings
    settings.color_management = "OVERRIDE"
    settings.linear_colorspace_settings.name = "ACEScg"
    view = settings.view_settings
    view.view_transform, view.exposure, view.use_curve_mapping = "Filmic", 2.0, True
    view.curve_mapping.curves[0].points.new(0.25, 0.75)

    def set_now():
        points = [tuple(p.location) for curve in view.curve_mapping.curves for p in curve.points]
        own = settings.color_management, settings.linear_colorspace_settings.name
        form = settings.file_format, settings.color_mode, settings.color_depth
        return form, own, view.view_transform, view.exposure, view.use_curve_mapping, points

    before = set_now()
    OPS.compare()
    assert results.content(Kind.COMPARISON, solids).verdict == "agree"
    assert set_now() == before


def test_a_result_of_another_view_layer_is_told(rendered_png, solids, compare):
    """Of several view layers it shows the first; the one that is active is traced."""
    first = solids.view_layers[0]
    other = solids.view_layers.new("Other")
    solids.collection.objects.unlink(solids.objects["Green"])
    solids.collection.children.link(own := bpy.data.collections.new("Own"))
    own.objects.link(bpy.data.objects["Green"])
    other.layer_collection.children["Own"].exclude = True
    rendered_png()
    solids.reference_tracer.judge = "RENDER_RESULT"

    def told(layer):
        with bpy.context.temp_override(scene=solids, view_layer=layer):
            found = compare(diagnose=False)
        return found.verdict, [n for n in found.manifest.notes if "the picture" in n]

    assert told(first) == ("agree", [])
    verdict, [note] = told(other)
    assert verdict == "differences"
    assert note == f"of the picture: it shows the view layer '{first.name}', and 'Other' was traced"
    first.use = False
    rendered_png()
    assert told(other) == ("agree", [])


def test_metadata_that_is_burned_in_is_told(rendered_png, solids, compare):
    solids.render.use_stamp = True
    rendered_png()
    found = compare(judge="RENDER_RESULT", diagnose=False)
    assert found.verdict == "differences"
    assert "of the picture: metadata is burned into it" in found.manifest.notes


def test_a_stereo_result_is_refused(rendered_png, solids, compare):
    solids.render.use_multiview = True
    rendered_png()
    settings = solids.render.image_settings
    settings.views_format = "STEREO_3D"
    for is_on in (True, False):
        solids.render.use_multiview = is_on
        with pytest.raises(SceneError, match="stereo Render Result: switch off Stereoscopy"):
            compare(judge="RENDER_RESULT")
    assert settings.views_format == "STEREO_3D"
    rendered_png()
    assert compare(judge="RENDER_RESULT").verdict == "agree"


def test_without_a_render_there_is_no_result(solids):
    solids.reference_tracer.judge = "RENDER_RESULT"
    with pytest.raises(RuntimeError, match="no Render Result: render it first"):
        OPS.compare()


@pytest.mark.parametrize(("colors", "number"), [("AUTOMATIC", 2), ("OBJECT", 2), ("VIEWPORT", 1)])
def test_a_render_tells_grey_objects_apart_as_a_comparison_does(colors, number, build, capfd):
    """F12 of a new scene, whose objects share a colour; and it agrees with what was rendered."""
    scene = build.scene(96, 54)
    scene.render.film_transparent = True
    scene.display.shading.color_type = "MATERIAL"
    for name, x in (("Left", -1.5), ("Right", 0.5)):
        corners = [(x, 5, -1), (x + 1, 5, -1), (x + 1, 5, 1), (x, 5, 1)]
        build.mesh(name, corners, [(0, 1, 2, 3)])
    build.camera((0, 0, 0), (np.pi / 2, 0, 0))
    stored = scene.reference_tracer
    stored.colors = colors
    stored.judge = "RENDER_RESULT"
    scene.render.engine = ENGINE
    bpy.ops.render.render()
    said = capfd.readouterr()
    told = "the viewport's colours do not tell 'Left' from 'Right'" in said.out + said.err
    assert told == (colors == "AUTOMATIC")
    OPS.compare()
    found = results.content(Kind.COMPARISON, scene)
    seen = found.picture[found.picture[..., 3] > 0]
    assert len(np.unique(seen, axis=0)) == number
    assert found.verdict == "agree" and found.counts.differ == 0
