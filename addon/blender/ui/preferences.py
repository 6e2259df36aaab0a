"""Declares what holds for all files of a user: Blender keeps it in his preferences."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.props import EnumProperty, StringProperty

from ..versions import RELATIVE
from . import choices


class ReferenceTracerPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__.rsplit(".", 2)[0]  # what has `addon/blender`: the extension

    folder: StringProperty(
        name="Results",
        description="Where results go if no folder is named for them: each into a folder of its "
        "file and kind. // is beside the .blend. If this is empty, only pages to look at are "
        "written, to a temporary folder",
        subtype="DIR_PATH",
        options=RELATIVE,
    )
    method: EnumProperty(
        name="Method of New Files",
        description="The method of scenes in new files. Files that are opened keep their own",
        items=choices.METHODS,
        default="auto",
    )

    def draw(self, context: Any) -> None:
        layout: Any = self.layout
        layout.use_property_split = True
        layout.prop(self, "folder")
        layout.prop(self, "method")


def _preferences() -> Any:
    """Return what the user prefers; None where the add-on is not one of Blender's."""
    preferences: Any = bpy.context.preferences
    addon = preferences.addons.get(ReferenceTracerPreferences.bl_idname)
    return addon and addon.preferences


def default_folder(operation: str) -> str:
    """Return where an operation's results go if no folder is named for them; empty for nowhere.

    What is to lie beside the file goes nowhere until there is one.
    """
    own = _preferences()
    file = bpy.data.filepath
    if not (own and own.folder) or (own.folder.startswith("//") and not file):
        return ""
    return str(Path(bpy.path.abspath(own.folder), Path(file).stem or "unsaved", operation))


@bpy.app.handlers.persistent
def set_up_new_file(*_: Any) -> None:
    """Give the scenes of a new file the method that is preferred; one that is stored stays."""
    own = _preferences()
    if own and own.method != "auto" and not bpy.data.filepath:
        scenes: Any = bpy.data.scenes
        for stored in (scene.reference_tracer for scene in scenes):
            if not stored.is_property_set("method"):
                stored.method = own.method


register, unregister = bpy.utils.register_classes_factory((ReferenceTracerPreferences,))
