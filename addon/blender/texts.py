"""Texts of the add-on's own in Blender's text editor."""

from __future__ import annotations

from typing import Any

import bpy

from .images import MARK


def show(context: Any, name: str, content: str) -> Any:
    """Put a text into ours of this name, made where it is not there, and show it if it can be.

    One that the user has saved to a file is theirs, and is left as it is.
    """
    text = next((t for t in bpy.data.texts if t.get(MARK) == name), None)
    if text and text.filepath:
        del text[MARK]
        text = None
    if text is None:
        text = bpy.data.texts.new(name)
        text[MARK] = name
    text.from_string(content)
    for area in context.window.screen.areas if context.window else ():
        if area.type == "TEXT_EDITOR":
            area.spaces.active.text = text
            area.spaces.active.top = 0
            break
    return text
