"""Reads the camera of the open scene, in one frame or more, and where Blender's matrix has points.

Each is the camera of the picture that Blender writes: with *Crop to Render Region*, of the border's
region alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import bpy
import numpy as np
from bpy.types import Scene

from ...camera_files.convention import View
from ...camera_files.frame import part
from ...pictures.certificate import known_points
from ...report.cameras import SceneCamera
from ...scene import Region
from ..reading.camera import export_camera, film_of_blender
from .stepping import stepped


def cameras(frames: Sequence[int] | None = None) -> Iterator[SceneCamera]:
    """Yield the context's camera at each of these frames, in order; by default as it is.

    Raises
    ------
    SceneError
        If there is no camera, or one that is not modelled.
    """
    scene = bpy.context.scene
    if frames is None:
        yield _camera(scene.frame_current)
        return
    yield from map(_camera, stepped(scene, [*frames]))


def _camera(frame: int) -> SceneCamera:
    depsgraph = bpy.context.evaluated_depsgraph_get()
    scene: Scene = depsgraph.scene_eval
    camera = export_camera(scene)
    if not scene.render.use_crop_to_border:
        camera = replace(camera, region=Region(0, 0, camera.width, camera.height))
    corner = np.array([[camera.region.x0], [camera.region.y0]])
    camera = part(camera)
    points = known_points(camera)
    if not camera.projection.is_linear:  # Blender has no matrix for it
        return SceneCamera.of(camera, f"{frame:04d}.png")
    film = film_of_blender(depsgraph, points) - corner
    return SceneCamera(
        View(camera, f"{frame:04d}.png", frame), points, film, "Blender's own matrix"
    )
