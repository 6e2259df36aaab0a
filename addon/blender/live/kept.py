"""What a 3D view shows, exported for its picture, and read again only where it has changed.

Every evaluation of an object makes a new mesh with a `session_uid` of its own, which is given away
once in a session: a mesh known by it is the same. (Its address is not enough: it is given away
again.) Meshes that are being edited or painted change as they are: they are read every time, as
are those of objects whose geometry the depsgraph says is updated.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from ...manifest import Effect
from ...scene import Camera, Mesh, Scene
from ..export import assemble
from ..visible import export_mesh, plain_mesh, read_vertices, visible

_Read = tuple[Mesh, int]  # with the triangles left out


class KeptScene:
    """The scene that one 3D view shows; its meshes stay the same objects while they are the same.

    What is exported does not depend on the camera: all that is visible is in it. Pixels that see
    nothing are transparent: Blender draws the view's own background behind them.
    """

    def __init__(self) -> None:
        self.meshes_read = 0  # by the last update
        self.lines: tuple[str, ...] = ()  # what the picture lacks
        self._meshes: dict[tuple[int, bool], _Read] = {}
        self._scene: Scene | None = None
        self._parts: dict[str, tuple] = {}

    def update(self, depsgraph: Any, space: Any) -> None:
        """Read what has changed in an evaluated depsgraph, as a `SpaceView3D` shows it."""
        with_colors = space.shading.color_type == "VERTEX"
        objects = (u.id for u in depsgraph.updates if u.is_updated_geometry)
        changed = {o.original.session_uid for o in objects if isinstance(o, bpy.types.Object)}
        now: dict[tuple[int, bool], _Read] = {}
        self.meshes_read = 0

        def meet(obj: Any, name: str) -> _Read | None:
            key = obj.data.session_uid, with_colors
            if key in self._meshes and obj.original.session_uid not in changed:
                now[key] = self._meshes[key]
                return now[key]
            with plain_mesh(obj) as mesh:
                if not len(mesh.polygons):
                    return None
                read = export_mesh(mesh, read_vertices(mesh), name, with_colors)
            self.meshes_read += 1
            if key[0] and obj.mode == "OBJECT" and not obj.data.is_editmode:
                now[key] = read
            return read

        seen, shown, met = visible(depsgraph, space.shading, meet, space)
        self._meshes, self._scene = now, None
        unseen = np.zeros(len(shown), bool)
        self._parts, _ = assemble(seen, shown, unseen, {k: m for k, m in met.items() if m})
        features = [u for e in seen.values() for u in e.features.values()]
        self.lines = (
            *(f"{e.left_out} triangles of '{n}' left out" for n, e in seen.items() if e.left_out),
            *(f"not modelled: {u}" for u in features if u.effect is not Effect.NONE),
        )

    def scene(self, camera: Camera) -> Scene:
        """Return what has been read, as a camera sees it."""
        if self._scene is None:
            self._scene = Scene(camera=camera, **self._parts)
        return self._scene.seen_by(camera)
