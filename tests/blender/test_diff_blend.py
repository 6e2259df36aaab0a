"""`reftrace diff scene.blend export.glb`: what Blender's own exporters leave out is named."""

from __future__ import annotations

import bpy
import pytest

from .scenes import save


@pytest.fixture
def exported(build, tmp_path):
    """A .blend with a subdivided solid behind the camera, and Blender's exports of it."""
    build.room(32, 18, lens=40)
    bpy.ops.mesh.primitive_cube_add(location=(40, -60, 30))
    bpy.context.object.name = "Behind"
    modifier = bpy.context.object.modifiers.new("Levels", "SUBSURF")
    modifier.levels, modifier.render_levels = 1, 2
    save(tmp_path / "scene.blend")
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "plain.glb"))
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "applied.glb"), export_apply=True)
    bpy.ops.wm.obj_export(filepath=str(tmp_path / "render.obj"), export_eval_mode="DAG_EVAL_RENDER")
    return tmp_path


@pytest.mark.parametrize(
    ("name", "code", "said"),
    [
        ("plain.glb", 2, "modifiers are left out: 'Behind'"),
        ("applied.glb", 2, "modifiers are as in the viewport, not as in a render: 'Behind'"),
        ("render.obj", 0, "5 objects and 5 objects: the same"),
    ],
)
def test_what_exporters_leave_out_is_named(name, code, said, exported, reftrace):
    done = reftrace("diff", exported / "scene.blend", exported / name)
    assert done.returncode == code and said in done.stdout
