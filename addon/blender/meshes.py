"""Evaluated Blender meshes -> `scene.Mesh`, read in bulk."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scene import Mesh, drop_non_finite


def export_mesh(mesh: Any, name: str, with_colors: bool) -> tuple[Mesh, int]:
    """Return the loop triangles of an evaluated `bpy.types.Mesh`.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    name : str
    with_colors : bool
        Whether the active colour attribute is what will be shown.

    Returns
    -------
    Mesh
        Its triangles are numbered as `mesh.loop_triangles`, but for those that were left out.
    left_out : int
        How many triangles touched a vertex that is not finite.
    """
    vertices = _read(mesh.vertices, "co", 3, np.float32)
    loops = mesh.loop_triangles
    triangles = _read(loops, "vertices", 3, np.int32)
    vertices, keep = drop_non_finite(vertices, triangles)
    slots = _read(loops, "material_index", 1, np.int32).ravel()
    colors = _corner_colors(mesh) if with_colors else None
    return Mesh(
        vertices=vertices,
        triangles=triangles[keep],
        slots=np.maximum(slots[keep], 0),
        corner_colors=None if colors is None else colors[keep],
        name=name,
    ), int(len(keep) - keep.sum())


def _corner_colors(mesh: Any) -> NDArray[np.float32] | None:
    """Return the active colour attribute at each triangle's corners, (n, 3, 4) linear RGBA."""
    attribute = mesh.color_attributes.active_color
    if attribute is None:
        return None
    values = _read(attribute.data, "color", 4, np.float32)
    corner = "vertices" if attribute.domain == "POINT" else "loops"
    return values[_read(mesh.loop_triangles, corner, 3, np.int32)]


def _read(collection: Any, attribute: str, width: int, dtype: type) -> NDArray:
    out = np.empty(len(collection) * width, dtype)
    collection.foreach_get(attribute, out)
    return out.reshape(-1, width)
