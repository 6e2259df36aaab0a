"""Shows Blender a polygon in place of each infinite plane, which it cannot draw.

The polygon is where the plane cuts the camera's view volume. Polygons are in the temporary scene
alone, and the objects that were marked as infinite planes are left out of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from bpy.types import Object

from ...arrays import Colors, Floats
from ...scene import Plane, Scene
from ..reading.colors import random_color
from ..reading.view_volume import polygon
from ..temporary import leave_out, made_for

# A custom property of the polygon: the name of the object that is the plane.
STANDS_FOR = "reference_tracer_stands_for"


def stand_ins(tmp: Any, scene: Scene, owners: Sequence[str]) -> Scene:
    """Show polygons in a temporary Blender scene in place of its infinite planes.

    Parameters
    ----------
    tmp : bpy.types.Scene
        The temporary scene.
    scene : Scene
        What was exported of it.
    owners : sequence of str
        For each plane, the object that is marked as one.

    Returns
    -------
    Scene
        The exported scene as it is to be compared. Random colours come from names: there the planes
        take the colours of their polygons.
    """
    leave_out(tmp, {o for o in tmp.objects if o.reference_tracer.infinite_plane})
    planes: list[Plane] = []
    for plane, owner in zip(scene.planes, owners, strict=True):
        corners = polygon(scene.camera, plane)
        if len(corners):
            obj = _stand_in(tmp, corners, scene.camera.origin, plane.color)
            obj[STANDS_FOR] = owner
            if tmp.display.shading.color_type == "RANDOM":
                obj.color = random_color(obj)  # of engines that show objects' own
                plane = replace(plane, color=np.array(obj.color, np.float32))
        planes.append(plane)
    return replace(scene, planes=tuple(planes))


def _stand_in(tmp: bpy.types.Scene, corners: Floats, eye: Floats, color: Colors) -> Object:
    # Vertices are float32: the nearer one lies to the object's origin, the more digits it keeps. So
    # the origin is the corner that the camera sees largest.
    nearest = corners[np.argmin(((corners - eye) ** 2).sum(axis=1))]
    material = made_for(tmp, bpy.data.materials.new("Infinite Plane"))
    material.diffuse_color = (*color[:3], 1.0)
    mesh = made_for(tmp, bpy.data.meshes.new("Infinite Plane"))
    mesh.from_pydata((corners - nearest).tolist(), [], [list(range(len(corners)))])
    mesh.materials.append(material)
    obj: Object = made_for(tmp, bpy.data.objects.new("Infinite Plane", mesh))
    obj.location = nearest.tolist()
    obj.color = material.diffuse_color
    tmp.collection.objects.link(obj)
    return obj
