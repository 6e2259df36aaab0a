"""What Blender has to be told about, in order; unregistered in reverse."""

from __future__ import annotations

import importlib

# Names, so that a module is imported when it is registered and not before.
MODULES = (
    *("properties", "engine", "operators", "explain", "inspector"),
    *("page", "panels", "inspector_panels", "study_panels", "commands"),
)


def register() -> None:
    """Register every module of the add-on."""
    for name in MODULES:
        importlib.import_module(f".{name}", __package__).register()


def unregister() -> None:
    """Undo :func:`register`."""
    for name in reversed(MODULES):
        importlib.import_module(f".{name}", __package__).unregister()
