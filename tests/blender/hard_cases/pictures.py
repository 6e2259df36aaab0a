"""Pictures as a whole: empty, fine, of lenses and of scales."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from .stage import CYAN, ORANGE, PINK, colored, stage


def camera_looks_away(build: Any) -> None:
    stage(build).camera.rotation_euler = (np.pi, 0, 0)


def all_hidden(build: Any) -> None:
    for obj in stage(build).objects:
        if obj.type == "MESH":
            obj.hide_render = obj.hide_viewport = True


def all_behind(build: Any) -> None:
    camera = stage(build).camera
    camera.rotation_euler.rotate_axis("Y", np.pi)


def no_mesh(build: Any) -> None:
    build.scene()
    build.camera()
    build.empty("Empty")


EMPTY = (camera_looks_away, all_hidden, all_behind, no_mesh)


def fine_edges(build: Any) -> None:
    """Arrays of arrays, mirrored and subdivided: edges in thousands of pixels."""
    stage(build, width=320, height=180)
    for n, rgb in enumerate((ORANGE, CYAN, PINK)):
        obj = build.cube(
            f"Beads {n}",
            0.2,
            location=(0, -0.6, 0.3 * n),
            rotation=(0.3 * n, 0.2, 0.4 * n),
            material=colored(build, f"Beads {n}", rgb),
        )
        for axis in range(2):
            array = obj.modifiers.new("Array", "ARRAY")
            array.count = 6
            array.relative_offset_displace = (1.4, 0, 0) if axis else (0, 1.4, 0)
        mirror = obj.modifiers.new("Mirror", "MIRROR")
        mirror.use_axis = (True, True, False)
        smooth = obj.modifiers.new("Subdivision", "SUBSURF")
        smooth.levels = smooth.render_levels = 2


def depth_of_field(build: Any) -> None:
    camera = stage(build).camera.data
    camera.dof.use_dof, camera.dof.focus_distance = True, 2
    camera.dof.aperture_fstop = 0.2
    bpy.context.scene.display.shading.use_dof = True


def motion_blur(build: Any) -> None:
    scene = stage(build)
    cube = bpy.data.objects["Red"]
    for frame, x in ((1, -2.0), (9, 2.0)):
        cube.location.x = x
        cube.keyframe_insert("location", frame=frame)
    scene.render.use_motion_blur = True
    scene.frame_set(4)


def freestyle(build: Any) -> None:
    stage(build).render.use_freestyle = True


def multiview(build: Any) -> None:
    render = stage(build).render
    render.use_multiview, render.views_format = True, "STEREO_3D"


def x_ray(build: Any) -> None:
    stage(build).display.shading.show_xray = True


def backface_culling(build: Any) -> None:
    stage(build).display.shading.show_backface_culling = True


def mist(build: Any) -> None:
    scene = stage(build)
    scene.world = bpy.data.worlds.new("World")
    scene.world.mist_settings.use_mist = True


def compositor(build: Any) -> None:
    stage(build)
    build.compositor()


def sequencer(build: Any) -> None:
    stage(build)
    build.sequencer()


# What the temporary scene switches off, or Workbench does not draw; and what it is called.
SWITCHED_OFF = {
    depth_of_field: "depth of field",
    motion_blur: "motion blur",
    freestyle: "freestyle lines",
    multiview: "multiview",
    x_ray: "x-ray shading",
    backface_culling: "backface culling",
    mist: "mist",
    compositor: "compositor",
    sequencer: "sequencer",
}


def far_from_origin(build: Any) -> None:
    for obj in stage(build).objects:
        obj.location.x += 1e5


def _scaled(build: Any, factor: float) -> None:
    """Meshes of one size, shown in another by their objects' scale, and a camera to match."""
    scene = stage(build)
    for obj in scene.objects:
        obj.location *= factor
        if obj.type == "MESH":
            obj.scale *= factor
    camera = scene.camera.data
    camera.clip_start, camera.clip_end = 0.1 * factor, 100 * factor


def tiny(build: Any) -> None:
    _scaled(build, 1e-3)


def huge(build: Any) -> None:
    _scaled(build, 1e3)


SCALED = (tiny, huge)
