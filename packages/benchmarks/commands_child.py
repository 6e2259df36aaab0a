"""Makes what the table of commands needs of Blender: files, and the time of F12.

`make SUZANNE.blend FOLDER` writes the files; `f12 FILE all|none` renders with all passes or with
the picture alone, and prints CPU seconds in its last line.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

import bpy
import reference_tracer

from . import scenes
from .blender_child import open_scene


def make(suzanne: str, folder: str) -> None:
    """Write a cube, a mesh of 1.3 million triangles, and Suzanne in a shading that is not ours."""
    import trimesh

    out = Path(folder)
    mesh = scenes.mesh_of("cube", out)
    open_scene(scenes.build(mesh, 1920, 1080, "perspective"))
    bpy.ops.wm.save_as_mainfile(filepath=str(out / "cube.blend"))
    bpy.ops.wm.open_mainfile(filepath=suzanne)
    shading = bpy.context.scene.display.shading
    shading.show_xray, shading.light = True, "FLAT"  # in another light, colours would be excused
    bpy.ops.wm.save_as_mainfile(filepath=str(out / "xray.blend"))
    trimesh.creation.icosphere(8).export(out / "mesh.ply")


def f12(path: str, passes: str) -> None:
    """Render twice at 1920 x 1080; of the first, a part is what a process does once."""
    bpy.ops.wm.open_mainfile(filepath=path)
    scene = bpy.context.scene
    scene.render.engine = "REFERENCE_TRACER"
    scene.render.resolution_x, scene.render.resolution_y = 1920, 1080
    scene.render.resolution_percentage = 100
    for layer in scene.view_layers:
        chosen = layer.reference_tracer
        every = {item.identifier for item in chosen.bl_rna.properties["passes"].enum_items_static}
        chosen.passes = every if passes == "all" else set()
    for _ in range(2):
        began = time.process_time()
        bpy.ops.render.render()
        seconds = time.process_time() - began
    print(seconds, flush=True)


if __name__ == "__main__":
    reference_tracer.register()
    do, *rest = sys.argv[1:]
    {"make": make, "f12": f12}[do](*rest)
