"""What a 3D view shows, exported for its picture, and read again only where it has changed.

Every evaluation of an object makes a new mesh with a `session_uid` of its own, which is given away
once in a session: a mesh known by it is the same. (Its address is not enough: it is given away
again.) Meshes that are being edited or painted change as they are: they are read every time, as
are those of objects whose geometry the depsgraph says is updated.
"""

from __future__ import annotations

from typing import Any

import bpy

from ...manifest import Effect
from ...scene import Camera, Scene, alike
from ..reading.export import assemble
from ..reading.visible import Read, read_mesh, types_left_out, visible


class KeptScene:
    """The scene that one 3D view shows; its meshes stay the same objects while they are the same.

    What is exported does not depend on the camera: all that is visible is in it. Pixels that see
    nothing are transparent, as Blender draws the view's background behind them; but for a colour
    that the view has of its own, which Blender draws in its solid shading alone.
    """

    def __init__(self) -> None:
        self.version = 0  # another for another scene
        self.drawings = 0  # another where Blender may draw another picture of the same scene
        self.lines: tuple[str, ...] = ()  # what the picture lacks
        self._meshes: dict[tuple[int, bool], Read] = {}
        self._scene: Scene | None = None
        self._parts: dict[str, Any] = {}
        self._look = ()  # settings of the view

    def outdated(self, scene: Any, space: Any) -> bool:
        """Return whether a `SpaceView3D` is to show other things than at the last update."""
        return self._look != _look(scene, space)

    def update(self, depsgraph: Any, space: Any) -> None:
        """Read what has changed in an evaluated depsgraph, as a `SpaceView3D` shows it."""
        ids = (u.id for u in depsgraph.updates if u.is_updated_geometry)
        objects = [o.original for o in ids if isinstance(o, bpy.types.Object)]
        changed = {o.session_uid for o in objects}
        known, self._meshes = self._meshes, {}

        def read(obj: Any, name: str, with_colors: bool) -> Read | None:
            key = obj.data.session_uid, with_colors
            found = known.get(key) if obj.original.session_uid not in changed else None
            found = found or read_mesh(obj, name, with_colors)
            if found and key[0] and obj.mode == "OBJECT" and not obj.data.is_editmode:
                self._meshes[key] = found
            return found

        shading = depsgraph.scene.display.shading  # as a render has it
        seen, shown, meshes = visible(depsgraph, shading, read, space)
        parts, _ = assemble(seen, shown, meshes)
        if space.shading.background_type == "VIEWPORT":
            parts["background"] = (*space.shading.background_color, 1.0)
        if not alike(tuple(parts.items()), tuple(self._parts.items())):
            self.version += 1
            self._parts, self._scene = parts, None
        self._look = _look(depsgraph.scene, space)
        lost = [f"{e.left_out} triangles of '{n}' left out" for n, e in seen.items() if e.left_out]
        features = [u for e in seen.values() for u in e.features.values()]
        other = [f"not modelled: {u}" for u in features if u.effect is not Effect.NONE]
        # What is not modelled may be another. (A camera is: the drawing itself has one.)
        is_other = any(o.type != "CAMERA" for o in objects) or self.lines != (*lost, *other)
        self.lines, self.drawings = (*lost, *other), self.drawings + is_other

    def scene(self, camera: Camera) -> Scene:
        """Return what has been read, as a camera sees it."""
        old = self._scene
        self._scene = old.seen_by(camera) if old else Scene(camera=camera, **self._parts)
        return self._scene


def _look(scene: Any, space: Any) -> tuple:
    """Return the settings of a view, and of its scene, on which what it shows depends."""
    s, behind = scene.display.shading, space.shading
    colors = s.color_type, s.single_color[:], behind.background_type, behind.background_color[:]
    own = types_left_out(space), space.use_local_collections, space.local_view is None
    return colors, own
