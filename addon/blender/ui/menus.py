"""Adds entries to Blender's own menus, and the menu of presets.

Presets are XML, which Blender reads into the scene's properties; one in Python it would run.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, ElementTree, SubElement

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
from bpy.types import Context, Header, Menu

from .long_work import named
from .outcome import draw_in_header
from .properties import ReferenceTracerScene
from .samples import REFERENCE_TRACER_MT_samples
from .select_seen import REFERENCE_TRACER_MT_select_seen
from .shown import chosen, draw_switch

_GROUP = ReferenceTracerScene.__name__
_SHIPPED = str(Path(__file__).parent)  # has presets/reference_tracer/


class REFERENCE_TRACER_PT_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Reference Tracer Presets"
    preset_subdir = "reference_tracer"
    preset_operator = "script.execute_preset"
    preset_add_operator = "reference_tracer.preset_add"
    preset_type = "XML"
    preset_extensions = {".xml"}
    preset_xml_map = (("scene.reference_tracer", _GROUP),)
    preset_xml_secure_types = {_GROUP}


@named
class REFERENCE_TRACER_OT_preset_add(AddPresetBase, bpy.types.Operator):
    bl_label = "Add Reference Tracer Preset"
    bl_description = "Store the panel's settings under a name, or remove the chosen preset"
    preset_menu = REFERENCE_TRACER_PT_presets.__name__
    preset_subdir = REFERENCE_TRACER_PT_presets.preset_subdir

    def add(self, context: Any, filepath: str) -> None:
        """Write the XML: Blender's own writer passes over the properties of add-ons."""
        stored = context.scene.reference_tracer
        names = [n for n in ReferenceTracerScene.__annotations__ if n != "image"]  # of one file
        values = {name: getattr(stored, name) for name in names}
        texts = {n: str(v).upper() if isinstance(v, bool) else str(v) for n, v in values.items()}
        root = Element("bpy")
        SubElement(root, _GROUP, texts)
        ElementTree(root).write(filepath)


def _with(**operators: str | None) -> Callable[[Menu, Context], None]:
    """Return what draws entries for operators of ours, with other texts than theirs if given."""

    def draw(menu: Menu, context: Context) -> None:
        menu.layout.separator()
        for name, text in operators.items():
            menu.layout.operator(f"reference_tracer.{name}", text=text)

    return draw


def _with_menu(kind: type[Menu]) -> Callable[[Menu, Context], None]:
    """Return what draws a menu of ours below another."""

    def draw(menu: Menu, context: Context) -> None:
        menu.layout.separator()
        menu.layout.menu(kind.__name__)

    return draw


def _draw_in_header(header: Header, context: Any) -> None:
    if chosen(context.space_data):
        draw_in_header(header.layout, context)
        draw_switch(header.layout.row(align=True), context.space_data)


MENUS = {
    "TOPBAR_MT_render": _with(
        compare=None,
        compare_all=None,
        compare_animation=None,
        write_colors=None,
        inspect=None,
        open_page=None,
    ),
    "IMAGE_MT_image": _with(inspect=None, save_pixel="Save Pixel...", open_page=None),
    "TOPBAR_MT_file_export": _with(
        export="Reference Tracer (.npz)",
        export_camera="Camera for Other Programs (.json, .txt, .gltf, .xml)",
    ),
    "TOPBAR_MT_file_new": _with_menu(REFERENCE_TRACER_MT_samples),
    "VIEW3D_MT_select_object": _with_menu(REFERENCE_TRACER_MT_select_seen),
    "VIEW3D_MT_select_edit_mesh": _with_menu(REFERENCE_TRACER_MT_select_seen),
}


_register, _unregister = bpy.utils.register_classes_factory(
    (REFERENCE_TRACER_PT_presets, REFERENCE_TRACER_MT_samples, REFERENCE_TRACER_MT_select_seen)
)


def register() -> None:
    """Add the entries, and the presets that are shipped."""
    _register()
    bpy.utils.register_preset_path(_SHIPPED)
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).append(draw)
    bpy.types.IMAGE_HT_header.prepend(_draw_in_header)  # a small window shows the first of it


def unregister() -> None:
    """Undo :func:`register`."""
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).remove(draw)
    bpy.types.IMAGE_HT_header.remove(_draw_in_header)
    bpy.utils.unregister_preset_path(_SHIPPED)
    _unregister()
