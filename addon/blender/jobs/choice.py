"""Sets in an open file what is to be looked at, and through which camera.

`framing.Choice` says what is chosen. A file is opened for one command and never saved, so that the
choice is set in the file itself: the picture is that of a file saved like this.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from ...framing import ANGLE, BACKWARD, Choice, axes_of, framing, shown_points
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, SceneError, ViewWindow
from ..drawing.camera_object import place_camera
from ..engine import export_for_render
from ..reading.camera import pixel_height, resolution
from ..temporary import temporary_scene
from .stepping import bake_bodies, visited

_FAR = 1e18  # metres: farther away than anything, and its square is within float32


@contextmanager
def chosen(choice: Choice) -> Iterator[None]:
    """Set what is chosen in the open file, and make its scene the context's for a while.

    Raises
    ------
    SceneError
        If there is no such thing, or nothing that a camera could frame.
    """
    context: Any = bpy.context
    scene = _named("scene", choice.scene_name, bpy.data.scenes) or context.scene
    own = context.view_layer if scene == context.scene else scene.view_layers[0]
    layer = _named("view layer", choice.view_layer, scene.view_layers) or own
    cameras = [o for o in bpy.data.objects if o.type == "CAMERA"]
    cameras.sort(
        key=lambda o: o.library is None
    )  # of one name, the file's own comes last: it counts
    camera = _named("camera", choice.camera, cameras) or scene.camera
    with context.temp_override(scene=scene, view_layer=layer):
        if choice.frame is not None:
            bake_bodies(scene, choice.frame)
            for frame in visited(scene, [choice.frame]):
                scene.frame_set(frame)
        _resize(scene.render, choice)
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

    Infinite planes are not framed.

    Parameters
    ----------
    scene : bpy.types.Scene
    layer : bpy.types.ViewLayer
    angle : float
        The vertical opening angle, in degrees.

    Returns
    -------
    bpy.types.Object
        The camera.

    Raises
    ------
    SceneError
        If nothing is shown.
    """
    matrix = np.eye(4)
    matrix[2, 3] = _FAR
    window = ViewWindow(-_FAR, _FAR, -_FAR, _FAR)
    everything = Camera(matrix, window, 4, 4, ORTHOGRAPHIC, 1e-6, 2 * _FAR, name="Everything")
    with temporary_scene(scene, layer.name) as tmp:
        looking = place_camera(tmp, everything).data
        try:
            shown, _, _ = export_for_render(tmp)
        finally:
            bpy.data.cameras.remove(looking)  # and the object with it
    size = resolution(scene.render)
    tall = pixel_height(scene.render)
    points = shown_points(shown.meshes, shown.instances)
    return place_camera(scene, framing(points, axes_of(BACKWARD), *size, angle, tall))


def _named(what: str, name: str | None, things: Iterable[Any]) -> Any:
    """Return the thing of a name; None if no name is given."""
    found = {thing.name: thing for thing in things}
    if name is not None and name not in found:
        there = f"; there is {', '.join(map(repr, found))}" if found else ""
        raise SceneError(f"there is no {what} '{name}'{there}")
    return found.get(name)


def _resize(render: Any, choice: Choice) -> None:
    """Give the picture the size that is chosen."""
    if choice.width is None and choice.height is None:
        return
    size = choice.size(resolution(render))
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    if resolution(render) != size:
        raise SceneError(f"a picture of {size[0]} x {size[1]} pixels: Blender has from 4 to 65536")
