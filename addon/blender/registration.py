"""What Blender has to be told about, in order; unregistered in reverse."""

from __future__ import annotations

from typing import Any

import bpy

from . import engine, explain, inspector, operators, panels, properties, studies, study_panels
from .long_work import LongWork
from .results import forget

MODULES = properties, engine, operators, studies, explain, inspector, panels, study_panels


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
    bpy.app.handlers.load_pre.append(_file_closes)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.app.handlers.load_pre.remove(_file_closes)
    LongWork.stop()
    forget()
    for module in reversed(MODULES):
        module.unregister()
