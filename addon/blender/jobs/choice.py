"""Chooses the scene, view layer, frame and camera of an open file.

`framing.Choice` says what is chosen. A file is opened for one command and never saved, so that the
choice is set in the file itself: the picture is that of a file saved like this.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from bpy.types import Object, RenderSettings, Scene, ViewLayer

from ...camera_files.convention import View
from ...framing import ANGLE, BACKWARD, Choice, axes_of, framing, shown_points
from ...pictures.certificate import certify, known_points
from ...scene import SceneError
from ...tracer.camera import film_of
from ..drawing.camera_object import add_camera, place_camera
from ..evaluating import export_for_render
from ..reading.camera import export_camera, pixel_height, resolution
from ..temporary import everything, made_for, temporary_scene
from .stepping import bake_bodies, visited


@contextmanager
def chosen(choice: Choice) -> Iterator[None]:
    """Set what is chosen in the open file, and make its scene the context's for a while.

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
    own_last = sorted(cameras, key=lambda o: o.library is None)  # of one name, the last one counts
    camera = _named("camera", choice.camera, own_last) or scene.camera
    with context.temp_override(scene=scene, view_layer=layer):
        if choice.frame is not None:
            bake_bodies(scene, choice.frame)
            for frame in visited(scene, [choice.frame]):
                scene.frame_set(frame)
        _resize(scene.render, choice)
        if choice.camera or choice.seen_by or choice.views or choice.eye or choice.frame_all:
            for marker in scene.timeline_markers:  # which would make its own the active one
                marker.camera = None
            scene.camera = camera
        if choice.seen_by:
            _see_as(scene, choice.seen_by)
        elif choice.eye:
            size = resolution(scene.render)
            place_camera(scene, choice.placed(*size, pixel_height(scene.render)))
        elif choice.frame_all:
            frame_all(scene, layer, choice.angle or ANGLE)
        yield


@contextmanager
def seen_by(scene: Scene, view: View | None) -> Iterator[None]:
    """See a scene by the camera of a file for a while, or by its own.

    Raises
    ------
    SceneError
        If Blender has no such camera.
    """
    own = scene.camera
    try:
        if view:
            _see_as(scene, view)
        yield
    finally:
        made: Any = scene.camera
        if made != own:
            scene.camera = own
            bpy.data.cameras.remove(made.data)  # and the object with it


def _see_as(scene: Scene, view: View) -> None:
    """Add the camera of a file, as closely as float32 allows, and make it active.

    The picture has its size. A file that says no clip range leaves that of the scene's camera.

    Raises
    ------
    SceneError
        If Blender has no such camera.
    """
    own, camera = scene.camera, view.camera
    if own and own.type == "CAMERA" and not view.is_clipped:
        ends = {name: getattr(own.data, name) for name in ("clip_start", "clip_end")}
        camera = replace(camera, **ends)
    obj = add_camera(scene, camera)
    scene.render.use_border = False
    context = bpy.context
    context.view_layer.update()
    found = export_camera(scene)
    points = known_points(found)
    certificate = certify(camera, points, np.stack(film_of(found, points)[:2]))
    if (found.width, found.height) != (camera.width, camera.height) or not certificate.passed:
        raise SceneError(
            f"Blender has no camera like '{obj.name}' of {camera.width} x {camera.height} pixels: "
            f"the nearest is up to {certificate.largest:.3g} px off. It has axes at right angles, "
            "pixels of at most 200 to 1, and pictures of 4 to 65536 pixels"
        )


def frame_all(scene: Scene, layer: ViewLayer, angle: float = ANGLE) -> Object:
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
    with temporary_scene(scene, layer.name) as tmp, everything(tmp):
        data = made_for(tmp, bpy.data.cameras.new("Everything"))
        tmp.camera = made_for(tmp, bpy.data.objects.new(data.name, data))
        tmp.collection.objects.link(tmp.camera)
        shown, _ = export_for_render(tmp)
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


def _resize(render: RenderSettings, choice: Choice) -> None:
    """Give the picture the size that is chosen."""
    if choice.width is None and choice.height is None:
        return
    size = choice.size(resolution(render))
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    if resolution(render) != size:
        raise SceneError(f"a picture of {size[0]} x {size[1]} pixels: Blender has from 4 to 65536")
