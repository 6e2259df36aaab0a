"""What is hidden, in which mode, and the reason that the manifest gives for it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

MODES = ("VIEWPORT", "RENDER")


def hide_viewport(obj, collection, layer):
    obj.hide_viewport = True


def hide_render(obj, collection, layer):
    obj.hide_render = True


def eye(obj, collection, layer):
    obj.hide_set(True)


def collection_viewport(obj, collection, layer):
    collection.hide_viewport = True


def collection_render(obj, collection, layer):
    collection.hide_render = True


def collection_eye(obj, collection, layer):
    layer.hide_viewport = True


def excluded(obj, collection, layer):
    layer.exclude = True


BOTH, NONE = set(MODES), set()
CASES = {  # how, in which modes it hides, a word of the reason
    hide_viewport: ({"VIEWPORT"}, "hidden in the viewport"),
    hide_render: ({"RENDER"}, "hidden in renders"),
    eye: ({"VIEWPORT"}, "view layer"),
    collection_viewport: ({"VIEWPORT"}, "collection"),
    collection_render: ({"RENDER"}, "collection"),
    collection_eye: ({"VIEWPORT"}, "collection"),
    excluded: (BOTH, "excluded"),
}


@pytest.mark.parametrize("hide", CASES, ids=lambda hide: hide.__name__)
@pytest.mark.parametrize("mode", MODES)
def test_hidden_objects_are_skipped_with_the_reason(mode, hide, build, export, entries, compare):
    """What Workbench draws is what was exported for it."""
    build.scene()
    build.camera()
    build.square("Shown")
    red = build.material("Red", 1, 0, 0)
    cube = build.cube("Hidden", link=False, location=(1, 0, 0), material=red)
    collection = build.collection("Collection", cube, link=True)
    hide(cube, collection, bpy.context.view_layer.layer_collection.children["Collection"])
    bpy.context.view_layer.update()
    scene, manifest = export.modes[mode]()
    found = entries(manifest)
    assert set(found) == {"Camera", "Hidden", "Shown"}
    modes, reason = CASES[hide]
    if mode in modes:
        assert scene.objects == ("Shown",)
        assert not found["Hidden"].exported
        assert reason in found["Hidden"].reason
        assert f"  skipped Hidden (MESH): {found['Hidden'].reason}" in manifest.lines()
    else:
        assert set(scene.objects) == {"Hidden", "Shown"}
        assert (found["Hidden"].exported, found["Hidden"].reason) == (True, "")
    if mode == "RENDER":
        comparison = compare()
        assert comparison.counts.unexplained == 0 and comparison.verdict == "agree"
        assert len(np.unique(comparison.frame.object_index)) == (2 if mode in modes else 3)


@pytest.mark.parametrize("use", [True, False], ids=["used", "not_used_for_rendering"])
def test_the_compared_view_layer_is_the_active_one(use, build, compare):
    scene = build.scene()
    build.camera()
    build.collection("First", build.cube("In First", link=False), link=True)
    build.collection("Second", build.square("In Second", 1, link=False), link=True)
    second = scene.view_layers.new("Other")
    second.layer_collection.children["First"].exclude = True
    second.use = use
    bpy.context.window.view_layer = second
    comparison = compare()
    assert comparison.manifest.view_layer == "Other"
    assert comparison.scene.objects == ("In Second",)
    assert comparison.verdict == "agree"
    assert comparison.picture.any()


@pytest.mark.parametrize("display", ["WIRE", "BOUNDS", "SOLID", "TEXTURED"])
@pytest.mark.parametrize("mode", MODES)
def test_display_type_matters_in_the_viewport_alone(mode, display, build, export, entries):
    build.camera()
    build.cube().display_type = display
    scene, manifest = export.modes[mode]()
    drawn = mode == "RENDER" or display in ("SOLID", "TEXTURED")
    assert entries(manifest)["Cube"].exported == drawn
    assert bool(scene.instances) == drawn
    assert [(u.object, u.feature) for u in manifest.unmodelled] == (
        [] if drawn else [("Cube", "display type")]
    )
