"""What a 3D view shows, exported again after an edit: the same as a whole export, read once."""

from __future__ import annotations

import bpy
import numpy as np
from reference_tracer.blender.reading.visible import types_left_out

from .live import assert_as_a_whole_export, of_view, space


def test_a_mesh_in_the_editor_is_read_every_time(build, kept):
    build.far_camera()
    bpy.context.view_layer.objects.active = cube = build.cube()
    bpy.ops.object.mode_set(mode="EDIT")
    for size in (1, 2):
        bpy.ops.mesh.primitive_cube_add(size=size)
        assert_as_a_whole_export(kept)
        build.square(f"Beside {size}")
        assert_as_a_whole_export(kept)
        assert kept.meshes_read == 2
        assert of_view(kept).triangle_count == 12 * (size + 1) + 2 * size
    bpy.ops.object.mode_set(mode="OBJECT")
    assert_as_a_whole_export(kept)
    cube.location.x = 1
    assert_as_a_whole_export(kept)
    assert kept.meshes_read == 0


def test_a_view_shows_the_colors_of_a_render_and_its_own_background(build, kept):
    build.far_camera()
    cube = build.cube(material=build.material("Red", 1, 0, 0), color=(0, 1, 0, 1))
    build.color_attribute(cube, "CORNER")
    bpy.context.view_layer.update()
    view, scene = space(), bpy.context.scene
    depsgraph = bpy.context.evaluated_depsgraph_get()
    shading = scene.display.shading
    view.shading.color_type = "RANDOM"  # of solid mode, without a say

    def shown():
        assert kept.outdated(scene, view)
        kept.update(depsgraph, view)
        assert not kept.outdated(scene, view)
        return of_view(kept)

    shading.color_type = "OBJECT"
    assert shown().instances[0].colors.tolist() == [[0, 1, 0, 1]]
    shading.color_type = "SINGLE"
    shading.single_color = (0, 0, 1)
    assert shown().instances[0].colors.tolist() == [[0, 0, 1, 1]]
    assert kept.meshes_read == 0
    shading.color_type = "VERTEX"
    assert shown().meshes[0].corner_colors is not None
    shading.color_type = "MATERIAL"
    assert shown().meshes[0].corner_colors is None
    assert of_view(kept).background.tolist() == [0, 0, 0, 0]  # Blender's own is behind it
    view.shading.background_type = "VIEWPORT"
    view.shading.background_color = (0.25, 0.5, 1)
    assert shown().background.tolist() == [0.25, 0.5, 1, 1]


def test_types_that_a_view_leaves_out(build, kept):
    """Of a text and of instances it is the type of what is drawn that counts, not of its owner."""
    build.far_camera()
    build.cube()
    build.text()
    kit = build.collection("Kit", build.square("In Kit", link=False))
    empty = build.instances("Empty", kit)
    bpy.context.view_layer.update()
    view, depsgraph = space(), bpy.context.evaluated_depsgraph_get()
    assert [i.name for i in depsgraph.ids]  # looked at: see test_export
    for kind, shown in (
        ("mesh", set()),
        ("empty", {"Cube", "Text", "In Kit"}),
        ("font", {"Cube", "Text", "In Kit"}),
        ("light", {"Cube", "Text", "In Kit"}),
    ):
        setattr(view, f"show_object_viewport_{kind}", False)
        assert kept.outdated(bpy.context.scene, view)
        kept.update(depsgraph, view)
        assert set(of_view(kept).objects) == shown
        setattr(view, f"show_object_viewport_{kind}", True)
    bpy.context.scene.collection.objects.unlink(empty)
    build.collection("Hidden", empty, link=True)
    bpy.context.view_layer.layer_collection.children["Hidden"].hide_viewport = True
    view.show_object_viewport_empty = False
    bpy.context.view_layer.update()
    assert set(of_view(kept).objects) == {"Cube", "Text"}


def test_every_type_can_be_left_out(monkeypatch):
    """Also by a filter that does not bear the type's own name, as of a grease pencil."""
    view, types = space(), bpy.types.Object.bl_rna.properties["type"].enum_items.keys()
    for name in (n for n in dir(view) if n.startswith("show_object_viewport_")):
        monkeypatch.setattr(view, name, False)
    assert types_left_out(view) == set(types)


def test_all_is_read_after_a_failure(build, kept, monkeypatch):
    build.far_camera()
    cube, square = build.cube(), build.square()
    assert_as_a_whole_export(kept)
    square.display_type = "WIRE"
    with monkeypatch.context() as context:
        context.setattr("reference_tracer.blender.live.scene.visible", lambda *_: 1 / 0)
        bpy.context.view_layer.update()  # Blender prints what a handler raises
    cube.location.x = 1
    assert_as_a_whole_export(kept)
    assert of_view(kept).objects == ("Cube",)


def test_what_the_picture_lacks_is_said(build, kept):
    build.far_camera()
    build.cube().show_in_front = True
    build.square().data.vertices[0].co.x = np.nan
    bpy.context.view_layer.update()
    assert kept.lines == (
        "2 triangles of 'Square' left out",
        "not modelled: in-front drawing of 'Cube'",
    )
