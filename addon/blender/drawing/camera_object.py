"""Makes a camera in Blender from a `scene.Camera`, as closely as float32 allows."""

from __future__ import annotations

from typing import Any

import bpy
from mathutils import Matrix

from ...scene import Camera
from ...tracer.camera import pixel_size
from ..versions import lens


def add_camera(scene: Any, camera: Camera) -> Any:
    """Add a camera to a Blender scene, make it the active one, and set the picture's size.

    Blender takes the nearest value that it can have, as for pixels of more than 200 to 1 or a clip
    start below 1e-6 m: `window_of` says what is shown.
    """
    render = scene.render
    across, up = pixel_size(camera)
    tall = up / across
    render.resolution_x = camera.width
    render.resolution_y = camera.height
    render.resolution_percentage = 100
    render.pixel_aspect_x = max(1.0, 1 / tall)
    render.pixel_aspect_y = max(1.0, tall)
    return place_camera(scene, camera)


def place_camera(scene: Any, camera: Camera) -> Any:
    """Add a camera for the picture that a Blender scene has, and make it the active one."""
    w = camera.window
    data: Any = bpy.data.cameras.new(camera.name)
    data.sensor_fit = "HORIZONTAL"
    settings = camera.projection.settings((w.left, w.right, w.bottom, w.top))
    data.type = settings.pop("type")
    for name, value in settings.items():
        setattr(lens(data), name, value)
    data.clip_start = camera.clip_start
    data.clip_end = camera.clip_end
    obj = bpy.data.objects.new(camera.name, data)
    scene.collection.objects.link(obj)
    obj.matrix_world = Matrix(camera.world_from_camera.tolist())
    scene.camera = obj
    return obj
