"""Measures to what fraction of a pixel the machine's rasteriser rounds the corners of triangles.

Eight bits below the pixel are a habit; what is promised is less (Vulkan's `subPixelPrecisionBits`
is 4 or more). So an edge is moved slowly over the centres of pixels: where they are covered too
early or too late, it was rounded. It is measured once a process. This is also the process's first
drawing: its edges may differ from those of all that follow.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import bpy
import numpy as np

from ...arrays import Bools, Floats
from ...pictures.bounds import SNAPPING
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, SceneError, ViewWindow
from ..temporary import made_for, remove
from .camera_object import add_camera
from .judge import Judge
from .picture import drawn_once, prepare_scene

# How far beside a centre the edges lie, in pixels: four steps to a bit, and none on a bit's own.
OFFSETS = 2.0 ** -(np.arange(4 * 2, 4 * 14) / 4 + 1 / 8)
_WIDTH = 8  # pixels
_NEAR = 0.01  # of a colour: far above its rounding to a half float


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
    is_wrong = (covered(judge, moved) != (moved > 0)).reshape(-1, 2).any(axis=1)
    right = OFFSETS[: int(np.argmax(is_wrong))] if is_wrong.any() else OFFSETS
    least = right[-1] if len(right) else OFFSETS[0]
    return max(SNAPPING, float(2.0 ** -(np.round(-np.log2(least)) - 1)))


def covered(judge: Judge, moved: Floats, turned: bool = False) -> Bools:
    """Draw a quad in each row, and return where it covers the centre of the second pixel, (n,).

    Parameters
    ----------
    judge : Judge
    moved : (n,) float64
        Pixels by which each row's right edge lies beyond that centre.
    turned : bool
        Draw one quad in each column instead, and move its lower edge.

    Raises
    ------
    SceneError
        If they are not in the colour that they should have, as drawn by EEVEE in 4.3.
    """
    rows = len(moved)
    size = (rows, _WIDTH) if turned else (_WIDTH, rows)
    matrix = np.eye(4)
    matrix[:3, 3] = _WIDTH / 2, rows / 2, 1.0
    if turned:
        matrix[:2, :2] = (0, -1), (1, 0)
    across, up = (n / 2 for n in size)
    window = ViewWindow(-across, across, -up, up)
    camera = Camera(matrix, window, *size, ORTHOGRAPHIC, 0.1, 100.0)
    scene = bpy.data.scenes.new("Reference Tracer Rasteriser")
    mesh = made_for(scene, _quads(moved))
    scene.collection.objects.link(made_for(scene, bpy.data.objects.new(mesh.name, mesh)))
    looking = made_for(scene, add_camera(scene, camera))
    made_for(scene, looking.data)
    try:
        prepare_scene(scene, judge, True)
        shading = scene.display.shading
        shading.color_type = "SINGLE"  # whatever else the file holds
        color = np.array(shading.single_color)
        shown = drawn_once(scene, judge, camera, True)
    finally:
        remove(scene)
    drawn = shown[shown[..., 3] > 0.5][:, :3]
    if len(drawn) and not np.allclose(np.median(drawn, axis=0), color, atol=_NEAR):
        raise SceneError(
            f"{judge.label} of Blender {bpy.app.version_string} shows materials of its own: no "
            "other is put over them all. Compare with Workbench or Cycles."
        )
    return (shown[-2] if turned else shown[:, 1])[:, 3] > 0.5


def _quads(moved: Floats) -> Any:
    """Return a Blender mesh with a quad for each row of pixels, one above the other."""
    corners = [
        (x, y, 0.0)
        for row, right in enumerate(1.5 + moved)
        for x, y in ((0.0, row), (right, row), (right, row + 1), (0.0, row + 1))
    ]
    faces = np.arange(len(corners)).reshape(-1, 4)
    mesh = bpy.data.meshes.new("Reference Tracer Rasteriser")
    mesh.from_pydata(corners, [], faces.tolist())
    return mesh
