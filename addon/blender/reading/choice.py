"""What is looked at of an open file, and through which camera: as `framing.Choice` says.

A file is opened for one command and never saved: what is chosen is set in it. The picture is that
of a file which was saved like this.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from ...framing import ANGLE, BACKWARD, UP, Choice, axes_of, framing, shown_points
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, SceneError, ViewWindow
from ..drawing.camera_object import place_camera
from ..drawing.temporary import temporary_scene
from ..engine import export_for_render
from ..stepping import bake_bodies, visited
from .camera import pixel_height, resolution

_FAR = 1e18  # metres: farther away than anything, and its square is within float32


@contextmanager
def chosen(choice: Choice) -> Iterator[None]:
    """Set what is chosen in the open file; for a while, its scene and view layer are the context's.

    Raises
    ------
    SceneError
        If there is no such thing, or nothing that a camera could frame.
    """
    context = bpy.context
    scene = _named("scene", choice.scene_name, bpy.data.scenes) or context.scene
    own = context.view_layer if scene == context.scene else scene.view_layers[0]
    layer = _named("view layer", choice.view_layer, scene.view_layers) or own
    cameras = (o for o in bpy.data.objects if o.type == "CAMERA")
    cameras = sorted(cameras, key=lambda o: o.library is None)  # the file's own is the last, stays
    camera = _named("camera", choice.camera, cameras) or scene.camera
    with context.temp_override(scene=scene, view_layer=layer):
        if choice.frame is not None:
            bake_bodies(scene, choice.frame)
            for frame in visited(scene, [choice.frame]):
                scene.frame_set(frame)
        _resize(scene.render, choice.width, choice.height)
        if choice.camera or choice.eye or choice.frame_all:
            for marker in scene.timeline_markers:  # which would make its own the active one
                marker.camera = None
            scene.camera = camera
        if choice.eye:
            size = resolution(scene.render)
            place_camera(scene, choice.placed(*size, pixel_height(scene.render)))
        elif choice.frame_all:
            frame_all(scene, layer, choice.angle or ANGLE)
        yield


def frame_all(scene: Any, layer: Any, angle: float = ANGLE) -> Any:
    """Add a camera that frames all that a render of the view layer shows, and make it active.

    Infinite planes are not framed. The angle is the vertical one, in degrees; returns the object.

    Raises
    ------
    SceneError
        If nothing is shown.
    """
    matrix = np.eye(4)
    matrix[2, 3] = _FAR
    window = ViewWindow(*(-_FAR, _FAR) * 2)
    everything = Camera(matrix, window, 4, 4, ORTHOGRAPHIC, 1e-6, 2 * _FAR, name="Everything")
    with temporary_scene(scene, layer.name) as tmp:
        looking = place_camera(tmp, everything).data
        try:
            shown, _, _ = export_for_render(tmp)
        finally:
            bpy.data.cameras.remove(looking)  # and the object with it
    size, tall = resolution(scene.render), pixel_height(scene.render)
    points = shown_points(shown.meshes, shown.instances)
    return place_camera(scene, framing(points, axes_of(BACKWARD, UP), *size, angle, tall))


def _named(what: str, name: str | None, things: Iterable[Any]) -> Any:
    """Return the one of a name; None where none is asked for."""
    found = {thing.name: thing for thing in things}
    if name is not None and name not in found:
        raise SceneError(f"there is no {what} '{name}': {', '.join(found) or 'there is none'}")
    return found.get(name)


def _resize(render: Any, width: int | None, height: int | None) -> None:
    """Give the picture another size; where one side is given, the other follows."""
    if not (width or height):
        return
    w, h = resolution(render)
    size = width or max(1, round(height * w / h)), height or max(1, round(width * h / w))
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    if resolution(render) != size:
        raise SceneError(f"a picture of {size[0]} x {size[1]} pixels: Blender has from 4 to 65536")
