"""The source of a scene's variants: the export, and the Blender scene that it is of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy

from ....pictures.palette import Palette
from ....scene import Scene
from ...evaluating import export_for_render


@dataclass(frozen=True, eq=False)
class Origin:
    """A scene of Blender's, and what is exported of it."""

    scene: bpy.types.Scene  # the user's
    layer: str
    tmp: bpy.types.Scene  # a temporary copy of it
    exported: Scene  # with all that the view leaves out
    palette: Palette  # its colours

    def again(self) -> Scene:
        """Export the temporary scene as it is now."""
        return export_for_render(self.tmp)[0]

    @property
    def objects(self) -> dict[str, Any]:
        """The objects that are exported, by their names there."""
        there = {obj.name_full: obj for obj in self.scene.objects}
        return {name: there[name] for name in self.exported.objects if name in there}
