"""Makes a camera in Blender from a `scene.Camera`, as closely as float32 allows."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from bpy.types import Object, RenderSettings, Scene
from mathutils import Matrix

from ...scene import Camera, SceneError
from ...tracer.camera import pixel_size
from ..reading.camera import camera_axes, pixel_height, resolution
from ..reading.lenses import lens_of
from ..versions import lens

NEAR = 1e-5  # of an axis, or of a pixel's shape: far above the rounding of Blender's settings


def add_camera(scene: Scene, camera: Camera) -> Object:
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


def place_camera(scene: Scene, camera: Camera) -> Object:
    """Add a camera for the picture that a Blender scene has, and make it the active one."""
    obj = bpy.data.objects.new(camera.name, bpy.data.cameras.new(camera.name))
    scene.collection.objects.link(obj)
    _set(obj, camera)
    scene.camera = obj
    return obj


def copy_camera(scene: Scene, camera: Camera, name: str) -> Object:
    """Add a copy of a Blender scene's camera that sees as another; the active one stays.

    What moves the user's own camera (parents, constraints, animation) does not move the copy. Its
    rays are the camera's, but for the rounding of Blender's settings to float32.

    Raises
    ------
    SceneError
        If no camera object sees so: what it takes is then a setting of the render.
    """
    _check_possible(scene.render, camera)
    data: Any = scene.camera.data.copy()
    data.name = name
    data.animation_data_clear()
    obj = bpy.data.objects.new(name, data)
    for collection in scene.camera.users_collection:
        collection.objects.link(obj)
    _set(obj, camera)
    off = camera_axes(obj.matrix_basis, name)[:3, :3] - camera.world_from_camera[:3, :3]
    if np.abs(off).max() > NEAR:
        bpy.data.cameras.remove(data)  # and the object with it
        raise SceneError(
            "No camera object has these axes, which are not at right angles: Blender keeps a "
            "place, a rotation and a scale."
        )
    return obj


def _check_possible(render: RenderSettings, camera: Camera) -> None:
    """Raise a SceneError if a render has no picture of a camera's size, or other pixels."""
    size, here = (camera.width, camera.height), resolution(render)
    if size != here:
        raise SceneError(
            f"The picture is one of {size[0]} x {size[1]} pixels, the render has {here[0]} x "
            f"{here[1]}: that is its resolution, which no camera has."
        )
    across, up = pixel_size(camera)
    tall = pixel_height(render)
    if abs(up / across / tall - 1) > NEAR:
        raise SceneError(
            f"Its pixels are {up / across:.6g} times as high as wide, the render's {tall:.6g}: "
            "that is the render's pixel aspect, which no camera has."
        )


def _set(obj: Any, camera: Camera) -> None:
    """Have a camera object see as a camera, in a picture of its size."""
    w, data = camera.window, obj.data
    data.sensor_fit = "HORIZONTAL"
    settings = lens_of(camera.projection).settings((w.left, w.right, w.bottom, w.top))
    data.type = settings.pop("type")
    for name, value in settings.items():
        setattr(lens(data), name, value)
    data.clip_start = camera.clip_start
    data.clip_end = camera.clip_end
    obj.matrix_world = Matrix(camera.world_from_camera.tolist())
