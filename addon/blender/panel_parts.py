"""What the panels share: where they are, tables, and text that is broken into lines."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import bpy

from ..methods import Method

NARROW = 0.37  # of a table's width: a short name

_LETTER = 6.5  # mean width in pixels at a scale of 1: what Blender's own font has


class Properties:
    """In the Render properties."""

    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "render"


class Sidebar:
    """In the 3D view's sidebar, in a tab of its own."""

    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Reference Tracer"


def both(part: type, suffix: str = "", **in_properties: Any) -> tuple[type, type]:
    """Return a part as two panels: in the Render properties, and in the 3D view's sidebar.

    One with a suffix stands within the main one. `in_properties` is of the first alone.
    """
    made = []
    for prefix, place, more in (("RENDER", Properties, in_properties), ("VIEW3D", Sidebar, {})):
        main = f"{prefix}_PT_reference_tracer"
        parent = {"bl_parent_id": main} if suffix else {}
        made.append(type(main + suffix, (place, part, bpy.types.Panel), parent | more))
    return tuple(made)


def short_name(method: str, precision: str) -> str:
    """Return a method in a precision, as short as a narrow table needs: 'Textbook 32'."""
    name = Method(method).short
    return f"{name[0].upper()}{name[1:]} {precision.removeprefix('float')}"


def table(layout: Any, rows: Sequence[Sequence[str]], first: float = 0.45) -> None:
    """Draw rows of text in columns; `first` is the first column's share of the width."""
    split = layout.split(factor=first)
    names, rest = split.column(align=True), split.row()
    columns = [names, *(rest.column(align=True) for _ in rows[0][1:])]
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
    for line in textwrap.wrap(text, max(16, letters)):
        column.label(text=line, icon=icon)
        icon = "BLANK1" if icon != "NONE" else icon
