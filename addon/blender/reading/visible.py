"""An evaluated depsgraph -> what is visible in it: every appearance of a mesh or infinite plane.

The depsgraph hands out every object that has triangles as a mesh: text, curves, surfaces, metaballs
and what geometry nodes make, with all instances. What is asked of Blender for each of ten thousand
instances is kept little.

Meshes are read in bulk. What is stored as an attribute is one block of memory, and is copied as
such. The plain properties (`vertices[i].co` and the like) are asked for one by one, also by
`foreach_get`: some 50 times as slow.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import bpy
import numpy as np
from numpy.typing import NDArray

from ...manifest import Unmodelled
from ...scene import Mesh, drop_non_finite
from ..drawing.temporary import judge_of
from ..versions import FILTERS
from .colors import instance_colors, slot_materials
from .unmodelled import HAIR, of_object, unfilled


@dataclass
class Seen:
    """What an object has shown so far."""

    type: str
    is_plane: bool
    mesh_keys: dict[int, None] = field(default_factory=dict)  # in the order in which they came
    instances: int = 0
    outside: int = 0  # instances that no ray can meet: not exported
    triangles: int = 0  # over all instances
    left_out: int = 0
    planes: int = 0
    empty_slots: int = 0
    features: dict[str, Unmodelled] = field(default_factory=dict)


class Shown(NamedTuple):
    """One appearance of an object: of a mesh, by its address, or as an infinite plane.

    The `owner` is the object whose colour Blender gives it: of an instance, what instances it.
    """

    name: str
    owner: str
    key: int | None
    matrix: NDArray[np.float64]
    colors: NDArray[np.float32]


Read = tuple[Mesh, int]  # with the triangles left out

_CORNERS = 12  # bytes: three int32


def visible(
    depsgraph: Any, shading: Any, read: Callable[[Any, str, bool], Read | None], space: Any = None
) -> tuple[dict[str, Seen], list[Shown], dict[int, Read | None]]:
    """Return by name what is visible, every appearance of it, and the meshes by address.

    The shading is a `View3DShading`; each mesh is read once, by :func:`read_mesh` or what knows it
    already. Of a `space`, a `SpaceView3D`, what is shown in that view alone decides: local view,
    local collections, types of objects.
    """
    viewport, layer = depsgraph.mode == "VIEWPORT", depsgraph.view_layer
    judge, color_type = judge_of(depsgraph.scene), shading.color_type
    seen: dict[str, Seen] = {}
    shown: list[Shown] = []
    meshes: dict[int, Read | None] = {}
    # Instances of one mesh by one object look the same, but for the colour that each may inherit.
    modelled: set[tuple] = set()  # as a whole
    all_colors: dict[tuple, NDArray[np.float32]] = {}
    unshown = types_left_out(space) if space else set()
    for item in depsgraph.object_instances:
        obj = item.object
        name = obj.original.name_full
        # Once a script has looked at an evaluated object, Blender (4.3 to 5.2) hands out that for
        # an instance of it. So what an instance has of its holder is asked of the holder.
        holder = item.parent if item.is_instance else obj
        owner = holder.original
        # The depsgraph hands out what only the eye of a collection hides.
        if space:
            if obj.type in unshown or not in_view(space, unshown, holder, layer):
                continue
        elif viewport and not owner.visible_get(view_layer=layer):
            continue
        if name not in seen:
            original = obj.original
            seen[name] = Seen(original.type, original.reference_tracer.infinite_plane)
        entry = seen[name]
        if not (item.show_self or item.show_particles):
            continue
        mesh = obj.data if obj.type == "MESH" else None
        key = mesh.as_pointer() if mesh else None
        look = name, key, holder.color[:] if color_type in ("OBJECT", "VERTEX") else None
        if look not in modelled:
            found = list(of_object(obj, holder, item.matrix_world, shading, layer, viewport, judge))
            if not item.show_self:  # its hair is shown without it
                found = [u for u in found if u.feature == HAIR]
            by_nodes = item.is_instance and owner.instance_type == "NONE"
            for u in found:
                _widen(entry.features, replace(u, by=(owner.name_full,) if by_nodes else ()))
            if not found:
                modelled.add(look)
        if not item.show_self:
            continue
        if entry.is_plane:
            key = None
        elif not mesh or (viewport and unfilled(obj, holder)):
            continue
        else:
            if key not in meshes:
                meshes[key] = read(obj, name, color_type == "VERTEX")
            if meshes[key] is None:
                continue
        if look not in all_colors:
            materials = [obj.active_material] if entry.is_plane else slot_materials(obj)
            all_colors[look] = instance_colors(
                obj, holder, color_type, shading.single_color, materials
            )
            if color_type == "MATERIAL" and not entry.is_plane:
                entry.empty_slots = max(entry.empty_slots, materials.count(None))
        matrix = np.array(item.matrix_world, dtype=np.float64)
        shown.append(Shown(name, owner.name_full, key, matrix, all_colors[look]))
    return seen, shown, meshes


def types_left_out(space: Any) -> set[str]:
    """Return the types of objects that a 3D view does not show, as `Object.type` has them."""
    types = bpy.types.Object.bl_rna.properties["type"].enum_items.keys()
    names = {t: "show_object_viewport_" + FILTERS.get(t, t.lower()) for t in types}
    return {t for t, name in names.items() if not getattr(space, name, True)}


def in_view(space: Any, unshown: set[str], holder: Any, layer: Any) -> bool:
    """Return whether a 3D view draws an object, or the instances by it, but for their own type.

    It draws the instances by an object of a type that it does not show, while it says of that
    object that it is hidden. (Local collections are not known then.)
    """
    if holder.type not in unshown:
        return holder.visible_in_viewport_get(space)
    is_local = not space.local_view or holder.original.local_view_get(space)
    return is_local and holder.original.visible_get(view_layer=layer)


def _widen(features: dict[str, Unmodelled], found: Unmodelled) -> None:
    """Keep one entry a feature, its bounds around all the object's instances."""
    key = found.feature + found.detail
    if before := features.get(key):
        found = replace(found, by=tuple(dict.fromkeys((*before.by, *found.by))))
        if found.bounds is not None and before.bounds is not None:
            both = np.stack((before.bounds, found.bounds))
            bounds = np.stack((both[:, 0].min(axis=0), both[:, 1].max(axis=0)))
            found = replace(found, bounds=bounds)
    features[key] = found


def read_mesh(obj: Any, name: str, with_colors: bool) -> Read | None:
    """Return the loop triangles of an evaluated object's mesh, and how many were left out.

    They are numbered as `mesh.loop_triangles`, but for those that touch a vertex that is not
    finite, which are left out; None if there is no face. `with_colors` says whether the active
    colour attribute is what will be shown.
    """
    with _plain(obj) as mesh:
        if not len(mesh.polygons):
            return None
        loops = _loops(mesh.loop_triangles)
        triangles = _read(mesh.attributes[".corner_vert"].data, "value", 1, np.int32)[loops, 0]
        slots = _slots(mesh)
        colors = _corner_colors(mesh, triangles, loops) if with_colors else None
        vertices = _read(mesh.attributes["position"].data, "vector", 3, np.float32)
    vertices, keep = drop_non_finite(vertices, triangles)
    left_out = len(keep) - int(keep.sum())
    if left_out:
        left = (a if a is None else a[keep] for a in (triangles, slots, colors))
        triangles, slots, colors = left
    return Mesh(vertices, triangles, slots, colors, name), left_out


@contextmanager
def _plain(obj: Any) -> Iterator[Any]:
    """Give an evaluated object's mesh with all of its faces and attributes.

    In Edit Mode it is a wrapper that has none, or those of the mesh in the editor.
    """
    try:
        yield obj.to_mesh() if obj.data.is_editmode else obj.data
    finally:
        obj.to_mesh_clear()


def _loops(triangles: Any) -> NDArray[np.int32]:
    """Return the corners of a mesh's loop triangles, (n, 3).

    Blender asks for them one by one. But it says where each is in memory: where they lie one behind
    the other there, and as they should, they are copied at once.
    """
    n = len(triangles)
    some = {0, 1, n // 2, n - 1} if n > 1 else set()
    first = triangles[0].as_pointer() if n > 1 else 0
    if some and all(triangles[i].as_pointer() == first + _CORNERS * i for i in some):
        loops = np.frombuffer(ctypes.string_at(first, _CORNERS * n), np.int32).reshape(n, 3)
        if all(tuple(loops[i]) == tuple(triangles[i].loops) for i in some):
            return loops
    return _read(triangles, "loops", 3, np.int32)


def _slots(mesh: Any) -> NDArray[np.int32] | None:
    """Return each triangle's material slot, (n,); None where all show the first."""
    attribute = mesh.attributes.get("material_index")
    if attribute and (attribute.domain, attribute.data_type) == ("FACE", "INT"):
        face = _read(mesh.loop_triangle_polygons, "value", 1, np.int32)
        slots = _read(attribute.data, "value", 1, np.int32)[face.ravel()]
    elif attribute:  # Blender converts another kind, which is rare
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
