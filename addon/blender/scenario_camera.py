"""`scene.Camera` -> Blender's camera: the way back of `camera.py`, as far as Blender has one."""

from __future__ import annotations

from typing import Any

import bpy
from mathutils import Matrix

from ..scene import Camera, ViewWindow
from .camera import resolution, view_window

LEAST_CLIP = 1e-6  # metres: Blender's own limit
_SENSOR = 36.0  # millimetres; what Blender's own cameras have
_LEAST = 1.0  # millimetres: Blender's least focal length


def add_camera(scene: Any, camera: Camera) -> Any:
    """Add a camera to a Blender scene, make it the active one, and set the picture's size.

    Blender itself sets what it cannot have to the nearest that it can, such as a pixel's shape of
    more than 200 to 1 or a clip start below `LEAST_CLIP`: `shown_window` says what is shown.
    """
    w = camera.window
    extent = w.right - w.left
    render, data = scene.render, bpy.data.cameras.new(camera.name)
    render.resolution_x, render.resolution_y = camera.width, camera.height
    render.resolution_percentage = 100
    tall = (w.top - w.bottom) / camera.height / (extent / camera.width)  # of a pixel, in widths
    render.pixel_aspect_x, render.pixel_aspect_y = max(1.0, 1 / tall), max(1.0, tall)
    data.sensor_fit = "HORIZONTAL"
    if camera.orthographic:
        data.type, data.ortho_scale = "ORTHO", extent
    else:
        data.lens = max(_SENSOR / extent, _LEAST)
        data.sensor_width = max(_SENSOR, _LEAST * extent)
    data.shift_x, data.shift_y = (w.left + w.right) / 2 / extent, (w.bottom + w.top) / 2 / extent
    data.clip_start, data.clip_end = camera.clip_start, camera.clip_end
    obj = bpy.data.objects.new(camera.name, data)
    scene.collection.objects.link(obj)
    obj.matrix_world = Matrix(camera.world_from_camera.tolist())
    scene.camera = obj
    return obj


def shown_window(scene: Any) -> ViewWindow:
    """Return what a Blender scene's camera, with its horizontal sensor fit, shows."""
    data, render = scene.camera.data, scene.render
    width, height = resolution(render)
    return view_window(
        width=width,
        height=height,
        sensor_fit=data.sensor_fit,
        lens=data.lens,
        sensor_width=data.sensor_width,
        ortho_scale=data.ortho_scale if data.type == "ORTHO" else None,
        shift_x=data.shift_x,
        shift_y=data.shift_y,
        aspect_x=render.pixel_aspect_x,
        aspect_y=render.pixel_aspect_y,
    )
