"""To what the machine's rasteriser rounds the corners of triangles: measured, once a process.

Eight bits below the pixel are a habit; what is promised is less (Vulkan's `subPixelPrecisionBits`
is 4 or more). So an edge is moved slowly over the centres of pixels: where these are covered too
early or too late, it was rounded. The drawing is also the process's first, whose edges may lie
otherwise than those of all that follow.
"""

from __future__ import annotations

from functools import cache

import bpy
import numpy as np

from ...compare.bounds import SNAPPING
from ..reading.camera import export_camera
from .judges import Judge
from .viewport import picture, prepare_scene

# How far beside a centre the edges lie, in pixels: four steps to a bit, and none on a bit's own.
OFFSETS = 2.0 ** -(np.arange(4 * 2, 4 * 14) / 4 + 1 / 8)


@cache
def snapping_of(judge: Judge) -> float:
    """Return how far a judge may move a corner, in pixels: never less than SNAPPING.

    One that rounds to the nearest step covers a centre half a step too early or too late; one that
    cuts off, a whole step. Twice what is measured bounds both.
    """
    if not judge.solid:  # it traces rays
        return SNAPPING
    sides = np.array((-1, 1))
    moved = (OFFSETS[:, None] * sides).ravel()  # a row each: the edge, right of the centre or left
    covered = _drawn(judge, moved)
    wrong = (covered != (moved > 0)).reshape(-1, 2).any(axis=1)
    right_from = OFFSETS[: int(np.argmax(wrong))] if wrong.any() else OFFSETS
    least = right_from.min(initial=OFFSETS[0])
    return max(SNAPPING, 2.0 ** -(np.round(-np.log2(least)) - 1))


def _drawn(judge: Judge, moved: np.ndarray) -> np.ndarray:
    """Draw a row a quad, whose right edge is so far beyond the second pixel's centre; (n,) bool."""
    rows = len(moved)
    scene = bpy.data.scenes.new("Reference Tracer Rasteriser")
    mesh = bpy.data.meshes.new(scene.name)
    camera = bpy.data.cameras.new(scene.name)
    try:
        y, right = np.arange(rows), 1.5 + moved
        low, high = np.zeros(rows), y + 1
        corners = [(low, y), (right, y), (right, high), (low, high)]
        points = np.stack([np.stack((x, h, np.zeros(rows)), 1) for x, h in corners], 1)
        faces = np.arange(4 * rows).reshape(rows, 4)
        mesh.from_pydata(points.reshape(-1, 3).tolist(), [], faces.tolist())
        eye = bpy.data.objects.new(scene.name, camera)
        eye.location = (4.0, rows / 2, 1.0)
        camera.type, camera.ortho_scale = "ORTHO", max(8.0, float(rows))
        for obj in (eye, bpy.data.objects.new(scene.name, mesh)):
            scene.collection.objects.link(obj)
        scene.camera = eye
        scene.render.resolution_x, scene.render.resolution_y = 8, rows
        scene.render.resolution_percentage = 100
        prepare_scene(scene, True)
        shown = picture(scene, scene.view_layers[0].name, judge, export_camera(scene), True)
        return shown[:, 1, 3] > 0.5
    finally:
        bpy.data.batch_remove([*scene.collection.objects, scene, mesh, camera])
