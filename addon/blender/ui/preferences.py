"""Declares what holds for all files of a user: Blender keeps it in his preferences."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.props import StringProperty
from bpy.types import Context, UILayout

from ..versions import RELATIVE


class ReferenceTracerPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__.removesuffix(".blender.ui").removesuffix(".addon")  # the extension

    folder: StringProperty(
        name="Results",
        description="Where results go if no folder is named for them: each into a folder of its "
        "file and kind. // is beside the .blend. If this is empty, only pages to look at are "
        "written, to a temporary folder",
        subtype="DIR_PATH",
        options=RELATIVE,
    )

    def draw(self, context: Context) -> None:
        layout: UILayout = self.layout
        layout.use_property_split = True
        layout.prop(self, "folder")


def default_folder(operation: str) -> str:
    """Return where an operation's results go if no folder is named for them; empty for nowhere.

    What is to lie beside the file goes nowhere until there is one.
    """
    preferences: Any = bpy.context.preferences
    addon = preferences.addons.get(ReferenceTracerPreferences.bl_idname)
    folder = addon.preferences.folder if addon else ""  # none if a script registers it
    file = bpy.data.filepath
    if not folder or (folder.startswith("//") and not file):
        return ""
    return str(Path(bpy.path.abspath(folder), Path(file).stem or "unsaved", operation))


register, unregister = bpy.utils.register_classes_factory((ReferenceTracerPreferences,))
