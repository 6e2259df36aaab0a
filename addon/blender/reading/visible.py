"""Finds what is visible in an evaluated depsgraph: each appearance of a mesh or infinite plane.

The depsgraph hands out every object that has triangles as a mesh: text, curves, surfaces, metaballs
and what geometry nodes make, with all instances. There may be ten thousand instances: so Blender is
asked for little of each.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import bpy
import numpy as np
from bpy.types import (
    Depsgraph,
    DepsgraphObjectInstance,
    Object,
    SpaceView3D,
    View3DShading,
    ViewLayer,
)

from ...arrays import Colors, Floats
from ...manifest import Unmodelled
from ..temporary import ignored_features
from ..versions import FILTERS
from .colors import instance_colors, slot_materials
from .meshes import Read
from .unmodelled import HAIR, Viewing, of_object, unfilled


@dataclass
class Seen:
    """The appearances of an object that were found so far."""

    type: str
    is_plane: bool
    mesh_keys: dict[int, None] = field(default_factory=dict)  # in the order in which they came
    instances: int = 0
    outside: int = 0  # instances that no ray can meet: not exported
    triangles: int = 0  # over all instances
    left_out: int = 0
    empty_slots: int = 0
    features: dict[str, Unmodelled] = field(default_factory=dict)


class Shown(NamedTuple):
    """One appearance of an object: of a mesh, by its address, or as an infinite plane.

    Blender gives it the colour of the `owner`: of an instance, that is what instances it.
    """

    name: str
    owner: str
    key: int | None  # the mesh's address; None for an infinite plane
    matrix: Floats  # (4, 4) world_from_object
    colors: Colors  # (k, 4) linear RGBA of each material slot


# An object by its name, the address of its mesh, and the colour that it takes of what instances it:
# appearances that are equal in these have the same colours and features.
_Look = tuple[str, int | None, tuple[float, ...] | None]


def visible(
    depsgraph: Depsgraph,
    shading: View3DShading,
    read: Callable[[Any, str, bool], Read | None],
    space: SpaceView3D | None = None,
) -> tuple[dict[str, Seen], list[Shown], dict[int, Read]]:
    """Return what is visible by name, every appearance of it, and the meshes by address.

    Parameters
    ----------
    depsgraph : bpy.types.Depsgraph
    shading : bpy.types.View3DShading
    read : callable
        :func:`.meshes.read_mesh`, or what knows some meshes already; called once for each mesh.
    space : bpy.types.SpaceView3D, optional
        Only what is shown in this 3D view: its local view, local collections and types of objects.
    """
    looking = _Looking(depsgraph, shading, read, space)
    for item in depsgraph.object_instances:
        looking.add(item)
    meshes = {key: mesh for key, mesh in looking.meshes.items() if mesh}
    return looking.seen, looking.shown, meshes


class _Looking:
    """Goes through the instances of a depsgraph, and remembers what they have shown."""

    def __init__(
        self,
        depsgraph: Depsgraph,
        shading: View3DShading,
        read: Callable[[Any, str, bool], Read | None],
        space: SpaceView3D,
    ) -> None:
        ignored = ignored_features(depsgraph.scene) or ()
        viewport = depsgraph.mode == "VIEWPORT"
        self._viewing = Viewing(shading, depsgraph.view_layer, viewport, ignored)
        self._read = read
        self._space = space
        self._unshown = types_left_out(space) if space else set()
        self.seen: dict[str, Seen] = {}
        self.shown: list[Shown] = []
        self.meshes: dict[int, Read | None] = {}  # None: it has no face
        self._modelled: set[_Look] = set()  # as a whole
        self._colors: dict[_Look, Colors] = {}

    def add(self, item: DepsgraphObjectInstance) -> None:
        """Take in a `bpy.types.DepsgraphObjectInstance`."""
        obj = item.object
        # Once a script has looked at an evaluated object, Blender (4.3 to 5.2) hands out that for
        # an instance of it. So what an instance has of its holder is asked of the holder.
        holder = item.parent if item.is_instance else obj
        if not self._is_drawn(obj, holder):
            return
        name = obj.original.name_full
        if name not in self.seen:
            original: Any = obj.original
            self.seen[name] = Seen(original.type, original.reference_tracer.infinite_plane)
        entry = self.seen[name]
        if not (item.show_self or item.show_particles):
            return
        viewing = self._viewing
        address = obj.data.as_pointer() if obj.type == "MESH" else None
        inherits = viewing.shading.color_type in ("OBJECT", "VERTEX")
        look = name, address, tuple(holder.color) if inherits else None
        if look not in self._modelled and not self._add_features(entry, item, holder):
            self._modelled.add(look)
        if not item.show_self:
            return
        key = None if entry.is_plane else address
        if not entry.is_plane:
            if key is None or (viewing.viewport and unfilled(obj, holder)):
                return
            if key not in self.meshes:
                self.meshes[key] = self._read(obj, name, viewing.shading.color_type == "VERTEX")
            if self.meshes[key] is None:
                return
        if look not in self._colors:
            self._colors[look] = self._colors_of(entry, obj, holder)
        matrix = np.array(item.matrix_world, dtype=np.float64)
        owner = holder.original.name_full
        self.shown.append(Shown(name, owner, key, matrix, self._colors[look]))

    def _is_drawn(self, obj: Object, holder: Object) -> bool:
        """Return whether this view draws what the depsgraph hands out.

        It also hands out what only the eye of a collection hides.
        """
        layer = self._viewing.layer
        if self._space:
            in_types = obj.type not in self._unshown
            return in_types and in_view(self._space, self._unshown, holder, layer)
        return not self._viewing.viewport or holder.original.visible_get(view_layer=layer)

    def _add_features(self, entry: Seen, item: DepsgraphObjectInstance, holder: Object) -> bool:
        """Add what is not modelled of an appearance; return whether there is any."""
        found = list(of_object(item.object, holder, item.matrix_world, self._viewing))
        if not item.show_self:  # its hair is shown without it
            found = [u for u in found if u.feature == HAIR]
        by_nodes = item.is_instance and holder.original.instance_type == "NONE"
        by = (holder.original.name_full,) if by_nodes else ()
        for feature in found:
            _widen(entry.features, replace(feature, by=by))
        return bool(found)

    def _colors_of(self, entry: Seen, obj: Object, holder: Object) -> Colors:
        shading = self._viewing.shading
        materials = [obj.active_material] if entry.is_plane else slot_materials(obj)
        if shading.color_type == "MATERIAL" and not entry.is_plane:
            entry.empty_slots = max(entry.empty_slots, materials.count(None))
        return instance_colors(obj, holder, shading, materials)


def types_left_out(space: SpaceView3D) -> set[str]:
    """Return the types of objects that a 3D view does not show, as `Object.type` has them."""
    of_type: Any = bpy.types.Object.bl_rna.properties["type"]
    types = of_type.enum_items.keys()
    names = {t: "show_object_viewport_" + FILTERS.get(t, t.lower()) for t in types}
    return {t for t, name in names.items() if not getattr(space, name, True)}


def in_view(space: SpaceView3D, unshown: set[str], holder: Object, layer: ViewLayer) -> bool:
    """Return whether a 3D view draws an object or the instances by it, whatever their own type.

    Blender says that an object of a type that the view does not show is hidden, but draws the
    instances by it. (Local collections are not known then.)
    """
    if holder.type not in unshown:
        return holder.visible_in_viewport_get(space)
    is_local = not space.local_view or holder.original.local_view_get(space)
    return is_local and holder.original.visible_get(view_layer=layer)


def _widen(features: dict[str, Unmodelled], found: Unmodelled) -> None:
    """Add a feature, or widen its bounds: it has one entry for all of an object's instances."""
    key = found.feature + found.detail
    if before := features.get(key):
        found = replace(found, by=tuple(dict.fromkeys((*before.by, *found.by))))
        if found.bounds is not None and before.bounds is not None:
            both = np.stack((before.bounds, found.bounds))
            bounds = np.stack((both[:, 0].min(axis=0), both[:, 1].max(axis=0)))
            found = replace(found, bounds=bounds)
    features[key] = found
