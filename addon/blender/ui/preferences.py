"""What holds for all files of a user: Blender keeps it in his preferences."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.props import EnumProperty, StringProperty

from ..versions import RELATIVE
from .properties import METHOD_ITEMS, SAID

_SAID = SAID["preferences"]


class ReferenceTracerPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__.rsplit(".", 2)[0]  # what has `addon/blender`: the extension

    folder: StringProperty(options=RELATIVE, **_SAID["folder"])  # type: ignore[valid-type]
    method: EnumProperty(items=METHOD_ITEMS, **_SAID["method"])  # type: ignore[valid-type]

    def draw(self, context: Any) -> None:
        self.layout.use_property_split = True
        for name in _SAID:
            self.layout.prop(self, name)


def preferred(name: str) -> Any:
    """Return what the user prefers; the default where the add-on is not one of Blender's."""
    addon = bpy.context.preferences.addons.get(ReferenceTracerPreferences.bl_idname)
    return getattr(addon and addon.preferences, name, _SAID[name]["default"])


def default_folder(operation: str) -> str:
    """Return where an operation's results go that no folder is named for; empty for nowhere.

    What is to lie beside the file goes nowhere until there is one.
    """
    folder, file = preferred("folder"), bpy.data.filepath
    if not folder or (folder.startswith("//") and not file):
        return ""
    return str(Path(bpy.path.abspath(folder), Path(file).stem or "unsaved", operation))


@bpy.app.handlers.persistent
def set_up_new_file(*_: Any) -> None:
    """Give the scenes of a new file the method that is preferred; one that is stored stays."""
    method = preferred("method")
    if not bpy.data.filepath and method != _SAID["method"]["default"]:
        for scene in bpy.data.scenes:
            if not scene.reference_tracer.is_property_set("method"):
                scene.reference_tracer.method = method


register, unregister = bpy.utils.register_classes_factory((ReferenceTracerPreferences,))
