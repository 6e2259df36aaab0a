"""The areas of all windows: to find what they show, to draw them again, to work within one."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
from bpy.types import Area, Context, Window

# Types of areas that show progress, and of the region in each.
_SAID_IN = {"PROPERTIES": "WINDOW", "VIEW_3D": "UI", "IMAGE_EDITOR": "HEADER"}


def areas(*kinds: str) -> Iterator[tuple[Any, Any]]:
    """Yield the areas of some types, with their windows: those of the context's window first."""
    context = bpy.context
    for window in sorted(context.window_manager.windows, key=lambda w: w != context.window):
        yield from ((window, area) for area in window.screen.areas if area.type in kinds)


@contextmanager
def within(window: Window, area: Area) -> Iterator[Any]:
    """Have operators work in the main region of an area for a while, and give it."""
    inside = next(r for r in area.regions if r.type == "WINDOW")
    context = bpy.context
    with context.temp_override(window=window, area=area, region=inside):
        yield inside


def redraw(context: Context) -> None:
    """Have the context's window drawn again, where there is one."""
    for area in context.window.screen.areas if context.window else ():
        area.tag_redraw()


def redraw_said() -> None:
    """Redraw what shows the progress, and nothing that costs more."""
    for _, area in areas(*_SAID_IN):
        for region in area.regions:
            if region.type == _SAID_IN[area.type]:
                region.tag_redraw()
