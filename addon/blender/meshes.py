"""Evaluated Blender meshes -> `scene.Mesh`, read in bulk.

What is stored as an attribute is one block of memory, and is copied as such. The plain properties
(`vertices[i].co` and the like) are asked for one by one, also by `foreach_get`: some 50 times as
slow. Only the loop triangles' corners cannot be had otherwise.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scene import Mesh, drop_non_finite


def read_vertices(mesh: Any) -> NDArray[np.float32]:
    """Return the vertices of an evaluated `bpy.types.Mesh` that has some, (v, 3) object space."""
    if mesh.is_editmode:  # its attributes are those of the mesh in the editor
        return _read(mesh.vertices, "co", 3, np.float32)
    return _read(mesh.attributes["position"].data, "vector", 3, np.float32)


def export_mesh(
    mesh: Any, vertices: NDArray[np.float32], name: str, with_colors: bool
) -> tuple[Mesh, int]:
    """Return the loop triangles of an evaluated `bpy.types.Mesh`.

    Parameters
    ----------
    mesh : bpy.types.Mesh
    vertices : (v, 3) float32
        Its own, as :func:`read_vertices` gives them.
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
    loops = _read(mesh.loop_triangles, "loops", 3, np.int32)
    if mesh.is_editmode:
        triangles = _read(mesh.loop_triangles, "vertices", 3, np.int32)
    else:
        triangles = _read(mesh.attributes[".corner_vert"].data, "value", 1, np.int32)[loops, 0]
    slots = _slots(mesh)
    colors = _corner_colors(mesh, triangles, loops) if with_colors else None
    vertices, keep = drop_non_finite(vertices, triangles)
    left_out = len(keep) - int(keep.sum())
    if left_out:
        triangles = triangles[keep]
        slots = None if slots is None else slots[keep]
        colors = None if colors is None else colors[keep]
    return Mesh(vertices, triangles, slots, colors, name), left_out


def _slots(mesh: Any) -> NDArray[np.int32] | None:
    """Return each triangle's material slot, (n,); None where all show the first."""
    attribute = None if mesh.is_editmode else mesh.attributes.get("material_index")
    if attribute and (attribute.domain, attribute.data_type) == ("FACE", "INT"):
        face = _read(mesh.loop_triangle_polygons, "value", 1, np.int32)
        slots = _read(attribute.data, "value", 1, np.int32)[face.ravel()]
    elif attribute or mesh.is_editmode:  # Blender converts another kind, which is rare
        slots = _read(mesh.loop_triangles, "material_index", 1, np.int32)
    else:
        return None
    return np.maximum(slots.ravel(), 0)


def _corner_colors(
    mesh: Any, triangles: NDArray[np.int32], loops: NDArray[np.int32]
) -> NDArray[np.float32] | None:
    """Return the active colour attribute at each triangle's corners, (n, 3, 4) linear RGBA."""
    attribute = mesh.color_attributes.active_color
    if attribute is None:
        return None
    values = _read(attribute.data, "color", 4, np.float32)
    return values.take(triangles if attribute.domain == "POINT" else loops, axis=0)


def _read(collection: Any, attribute: str, width: int, dtype: type) -> NDArray:
    out = np.empty(len(collection) * width, dtype)
    collection.foreach_get(attribute, out)
    return out.reshape(-1, width)
