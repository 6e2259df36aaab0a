"""Keeps the exported scene of a 3D view, and reads again only what has changed.

Every evaluation of an object makes a new mesh with a `session_uid` of its own, which Blender gives
away once in a session: so a mesh with the same number is the same mesh. (An address is not enough:
it is given away again.) Meshes that are being edited or painted change as they are: they are read
every time, as are those of objects with a geometry that the depsgraph has updated.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from bpy.types import Depsgraph, Object, SpaceView3D

from ...manifest import Effect
from ...scene import Camera, Scene, ViewWindow, alike
from ...wording import count_of
from ..reading.export import assemble
from ..reading.meshes import Read, read_mesh
from ..reading.visible import Seen, types_left_out, visible


class ViewScene:
    """The scene that one 3D view shows; its meshes stay the same objects while they are the same.

    All that is visible is exported, whatever the camera. Pixels that see nothing are transparent:
    Blender draws the view's background behind them. But if the view has a background colour of its
    own, which Blender draws in its solid shading alone, they have that.
    """

    def __init__(self) -> None:
        self.version = 0  # another for another scene
        self.drawings = 0  # another where Blender may draw another picture of the same scene
        self.lines: tuple[str, ...] = ()  # what the picture lacks
        self._meshes: dict[tuple[int, bool], Read] = {}
        self._scene = Scene(Camera(np.eye(4), ViewWindow(-1, 1, -1, 1), 1, 1))
        self._look: tuple[object, ...] = ()  # settings of the view

    def outdated(self, scene: bpy.types.Scene, space: SpaceView3D) -> bool:
        """Return whether a `SpaceView3D` is to show other things than at the last update."""
        return self._look != _look(scene, space)

    def update(self, depsgraph: Depsgraph, space: Any) -> None:
        """Read what has changed in an evaluated depsgraph, as a `SpaceView3D` shows it."""
        ids = (u.id for u in depsgraph.updates if u.is_updated_geometry)
        objects = [o.original for o in ids if isinstance(o, bpy.types.Object)]
        changed = {o.session_uid for o in objects}
        known = self._meshes
        self._meshes = {}

        def read(obj: Object, name: str, with_colors: bool) -> Read | None:
            key = obj.data.session_uid, with_colors
            found = known.get(key) if obj.original.session_uid not in changed else None
            found = found or read_mesh(obj, name, with_colors, True)
            if found and key[0] and obj.mode == "OBJECT" and not obj.data.is_editmode:
                self._meshes[key] = found
            return found

        shading = depsgraph.scene.display.shading  # as a render has it
        seen, shown, meshes = visible(depsgraph, shading, read, space)
        background = np.zeros(4, np.float32)
        if space.shading.background_type == "VIEWPORT":
            background = np.array((*space.shading.background_color, 1.0), np.float32)
        scene, _ = assemble(self._scene.camera, background, seen, shown, meshes)
        if not alike(scene, self._scene):
            self.version += 1
            self._scene = scene
        self._look = _look(depsgraph.scene, space)
        lines = _lines(seen)
        # What is not modelled may be another. (A camera is: the drawing itself has one.)
        if lines != self.lines or any(o.type != "CAMERA" for o in objects):
            self.drawings += 1
        self.lines = lines

    def scene(self, camera: Camera) -> Scene:
        """Return what has been read, as a camera sees it."""
        self._scene = self._scene.seen_by(camera)
        return self._scene


def _lines(seen: dict[str, Seen]) -> tuple[str, ...]:
    """Return what the picture lacks, a sentence each."""
    lost = [
        f"{count_of(e.left_out, 'triangle')} of '{name}' left out"
        for name, e in seen.items()
        if e.left_out
    ]
    features = [u for e in seen.values() for u in e.features.values()]
    return (*lost, *(f"not modelled: {u}" for u in features if u.effect is not Effect.NONE))


def _look(scene: bpy.types.Scene, space: SpaceView3D) -> tuple[object, ...]:
    """Return the settings of a view, and of its scene, on which what it shows depends."""
    shading = scene.display.shading
    behind = space.shading
    return (
        shading.color_type,
        shading.single_color[:],
        behind.background_type,
        behind.background_color[:],
        types_left_out(space),
        space.use_local_collections,
        space.local_view is None,
    )
