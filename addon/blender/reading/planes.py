"""The camera's view volume: what lies wholly outside it, and where an infinite plane cuts it.

While the context of `stand_ins` lasts, a temporary scene shows polygons in place of the objects
that were marked as infinite planes. The user's collections are not touched: those that hold a
marked object are replaced by copies, in the temporary scene alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from itertools import product
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Plane, Scene, ViewWindow
from ...tracer.camera import dual_axes, pixel_size
from ..drawing.temporary import STANDS_FOR, leave_out
from .colors import random_color

BEYOND = 2  # pixels beyond the picture: a comparison looks half a pixel beside a pixel's centre
MARGIN = 0.01  # of the clip range's ends, so that Blender's own clipping decides, in float32

# Of the sum of a distance's terms: 16 roundings of float32, in which a scene may be traced.
_SLACK = 2.0**-20


def volume_corners(camera: Camera) -> NDArray[np.float64]:
    """Return the eight corners of the view volume, (8, 3) world space; bits: x, y, depth."""
    camera, out = _linear(camera), []
    w = _window(camera)
    for depth, y, x in product(_depths(camera), (w.bottom, w.top), (w.left, w.right)):
        across = camera.projection.scale(depth) * (x * camera.right + y * camera.up)
        out.append(camera.origin + across + depth * camera.forward)
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


def _linear(camera: Camera) -> Camera:
    """Return a camera whose view volume holds this one's, with flat sides: of a panorama a box."""
    if camera.projection.is_linear:
        return camera
    end = camera.clip_end
    window = ViewWindow(-end, end, -end, end)
    return replace(camera, projection=ORTHOGRAPHIC, window=window, clip_start=-end)


def _window(camera: Camera) -> ViewWindow:
    w, (x, y) = camera.window, pixel_size(camera)
    return ViewWindow(
        w.left - BEYOND * x, w.right + BEYOND * x, w.bottom - BEYOND * y, w.top + BEYOND * y
    )


def _depths(camera: Camera) -> tuple[float, float]:
    start, end = camera.clip_start, camera.clip_end
    return start - MARGIN * abs(start), end + MARGIN * abs(end)


def _sides(camera: Camera) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return normals (6, 3) and offsets (6,): n . (p - origin) + offset >= 0 within a side."""
    camera = _linear(camera)
    # The axes need not be orthonormal: a point's coordinates are its products with their dual.
    x, y, depth = dual_axes(camera)
    w = _window(camera)
    edges = np.array((w.left, -w.right, w.bottom, -w.top))
    across = np.stack((x, -x, y, -y))
    start, end = _depths(camera)
    normals, offsets = camera.projection.sides(across, depth, edges)
    return np.stack((*normals, depth, -depth)), np.array((*offsets, -start, end))


def polygon(camera: Camera, plane: Plane) -> NDArray[np.float64]:
    """Return the corners, in order, of where a plane cuts the view volume: (k, 3) world space.

    k is 0 where it does not, and at most 6. The volume is enlarged: a polygon's rim is never seen.
    """
    corners = volume_corners(camera)
    height = ((corners - plane.point) * plane.normal).sum(axis=1)
    points = []
    for a in range(8):
        for bit in (1, 2, 4):  # corners whose numbers differ in one bit share an edge
            b = a | bit
            if a != b and (height[a] < 0) != (height[b] < 0):
                share = height[a] / (height[a] - height[b])
                points.append(corners[a] + share * (corners[b] - corners[a]))
    if len(points) < 3:
        return np.zeros((0, 3))
    found = np.array(points)
    centered = found - found.mean(axis=0)
    across = centered[0]
    along = np.cross(plane.normal, across)
    y, x = (centered @ axis / np.linalg.norm(axis) for axis in (along, across))
    return found[np.argsort(np.arctan2(y, x))]


@contextmanager
def stand_ins(tmp: Any, layer: str, scene: Scene, owners: Sequence[str]) -> Iterator[Scene]:
    """Show polygons in a temporary Blender scene in place of its infinite planes.

    Gives the exported scene as it is to be compared: random colours come from names, so there the
    planes take the colours that their polygons have. `owners` names the object that each plane is.
    """
    marked = {o for o in tmp.objects if o.reference_tracer.infinite_plane}
    objects: list[Any] = []
    planes: list[Plane] = []
    try:
        if marked:
            leave_out(tmp, layer, marked)
        for plane, owner in zip(scene.planes, owners, strict=True):
            corners = polygon(scene.camera, plane)
            if len(corners):
                objects.append(_stand_in(tmp, corners, scene.camera.origin, plane.color))
                objects[-1][STANDS_FOR] = owner
                if tmp.display.shading.color_type == "RANDOM":
                    plane = replace(plane, color=np.array(random_color(objects[-1]), np.float32))
            planes.append(plane)
        yield replace(scene, planes=tuple(planes))
    finally:
        for obj in objects:
            bpy.data.materials.remove(obj.data.materials[0])
            bpy.data.meshes.remove(obj.data)  # takes the object with it


def _stand_in(
    tmp: Any, corners: NDArray[np.float64], eye: NDArray[np.float64], color: NDArray[np.float32]
) -> Any:
    # Vertices are float32, and keep the more digits the nearer to the object's own origin they lie:
    # those that the camera sees largest.
    nearest = corners[np.argmin(((corners - eye) ** 2).sum(axis=1))]
    material = bpy.data.materials.new("Infinite Plane")
    material.diffuse_color = (*color[:3], 1.0)
    mesh = bpy.data.meshes.new("Infinite Plane")
    mesh.from_pydata((corners - nearest).tolist(), [], [list(range(len(corners)))])
    mesh.materials.append(material)
    obj = bpy.data.objects.new("Infinite Plane", mesh)
    obj.location, obj.color = nearest, (*color[:3], 1.0)
    tmp.collection.objects.link(obj)
    return obj
