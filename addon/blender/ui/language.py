"""Gives Blender the interface's words in other languages."""

from __future__ import annotations

from typing import Any

import bpy

from ...translations import tables

_CONTEXTS = bpy.app.translations.contexts.default, bpy.app.translations.contexts.operator_default


def register() -> None:
    """Add the words, as names of operators and of all else."""
    known: Any = {
        language: {(context, text): said for text, said in table.items() for context in _CONTEXTS}
        for language, table in tables("blender").items()
    }
    bpy.app.translations.register(__package__, known)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.app.translations.unregister(__package__)
