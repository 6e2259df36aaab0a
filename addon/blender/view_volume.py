"""The camera's view volume, a little enlarged, and what lies wholly outside it.

In come a camera and the boxes of meshes; out go the volume's corners, and which instances no ray of
the camera can meet.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, ViewWindow
from ..tracer.camera import pixel_size

BEYOND = 2  # pixels beyond the picture: a comparison looks half a pixel beside a pixel's centre
DEPTHS = 0.99, 1.01  # of the clip range, so that Blender's own clipping decides, in float32

# Of the sum of a distance's terms: 16 roundings of float32, in which a scene may be traced.
_SLACK = 2.0**-20


def corners(camera: Camera) -> NDArray[np.float64]:
    """Return the eight corners of the view volume, (8, 3) world space; bits: x, y, depth."""
    w, out = _window(camera), []
    for depth in (camera.clip_start * DEPTHS[0], camera.clip_end * DEPTHS[1]):
        for y in (w.bottom, w.top):
            for x in (w.left, w.right):
                scale = camera.projection.scale(depth)
                out.append(
                    camera.origin
                    + scale * (x * camera.right + y * camera.up)
                    + depth * camera.forward
                )
    return np.array(out)


def outside(
    camera: Camera,
    low: NDArray[np.floating],
    high: NDArray[np.floating],
    world_from_object: NDArray[np.float64],
) -> NDArray[np.bool_]:
    """Return which of k boxes lie wholly outside the view volume, (k,).

    Such a box lies wholly beyond one of the volume's six sides. (One that lies beyond an edge or
    a corner may be beyond none of them: it is not found.) A box that is not finite is never
    outside.

    Parameters
    ----------
    low, high : (k, 3)
        Corners of each box in its object's space.
    world_from_object : (k, 4, 4) float64
    """
    found = np.zeros(len(low), bool)
    with np.errstate(over="ignore", invalid="ignore"):  # then nothing is said to be outside
        low, high = np.float64(low), np.float64(high)
        center, half = low / 2 + high / 2, high / 2 - low / 2
        farthest = np.abs(center) + half
        for normal, offset in zip(*_sides(camera), strict=True):
            # The side in each object's space: its height over a point, and the sum of its terms.
            terms = normal * camera.origin
            side = np.append(normal, offset - terms.sum()) @ world_from_object
            size = np.append(np.abs(normal), abs(offset) + np.abs(terms).sum())
            size = size @ np.abs(world_from_object)
            most = (side[:, :3] * center + np.abs(side[:, :3]) * half).sum(axis=1) + side[:, 3]
            most_size = (size[:, :3] * farthest).sum(axis=1) + size[:, 3]
            found |= most < -_SLACK * most_size
    return found


def _window(camera: Camera) -> ViewWindow:
    w, (x, y) = camera.window, pixel_size(camera)
    return ViewWindow(
        w.left - BEYOND * x, w.right + BEYOND * x, w.bottom - BEYOND * y, w.top + BEYOND * y
    )


def _sides(camera: Camera) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return normals (6, 3) and offsets (6,): n . (p - origin) + offset >= 0 within a side."""
    # The axes need not be orthonormal: a point's coordinates are its products with their dual.
    axes = np.stack((camera.right, camera.up, camera.forward))
    dual = np.cross(axes[[1, 2, 0]], axes[[2, 0, 1]])
    x, y, depth = dual / (axes[0] * dual[0]).sum()
    w = _window(camera)
    edges = np.array((w.left, -w.right, w.bottom, -w.top))
    across = np.stack((x, -x, y, -y))
    clip = -camera.clip_start * DEPTHS[0], camera.clip_end * DEPTHS[1]
    normals, offsets = camera.projection.sides(across, depth, edges)
    return np.stack((*normals, depth, -depth)), np.array((*offsets, *clip))
