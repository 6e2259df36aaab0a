"""Entries in Blender's own menus, as `properties.toml` lists them, and the menu of presets.

Presets are XML, which Blender reads into the scene's properties; one in Python it would run.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from .long_work import named
from .properties import SAID, ReferenceTracerScene

_GROUP = ReferenceTracerScene.__name__
_SHIPPED = str(Path(__file__).parent)  # has presets/reference_tracer/


class REFERENCE_TRACER_PT_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Reference Tracer Presets"
    preset_subdir = "reference_tracer"
    preset_operator = "script.execute_preset"
    preset_add_operator = "reference_tracer.preset_add"
    preset_type, preset_extensions = "XML", {".xml"}
    preset_xml_map = (("scene.reference_tracer", _GROUP),)
    preset_xml_secure_types = {_GROUP}


@named
class REFERENCE_TRACER_OT_preset_add(AddPresetBase, bpy.types.Operator):
    preset_menu = REFERENCE_TRACER_PT_presets.__name__
    preset_subdir = REFERENCE_TRACER_PT_presets.preset_subdir

    def add(self, context: Any, filepath: str) -> None:
        """Write the XML: Blender's own writer passes over the properties of add-ons."""
        values = {name: getattr(context.scene.reference_tracer, name) for name in SAID["scene"]}
        said = (f'{n}="{str(v).upper() if isinstance(v, bool) else v}"' for n, v in values.items())
        Path(filepath).write_text(f"<bpy><{_GROUP} {' '.join(said)} /></bpy>\n", encoding="utf-8")


def _drawing(entries: dict[str, str]) -> Callable[[Any, Any], None]:
    def draw(menu: Any, _: Any) -> None:
        menu.layout.separator()
        for operator, text in entries.items():
            menu.layout.operator(f"reference_tracer.{operator}", text=text or None)

    return draw


_DRAWN = {menu: _drawing(entries) for menu, entries in SAID["menus"].items()}


def register() -> None:
    """Add the entries, and the presets that are shipped."""
    bpy.utils.register_class(REFERENCE_TRACER_PT_presets)
    bpy.utils.register_preset_path(_SHIPPED)
    for menu, draw in _DRAWN.items():
        getattr(bpy.types, menu).append(draw)


def unregister() -> None:
    """Undo :func:`register`."""
    for menu, draw in _DRAWN.items():
        getattr(bpy.types, menu).remove(draw)
    bpy.utils.unregister_preset_path(_SHIPPED)
    bpy.utils.unregister_class(REFERENCE_TRACER_PT_presets)
