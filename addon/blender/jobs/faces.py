"""Stores numbers with the faces of meshes, and selects faces, also of a mesh in Edit Mode."""

from __future__ import annotations

from typing import Any

import bmesh
import numpy as np

from ...arrays import Bools, Integers
from ...scene import SceneError


def check_free(mesh: Any, name: str) -> None:
    """Raise a SceneError if a mesh has an attribute of the name, but not whole numbers of faces."""
    there = mesh.attributes.get(name)
    if there and (there.data_type, there.domain) != ("INT", "FACE"):
        raise SceneError(f"Mesh '{mesh.name}' has another attribute '{name}': rename it")


def store(mesh: Any, name: str, values: Integers) -> None:
    """Store whole numbers with a mesh's faces, where :func:`check_free` raises nothing."""
    there = mesh.attributes.get(name) or mesh.attributes.new(name, "INT", "FACE")
    if not mesh.is_editmode:
        there.data.foreach_set("value", values.astype(np.int32))
        mesh.update()
        return
    edited = bmesh.from_edit_mesh(mesh)
    layer = edited.faces.layers.int[name]
    for face, value in zip(edited.faces, values.tolist(), strict=True):
        face[layer] = value
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def select_faces(mesh: Any, chosen: Bools) -> None:
    """Select faces of a mesh in Edit Mode, and no others; what is hidden there stays so."""
    edited = bmesh.from_edit_mesh(mesh)
    for face, is_chosen in zip(edited.faces, chosen.tolist(), strict=True):
        face.select_set(is_chosen and not face.hide)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
