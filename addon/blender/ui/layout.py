"""Helpers that panels share: where they stand, what is folded, facts, and sentences in lines."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.types import Context, UILayout

from ...methods import Method
from ...wording import capital

_NAMES = 0.56  # the names' share of a list of facts
_NAME, _VALUE = 0.37, 0.58  # those of a setting's name and of what stands beside it
# In pixels at a scale of 1: what a panel's frame, and a box in it, take of a region's width.
_SIDE = 66  # a sidebar's, which has tabs, too
_MARGINS = {"WINDOW": 50}
_ICON = 22
_BETWEEN = 8  # two columns, and in a box
_PROPERTIES = {"bl_space_type": "PROPERTIES", "bl_region_type": "WINDOW", "bl_context": "render"}
_SIDEBAR = {"bl_space_type": "VIEW_3D", "bl_region_type": "UI", "bl_category": "Reference Tracer"}


class Part:
    """Mixed into a panel: its class has the rest."""

    layout: UILayout


def both(part: type, suffix: str = "", **more: Any) -> list[type]:
    """Return a part as two panels: in the Render properties, and in the 3D view's sidebar.

    A part with a suffix stands within the main panel. Both have `more`.
    """
    made = []
    for prefix, place in (("RENDER", _PROPERTIES), ("VIEW3D", _SIDEBAR)):
        main = f"{prefix}_PT_reference_tracer"
        parent = {"bl_parent_id": main} if suffix else {}
        made.append(type(main + suffix, (part, bpy.types.Panel), place | parent | more))
    return made


def short_name(row: Any) -> str:
    """Return a row's method and precision, in short: 'Textbook 32'."""
    name = Method(row.method).record.short
    return f"{capital(name)} {row.precision.removeprefix('float')}"


def draw_facts(layout: UILayout, context: Context, facts: Iterable[tuple[str, str]]) -> None:
    """Draw names and values in two columns, or as sentences where one has no room."""
    names, values = zip(*((iface_(name), iface_(value)) for name, value in facts), strict=True)
    if not (fit(context, names, _NAMES, _BETWEEN) and fit(context, values, 1 - _NAMES, _BETWEEN)):
        for name, value in zip(names, values, strict=True):
            wrapped(layout, context, f"{name}: {value}")
        return
    split = layout.split(factor=_NAMES)
    columns = split.column(align=True), split.column(align=True)
    columns[1].alignment = "RIGHT"
    for column in columns:
        column.scale_y = 0.8
    for column, texts in zip(columns, (names, values), strict=True):
        for text in texts:
            column.label(text=text, translate=False)


def folded(layout: UILayout, key: str, title: str) -> UILayout:
    """Add a part of a panel that is closed at first; None while it is."""
    head, body = layout.panel(f"reference_tracer_{key}", default_closed=True)
    head.label(text=title)
    return body


def setting(layout: UILayout, context: Context, owner: Any, name: str) -> None:
    """Draw a setting beside its name, or below it where either has no room there."""
    known = owner.bl_rna.properties[name]
    is_box = known.type == "BOOLEAN"  # a checkbox shows its own label
    values = [known.name] if is_box else [item.name for item in getattr(known, "enum_items", ())]
    if fit(context, values, _VALUE) and (is_box or fit(context, [known.name], _NAME, 0)):
        layout.prop(owner, name)
        return
    column = layout.column(align=True)
    column.use_property_split = False
    if not is_box:
        column.label(text=known.name)
    column.prop(owner, name, text=None if is_box else "")


def button(layout: UILayout, context: Context, operator: Any, icon: Any) -> None:
    """Draw an operator's button, with an icon where there is room for both."""
    has_room = fit(context, [operator.bl_label], 1.0)
    layout.operator(operator.bl_idname, icon=icon if has_room else "NONE")


def beside(layout: UILayout, context: Context, texts: Sequence[str]) -> UILayout:
    """Return a row for buttons of these texts, or a column where they have no room in a row."""
    return (layout.row if fit(context, texts, 1 / len(texts)) else layout.column)(align=True)


def fit(context: Context, texts: Iterable[str], share: float, icon: float = _ICON) -> bool:
    """Return whether each text, beside an icon, is one line in a share of the panel's width."""
    size, width = _measured(context, share, icon)
    return all(len(lines(iface_(text), width, size)) == 1 for text in texts)


def _measured(context: Context, share: float, icon: float) -> tuple[float, float]:
    """Return the size of the font, and the width of a share of the panel less an icon, pixels."""
    preferences = context.preferences
    scale = preferences.system.ui_scale
    taken = _MARGINS.get(context.region.type, _SIDE)
    width = (context.region.width - taken * scale) * share - icon * scale
    return preferences.ui_styles[0].widget.points * scale, width


def wrapped(
    layout: UILayout, context: Context, text: str, icon: Any = "NONE", swatch: int = 0
) -> None:
    """Draw a sentence in as many lines as the panel's width needs, beside an icon or a swatch."""
    has_icon = bool(swatch) or icon != "NONE"
    size, width = _measured(context, 1.0, _ICON if has_icon else 0)
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in lines(iface_(text), width, size):
        column.label(text=line, icon=icon, icon_value=swatch, translate=False)
        icon = "BLANK1" if has_icon else icon
        swatch = 0


@lru_cache(256)  # a panel is drawn many times a second
def lines(text: str, width: float, size: float) -> tuple[str, ...]:
    """Return a text in lines of Blender's font that are no wider, in pixels, where words allow."""
    import blf

    def wide(text: str) -> float:
        blf.size(0, size)
        found: float = blf.dimensions(0, text)[0]
        return found

    made: list[str] = []
    for word in text.split():
        if made and wide(f"{made[-1]} {word}") <= width:
            made[-1] += f" {word}"
        else:  # a name may be longer than a line
            letters = int(len(word) * width / max(wide(word), width))
            made += textwrap.wrap(word, max(letters, 1), break_on_hyphens=False)
    return tuple(made)
