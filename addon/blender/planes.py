"""Infinite planes in Blender's picture: the polygon in which each cuts the camera's view volume.

In come a temporary scene and the exported planes; while the context lasts, the temporary scene
shows polygons in place of the objects that were marked. The user's collections are not touched:
those that hold a marked object are replaced by copies, in the temporary scene alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, Plane, Scene
from .colors import random_color
from .temporary import STANDS_FOR, replace_objects
from .view_volume import corners as volume_corners


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
    across = found[0] - found.mean(axis=0)
    along = np.cross(plane.normal, across)
    centered = found - found.mean(axis=0)
    return found[
        np.argsort(
            np.arctan2(
                centered @ along / np.linalg.norm(along), centered @ across / np.linalg.norm(across)
            )
        )
    ]


@contextmanager
def stand_ins(tmp: Any, layer: str, scene: Scene, owners: Sequence[str]) -> Iterator[Scene]:
    """Show polygons in a temporary Blender scene in place of its infinite planes.

    Gives the exported scene as it is to be compared: random colours come from names, so there the
    planes take the colours that their polygons have.

    Parameters
    ----------
    tmp : bpy.types.Scene
    layer : str
        Name of the view layer that is drawn.
    scene : Scene
        What was exported from it.
    owners : sequence of str
        The object that each plane is.
    """
    marked = {o for o in tmp.objects if o.reference_tracer.infinite_plane}
    objects: list[Any] = []
    planes: list[Plane] = []
    try:
        if marked:
            replace_objects(tmp, layer, dict.fromkeys(marked))
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
