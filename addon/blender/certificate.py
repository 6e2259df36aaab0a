"""The camera certificate's other side: the same points through Blender's own matrix."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compare.certificate import CameraCertificate, certify, known_points
from ..scene import Camera
from .camera import resolution


def certify_camera(scene: Any, depsgraph: Any, camera: Camera) -> CameraCertificate:
    """Return how far apart the exported camera and Blender's own see known points.

    Parameters
    ----------
    scene : bpy.types.Scene
    depsgraph : bpy.types.Depsgraph
        Of that scene.
    camera : Camera
        What was exported of it.
    """
    points = known_points(camera)
    return certify(camera, points, _film(scene, depsgraph, points))


def _film(scene: Any, depsgraph: Any, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where world points (3, n) appear, (2, n) pixels of the whole picture."""
    obj, render = scene.camera.evaluated_get(depsgraph), scene.render
    width, height = resolution(render)
    projection = obj.calc_matrix_camera(
        depsgraph,
        x=width,
        y=height,
        scale_x=render.pixel_aspect_x,
        scale_y=render.pixel_aspect_y,
    )
    world = np.array(obj.matrix_world.normalized(), np.float64)  # as Blender's view matrix has it
    at = np.linalg.solve(world[:3, :3], points - world[:3, 3:])
    clip = np.array(projection, np.float64) @ np.vstack((at, np.ones(at.shape[1])))
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y = clip[:2] / clip[3]
    return np.stack(((x + 1) / 2 * width, (y + 1) / 2 * height))
