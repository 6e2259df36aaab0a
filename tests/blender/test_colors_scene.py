"""Write the Colors: a copy of the scene for other renderers, and what they make of it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.reading.camera import export_camera
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.results import Kind

from .test_unchanged import snapshot

OPS = bpy.ops.reference_tracer


@pytest.fixture
def scene(build):
    """Solids of one colour each or two, an instance, one with a shear, and an infinite plane."""
    scene = build.scene(96, 54)
    build.solids()
    red = bpy.data.objects["Red"].data
    red.materials.append(build.material("Second", 0.7, 0.6, 0.1))
    for polygon in red.polygons:
        polygon.material_index = polygon.index % 2
    bpy.data.objects["Floor"].reference_tracer.infinite_plane = True
    parent = build.empty("Parent", scale=(1, 1, 2), rotation=(0.5, 0, 0))
    bpy.data.objects["Green"].parent = parent
    empty = build.empty("Empty", location=(-0.5, 0.5, 1.2), scale=(-1, 0.6, 1))
    empty.instance_type = "COLLECTION"
    kit = build.cube("Child", 0.5, link=False, material=build.material("White", 0.9, 0.9, 0.9))
    empty.instance_collection = build.collection("Kit", kit)
    build.corner_camera(lens=40, shift_x=0.05).data.dof.use_dof = True
    bpy.context.view_layer.update()
    return scene


def render_as_cycles(scene):
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01
    bpy.ops.render.render(scene=scene.name)


@pytest.mark.parametrize("colors", ["VIEWPORT", "OBJECT", "AUTOMATIC"])
def test_a_render_of_the_copy_agrees(colors, scene):
    scene.reference_tracer.colors = colors
    before = {o.name: (tuple(o.color), tuple(map(tuple, o.matrix_world))) for o in scene.objects}
    settings = snapshot(scene.render, 0)
    assert OPS.write_colors() == {"FINISHED"}
    assert snapshot(scene.render, 0) == settings
    after = {o.name: (tuple(o.color), tuple(map(tuple, o.matrix_world))) for o in scene.objects}
    assert after == before
    copy = bpy.data.scenes["Scene colors"]
    assert not {o.name for o in copy.objects} & before.keys()
    render_as_cycles(copy)
    with bpy.context.temp_override(scene=copy, view_layer=copy.view_layers[0]):
        OPS.compare()
        found = results.content(Kind.COMPARISON, copy)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    seen = found.frame.color[found.frame.instance_index >= 0]
    assert len(np.unique(seen, axis=0)) >= 5


def test_its_camera_is_where_it_was_between_two_frames(scene, build):
    """Whatever moves the user's: keys, a parent, a constraint, keys of its lens."""
    camera = scene.camera
    for frame, x, lens in ((1, 3.0, 30.0), (4, 6.0, 50.0)):
        camera.location.x, camera.data.lens = x, lens
        camera.keyframe_insert("location", frame=frame)
        camera.data.keyframe_insert("lens", frame=frame)
    camera.parent = build.empty("Crane", rotation=(0.1, 0.2, 0.3), scale=(1, 1, 2))
    camera.constraints.new("TRACK_TO").target = bpy.data.objects["Red"]
    scene.reference_tracer.renderer, scene.reference_tracer.filter = "RAYS", 1.5
    scene.frame_set(2, subframe=0.37)
    seen = export_camera(scene)
    OPS.write_colors()
    copy = bpy.data.scenes["Scene colors"]
    for frame in (2, 4):
        copy.frame_set(frame)
        own = export_camera(copy)
        assert np.allclose(own.world_from_camera, seen.world_from_camera, atol=1e-6)
        assert own.window == seen.window
    assert (copy.reference_tracer.renderer, copy.reference_tracer.filter) == ("RAYS", 1.5)


def test_colors_that_are_no_materials_are_refused(scene, build):
    scene.display.shading.color_type = "VERTEX"
    build.color_attribute(bpy.data.objects["Blue"], "POINT")
    count = len(bpy.data.scenes)
    scene.reference_tracer.colors = "VIEWPORT"
    with pytest.raises(RuntimeError, match=r"colour attribute.*Colors to Object"):
        OPS.write_colors()
    assert len(bpy.data.scenes) == count
    scene.reference_tracer.colors = "OBJECT"
    assert OPS.write_colors() == {"FINISHED"}
