"""What a 3D view shows, exported for its picture, and read again only where it has changed.

Every evaluation of an object makes a new mesh with a `session_uid` of its own, which is given away
once in a session: a mesh known by it is the same. (Its address is not enough: it is given away
again.) Meshes that are being edited or painted change as they are: they are read every time, as
are those of objects whose geometry the depsgraph says is updated.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from ...manifest import Effect
from ...scene import Camera, Mesh, Scene
from ..export import NO_SURFACE, assemble
from ..unmodelled import unfilled
from ..visible import export_mesh, plain_mesh, read_vertices, types_left_out, visible

_Read = tuple[Mesh, int]  # with the triangles left out


class KeptScene:
    """The scene that one 3D view shows; its meshes stay the same objects while they are the same.

    What is exported does not depend on the camera: all that is visible is in it. Pixels that see
    nothing are transparent, as Blender draws the view's background behind them; but for a colour
    that the view has of its own, which Blender draws in its solid shading alone.
    """

    def __init__(self) -> None:
        self.meshes_read = 0  # by the last update
        self.lines: tuple[str, ...] = ()  # what the picture lacks
        self._meshes: dict[tuple[int, bool], _Read] = {}
        self._scene: Scene | None = None
        self._parts: dict[str, Any] = {}
        self._look, self._of = (), ("", "")  # settings of the view; scene and view layer
        self._alone: dict[str, int] = {}  # instances that move with an object, which has no other
        self._bound: set[str] = set()  # other objects that what is shown depends on

    def outdated(self, space: Any) -> bool:
        """Return whether a `SpaceView3D` is to show other things than at the last update."""
        return self._look != _look(space)

    def update(self, depsgraph: Any, space: Any) -> None:
        """Read what has changed in an evaluated depsgraph, as a `SpaceView3D` shows it."""
        self.meshes_read, of = 0, (depsgraph.scene.name_full, depsgraph.view_layer.name)
        if self.outdated(space) or of != self._of or not self._move(depsgraph):
            self._look, self._of = (), of  # should reading fail, all is looked at again
            self._read(depsgraph, space)
            self._look = _look(space)

    def scene(self, camera: Camera) -> Scene:
        """Return what has been read, as a camera sees it."""
        old = self._scene
        self._scene = old.seen_by(camera) if old else Scene(camera=camera, **self._parts)
        return self._scene

    def _move(self, depsgraph: Any) -> bool:
        """Move single objects if nothing else has changed; return whether that is so."""
        moved: dict[int, np.ndarray] = {}
        for update in depsgraph.updates:
            obj, other = update.id, update.is_updated_geometry or update.is_updated_shading
            if other or not update.is_updated_transform or not isinstance(obj, bpy.types.Object):
                return False
            name, matrix = obj.name_full, np.array(obj.matrix_world, np.float64)
            if obj.instance_type != "NONE" or name in self._bound or unfilled(obj, obj):
                return False
            if name in self._alone and np.isfinite(matrix).all():
                moved[self._alone[name]] = matrix
            elif obj.type not in NO_SURFACE:
                return False
        if moved:
            instances = list(self._parts["instances"])
            for number, matrix in moved.items():
                instances[number] = replace(instances[number], world_from_object=matrix)
            self._parts, self._scene = self._parts | {"instances": tuple(instances)}, None
        return len(depsgraph.updates) > 0

    def _read(self, depsgraph: Any, space: Any) -> None:
        with_colors = space.shading.color_type == "VERTEX"
        objects = (u.id for u in depsgraph.updates if u.is_updated_geometry)
        changed = {o.original.session_uid for o in objects if isinstance(o, bpy.types.Object)}
        kept: dict[tuple[int, bool], _Read] = {}

        def meet(obj: Any, name: str) -> _Read | None:
            key = obj.data.session_uid, with_colors
            if key in self._meshes and obj.original.session_uid not in changed:
                kept[key] = self._meshes[key]
                return kept[key]
            with plain_mesh(obj) as mesh:
                if not len(mesh.polygons):
                    return None
                read = export_mesh(mesh, name, read_vertices(mesh), with_colors)
            self.meshes_read += 1
            if key[0] and obj.mode == "OBJECT" and not obj.data.is_editmode:
                kept[key] = read
            return read

        seen, shown, met = visible(depsgraph, space.shading, meet, space)
        unseen, meshes = np.zeros(len(shown), bool), {k: m for k, m in met.items() if m}
        self._parts, surfaces = assemble(seen, shown, unseen, meshes)
        if space.shading.background_type == "VIEWPORT":
            self._parts["background"] = (*space.shading.background_color, 1.0)
        self._meshes, self._scene = kept, None
        self._alone, self._bound = {}, set()
        for number, s in enumerate(surfaces):
            if s.key and not s.is_instance:
                self._alone[s.name] = number
            else:
                self._bound |= {s.name, s.owner}
        lost = [f"{e.left_out} triangles of '{n}' left out" for n, e in seen.items() if e.left_out]
        features = [u for e in seen.values() for u in e.features.values()]
        other = [f"not modelled: {u}" for u in features if u.effect is not Effect.NONE]
        self.lines = (*lost, *other)


def _look(space: Any) -> tuple:
    """Return the settings of a view on which the scene that it shows depends."""
    s = space.shading
    colors = s.color_type, s.single_color[:], s.background_type, s.background_color[:]
    own = types_left_out(space), space.use_local_collections, space.local_view is None
    return colors, own
