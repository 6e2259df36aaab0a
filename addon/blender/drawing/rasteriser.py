"""Measures to what fraction of a pixel the machine's rasteriser rounds the corners of triangles.

Eight bits below the pixel are a habit; what is promised is less (Vulkan's `subPixelPrecisionBits`
is 4 or more). So an edge is moved slowly over the centres of pixels: where they are covered too
early or too late, it was rounded. It is measured once a process. This is also the process's first
drawing, whose edges may differ from those of all that follow.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import bpy
import numpy as np

from ...arrays import Bools, Floats
from ...compare.bounds import SNAPPING
from ..reading.camera import export_camera
from .judge import Judge
from .picture import picture, prepare_scene

# How far beside a centre the edges lie, in pixels: four steps to a bit, and none on a bit's own.
OFFSETS = 2.0 ** -(np.arange(4 * 2, 4 * 14) / 4 + 1 / 8)
_WIDTH = 8  # pixels


@cache
def snapping_of(judge: Judge) -> float:
    """Return how far a judge may move a corner, in pixels: never less than SNAPPING.

    A rasteriser that rounds to the nearest step covers a centre half a step too early or too late;
    one that cuts off, a whole step. Twice what is measured bounds both. A ray tracer is not
    measured: its corners are not rounded to steps of a pixel.
    """
    if judge.traces_rays:
        return SNAPPING
    moved = np.stack((-OFFSETS, OFFSETS), axis=1).ravel()  # left of the centre, and right of it
    is_wrong = (_covered(judge, moved) != (moved > 0)).reshape(-1, 2).any(axis=1)
    right = OFFSETS[: int(np.argmax(is_wrong))] if is_wrong.any() else OFFSETS
    least = right[-1] if len(right) else OFFSETS[0]
    return max(SNAPPING, float(2.0 ** -(np.round(-np.log2(least)) - 1)))


def _covered(judge: Judge, moved: Floats) -> Bools:
    """Draw a quad in each row, and return where it covers the centre of the second pixel, (n,).

    Parameters
    ----------
    judge : Judge
    moved : (n,) float64
        Pixels by which each row's right edge lies beyond that centre.
    """
    with _quads(moved) as scene:
        prepare_scene(scene, True)
        shown = picture(scene, scene.view_layers[0].name, judge, export_camera(scene), True)
    return shown[:, 1, 3] > 0.5


@contextmanager
def _quads(moved: Floats) -> Iterator[Any]:
    """Give a scene with a row of pixels for each quad, for a while."""
    rows = len(moved)
    scene = bpy.data.scenes.new("Reference Tracer Rasteriser")
    mesh = bpy.data.meshes.new(scene.name)
    camera = bpy.data.cameras.new(scene.name)
    try:
        corners = [
            (x, y, 0.0)
            for row, right in enumerate(1.5 + moved)
            for x, y in ((0.0, row), (right, row), (right, row + 1), (0.0, row + 1))
        ]
        faces = np.arange(4 * rows).reshape(rows, 4)
        mesh.from_pydata(corners, [], faces.tolist())
        eye = bpy.data.objects.new(scene.name, camera)
        eye.location = (_WIDTH / 2, rows / 2, 1.0)
        camera.type = "ORTHO"
        camera.ortho_scale = max(_WIDTH, rows)
        for obj in (eye, bpy.data.objects.new(scene.name, mesh)):
            scene.collection.objects.link(obj)
        scene.camera = eye
        scene.render.resolution_x = _WIDTH
        scene.render.resolution_y = rows
        scene.render.resolution_percentage = 100
        yield scene
    finally:
        bpy.data.batch_remove([*scene.collection.objects, scene, mesh, camera])
