"""What Blender has to be told about, in order; unregistered in reverse."""

from __future__ import annotations

from typing import Any

import bpy

from . import engine
from .ui import inspector, menus, panels, preferences, properties, study_panels
from .ui.long_work import OPERATORS, LongWork
from .ui.results import forget

MODULES = properties, preferences, engine, menus, panels, study_panels
_operators = bpy.utils.register_classes_factory(OPERATORS)  # the panels import them


@bpy.app.handlers.persistent
def _file_closes(*_: Any) -> None:
    """Forget what was found in the file that goes, and what Blender ends with it."""
    forget()
    LongWork.running = ""
    inspector.REFERENCE_TRACER_OT_inspect.running = False


def register() -> None:
    """Register every module of the add-on."""
    for module in MODULES:
        module.register()
    _operators[0]()
    bpy.app.handlers.load_post.append(preferences.set_up_new_file)
    bpy.app.handlers.load_pre.append(_file_closes)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.app.handlers.load_pre.remove(_file_closes)
    bpy.app.handlers.load_post.remove(preferences.set_up_new_file)
    LongWork.stop()
    forget()
    _operators[1]()
    for module in reversed(MODULES):
        module.unregister()
