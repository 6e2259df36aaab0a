"""Finds the pixel under the mouse, in an image of the picture or in the camera's view."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from bpy.types import Area, Context, Region, SpaceImageEditor

from ...scene import Camera, SceneError
from ..live.camera import camera_of, frame_in_view
from ..reading.camera import export_camera
from . import blocks
from .shown import IMAGES


class Pick(NamedTuple):
    """A pixel of the picture, and the export of the scene to derive it from: see `choices.py`."""

    x: int
    y: int
    source: str


def pick(context: Context, mouse_x: int, mouse_y: int) -> Pick | None:
    """Return the pixel at a place of the window; None where there is no picture.

    Raises
    ------
    SceneError
        If the mouse is over an editor that shows no pixel of the picture there; it says why.
    """
    area: Any
    for area in context.window.screen.areas:
        region = _region_at(area, mouse_x, mouse_y)
        if region is None:
            continue
        if region.type != "WINDOW" or area.type not in ("IMAGE_EDITOR", "VIEW_3D"):
            return None
        find = _of_image if area.type == "IMAGE_EDITOR" else _of_view
        return find(context, area.spaces.active, region, mouse_x - region.x, mouse_y - region.y)
    return None


def _region_at(area: Area, x: int, y: int) -> Region | None:
    """Return the region of an area at a place; sidebars lie above the main one."""
    found = [
        r
        for r in area.regions
        if r.width > 1 and 0 <= x - r.x < r.width and 0 <= y - r.y < r.height
    ]
    return min(found, key=lambda r: r.type == "WINDOW", default=None)


def _of_image(context: Context, space: SpaceImageEditor, region: Region, x: int, y: int) -> Pick:
    image = space.image
    camera = export_camera(context.scene)
    if image is None:
        raise SceneError("No image is open here: open the render, or one of the comparison's")
    u, v = region.view2d.region_to_view(x + 0.5, y + 0.5)  # the middle of a screen's pixel
    if not (0 <= u < 1 and 0 <= v < 1):
        raise SceneError(f"That is outside of the image '{image.name}'")
    if image.type == "RENDER_RESULT":  # Blender doesn't say how large it is
        if context.scene.render.use_crop_to_border:
            return Pick(int(u * camera.region.width), int(v * camera.region.height), "RENDER")
        return _within(camera, u, v, "RENDER")
    width, height = image.size
    own = camera.region
    if (width, height) != (own.width, own.height):
        raise SceneError(
            f"The image '{image.name}' has {width} x {height} pixels, the picture {own.width} x "
            f"{own.height}: it is of something else, or the resolution has changed since"
        )
    mark = image.get(blocks.MARK)
    source = "COMPARISON" if mark in IMAGES.values() else "SCENE"
    if mark == blocks.PUT_RIGHT:
        source = "PUT_RIGHT"
    return Pick(int(u * width), int(v * height), source)


def _of_view(context: Context, space: Any, region: Region, x: int, y: int) -> Pick:
    scene = context.scene
    view = region.data
    if view.view_perspective != "CAMERA":
        raise SceneError(
            "This 3D view does not look through the camera (Numpad 0, or View > Cameras > Active "
            "Camera): a pixel is one of the camera's picture"
        )
    camera = export_camera(scene)
    if space.use_local_camera and space.camera != scene.camera:
        raise SceneError(
            f"This 3D view looks through its own camera '{space.camera.name}'; the picture is that "
            f"of '{scene.camera.name}'"
        )
    low, high = frame_in_view(camera_of(region, view, space, scene), scene.camera, scene)
    u, v = (np.array((x + 0.5, y + 0.5)) - low) / (high - low)
    if not (0 <= u < 1 and 0 <= v < 1):
        raise SceneError("That is outside of the camera's frame")
    return _within(camera, u, v, "SCENE")


def _within(camera: Camera, u: float, v: float, source: str) -> Pick:
    """Return the pixel of the render border at a place of the whole picture, 0 to 1."""
    region = camera.region
    x = int(u * camera.width) - region.x0
    y = int(v * camera.height) - region.y0
    if not (0 <= x < region.width and 0 <= y < region.height):
        raise SceneError("That is outside of the render border")
    return Pick(x, y, source)
