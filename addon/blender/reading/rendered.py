"""Remembers which engine rendered each scene last: a Render Result notes no engine but Cycles.

The scene may be set to another engine by the time that its result is compared.
"""

from __future__ import annotations

from typing import Any

import bpy

from ..temporary import is_temporary

# Blender's names of them, by the scene's `session_uid`: its name may become another scene's.
_engines: dict[int, str] = {}


@bpy.app.handlers.persistent
def _begins(scene: Any, *_: Any) -> None:
    if not is_temporary(scene):
        _engines[scene.session_uid] = scene.render.engine


def engine_of_result(scene: Any) -> str:
    """Return Blender's name of the engine that rendered a scene last; '' if that is not known."""
    return _engines.get(scene.session_uid, "")


def forget() -> None:
    """Forget all engines, as when another file is opened."""
    _engines.clear()


def register() -> None:
    """Hear of each render that begins: one that is cancelled leaves a result, too."""
    bpy.app.handlers.render_init.append(_begins)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.app.handlers.render_init.remove(_begins)
    forget()
