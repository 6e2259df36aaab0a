"""What panels share: where they stand, tables, and sentences as wide as the panel."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ...methods import Method

NARROW = 0.37  # the first column's share of a table's width, for short names
_LETTER = 6.5  # mean width in pixels at a scale of 1: what Blender's own font has
_PROPERTIES = {"bl_space_type": "PROPERTIES", "bl_region_type": "WINDOW", "bl_context": "render"}
_SIDEBAR = {"bl_space_type": "VIEW_3D", "bl_region_type": "UI", "bl_category": "Reference Tracer"}


class Part:
    """Mixed into a panel: its class has the rest."""

    layout: Any


def both(part: type, suffix: str = "", **in_properties: Any) -> list[type]:
    """Return a part as two panels: in the Render properties, and in the 3D view's sidebar.

    A part with a suffix stands within the main panel. Only the first panel has `in_properties`.
    """
    made = []
    for prefix, place in (("RENDER", _PROPERTIES | in_properties), ("VIEW3D", _SIDEBAR)):
        main = f"{prefix}_PT_reference_tracer"
        parent = {"bl_parent_id": main} if suffix else {}
        made.append(type(main + suffix, (part, bpy.types.Panel), place | parent))
    return made


def short_name(row: Any) -> str:
    """Return a row's method and precision, short enough for a narrow table: 'Textbook 32'."""
    name = Method(row.method).record.short
    return f"{name[0].upper()}{name[1:]} {row.precision.removeprefix('float')}"


def draw_table(layout: Any, rows: Sequence[Sequence[str]], first: float = 0.45) -> None:
    """Draw rows of text in columns; `first` is the first column's share of the width."""
    split = layout.split(factor=first)
    columns = [split.column(align=True)]
    rest = split.row()
    columns += [rest.column(align=True) for _ in rows[0][1:]]
    for column in columns:
        column.scale_y = 0.8
    for row in rows:
        for column, text in zip(columns, row, strict=True):
            column.label(text=text)


def wrapped(layout: Any, context: Any, text: str, icon: str = "NONE") -> None:
    """Draw a sentence in as many lines as the panel's width needs."""
    scale = context.preferences.system.ui_scale
    letters = int(context.region.width / scale / _LETTER) - (10 if icon != "NONE" else 6)
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in textwrap.wrap(iface_(text), max(16, letters)):
        column.label(text=line, icon=icon, translate=False)
        icon = "BLANK1" if icon != "NONE" else icon
