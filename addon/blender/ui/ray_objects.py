"""Draws a derivation as objects in the 3D view, in a collection that one click removes.

The objects are marked, and no picture shows them: a comparison's temporary scene leaves their
collection out, and they are hidden from renders.
"""

from __future__ import annotations

from collections import Counter
from typing import Any

import bpy
import numpy as np
from bpy.types import Material, Object, Scene

from ...derivation.derivation import Derivation
from ...derivation.figure import Shape, shapes
from ..temporary import DRAWN

NAME = "Reference Tracer Ray"


def draw(scene: Scene, derivation: Derivation) -> Any:
    """Draw a derivation in a scene, in place of the one that was drawn; return its collection."""
    remove()
    collection = bpy.data.collections.new(NAME)
    collection[DRAWN] = True
    scene.collection.children.link(collection)
    materials: dict[tuple[float, ...], Any] = {}
    for shape in shapes(derivation):
        if shape.color not in materials:
            materials[shape.color] = _material(shape.color)
        collection.objects.link(_object(shape, materials[shape.color]))
    return collection


def are_drawn() -> bool:
    """Return whether a derivation is drawn, or some of it is left."""
    return any(_own(bpy.data.collections)) or any(_own(bpy.data.objects))


def remove() -> int:
    """Remove what was drawn, wherever it is by now; return how many objects went.

    A collection into which the user has put something stays, and is the user's from then on.
    """
    collections = _own(bpy.data.collections)
    own = _own(bpy.data.objects)
    users = Counter(o.data for o in own if o.type == "MESH")
    meshes = [mesh for mesh, count in users.items() if mesh.users == count]  # but for the user's
    materials = {m for mesh in meshes for m in mesh.materials if m and m.get(DRAWN)}
    count = len(own)
    bpy.data.batch_remove([*own, *meshes, *materials])
    for collection in collections:
        if collection.objects or collection.children:
            del collection[DRAWN]
        else:
            bpy.data.collections.remove(collection)
    return count


def _own(blocks: Any) -> list[Any]:
    return [b for b in blocks if b.get(DRAWN) and not b.library]


def _material(color: tuple[float, ...]) -> Material:
    material = bpy.data.materials.new(NAME)
    material[DRAWN] = True
    material.diffuse_color = color
    return material


def _object(shape: Shape, material: Material) -> Object:
    """Return an object with its origin at a vertex: so float32 still has digits far away."""
    origin = np.float32(shape.vertices[0]).astype(np.float64)
    mesh = bpy.data.meshes.new(shape.name)
    mesh.from_pydata((shape.vertices - origin).tolist(), shape.edges, shape.faces)
    mesh.materials.append(material)
    obj: Any = bpy.data.objects.new(shape.name, mesh)
    obj[DRAWN] = True
    obj.location = origin
    obj.color = shape.color
    obj.show_in_front = shape.in_front
    obj.hide_render = True
    return obj
