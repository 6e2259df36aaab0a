"""`reftrace diff scene.blend export.glb`: what Blender's own exporters leave out is named."""

from __future__ import annotations

import bpy
import pytest
from reference_tracer.blender import registration
from reference_tracer.cli.main import main


@pytest.fixture
def exported(build, tmp_path):
    """A .blend with a subdivided solid behind the camera, and Blender's exports of it."""
    build.scene(32, 18)
    build.solids()
    build.corner_camera(lens=40)
    bpy.ops.mesh.primitive_cube_add(location=(40, -60, 30))
    bpy.context.object.name = "Behind"
    modifier = bpy.context.object.modifiers.new("Levels", "SUBSURF")
    modifier.levels, modifier.render_levels = 1, 2
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "plain.glb"))
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "applied.glb"), export_apply=True)
    bpy.ops.wm.obj_export(filepath=str(tmp_path / "render.obj"), export_eval_mode="DAG_EVAL_RENDER")
    return tmp_path


def test_what_exporters_leave_out_is_named(exported, addon, capsys):
    registration.unregister()  # the command registers by itself, in a process of its own
    try:
        for name, code, said in (
            ("plain.glb", 2, "modifiers are left out: 'Behind'"),
            ("applied.glb", 2, "modifiers are as in the viewport, not as in a render: 'Behind'"),
            ("render.obj", 0, "5 objects and 5 objects: the same"),
        ):
            command = ["diff", str(exported / "scene.blend"), str(exported / name)]
            assert main(command) == code, capsys.readouterr().out
            assert said in capsys.readouterr().out
    finally:
        registration.register()
