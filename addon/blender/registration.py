"""Registers the add-on with Blender, and unregisters it in reverse order."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy

from . import engine
from .reading import rendered
from .ui import (
    inspector,
    language,
    menus,
    panels,
    preferences,
    properties,
    split,
    study_panels,
    swatches,
)
from .ui.blocks import put_back, remember_editors
from .ui.long_work import OPERATORS, LongWork
from .ui.results import forget

MODULES = (
    language,
    properties,
    preferences,
    engine,
    menus,
    panels,
    study_panels,
    split,
    swatches,
)
# The panels import the operators.
_register, _unregister = bpy.utils.register_classes_factory(OPERATORS)


_commands: list[Any] = []  # that are registered


@bpy.app.handlers.persistent
def _file_closes(*_: Any) -> None:
    """Forget what ran in the file that is closed: Blender ends its operators."""
    rendered.forget()
    LongWork.running = ""
    inspector.REFERENCE_TRACER_OT_inspect.running = False


_HANDLERS = {
    "load_pre": _file_closes,
    "load_post": forget,
    "render_init": rendered.begins,
    "undo_pre": remember_editors,
    "undo_post": put_back,
    "redo_pre": remember_editors,
    "redo_post": put_back,
}


def register(command: Callable[[list[str]], int] | None = None) -> None:
    """Register every module of the add-on.

    A command is run by `blender FILE --command reference_tracer ...`, with the words that follow;
    Blender exits with what it returns.
    """
    for module in MODULES:
        module.register()
    _register()
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).append(handler)
    if command:
        _commands.append(bpy.utils.register_cli_command("reference_tracer", command))


def unregister() -> None:
    """Undo :func:`register`."""
    while _commands:
        bpy.utils.unregister_cli_command(_commands.pop())
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).remove(handler)
    if LongWork.running:  # Blender tells no operator that its add-on is switched off
        context = bpy.context
        window = context.window or context.window_manager.windows[0]
        with context.temp_override(window=window):  # a script may have none
            LongWork.stop(context)
    rendered.forget()
    forget()
    _unregister()
    for module in reversed(MODULES):
        module.unregister()
