"""Remembers which engine rendered each scene last: a Render Result notes no engine but Cycles.

The scene may be set to another engine by the time that its result is compared.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.types import Image, Scene

from ..temporary import is_temporary

# Blender's names of them, by the slot that was rendered into last and the scene's `session_uid`:
# its name may become another scene's.
_engines: dict[tuple[int, int], str] = {}


@bpy.app.handlers.persistent
def begins(scene: Scene, *_: Any) -> None:
    """Remember a render that begins: one that is cancelled leaves a result, too."""
    if is_temporary(scene):
        return
    slot = _slot()
    if any(other != slot for other, _ in _engines):
        _engines.clear()  # what that slot shows of another scene from now on is not known
    _engines[slot, scene.session_uid] = scene.render.engine


def result_image() -> Image:
    """Return the image that shows Render Results; None if nothing was rendered."""
    return next((i for i in bpy.data.images if i.type == "RENDER_RESULT"), None)


def _slot() -> int:
    """Return the number of the slot that is shown, and rendered into."""
    image = result_image()
    return image.render_slots.active_index if image else 0


def engine_of_result(scene: Scene) -> str:
    """Return Blender's name of the engine that rendered a scene last; '' if that is not known.

    It is not if the slot that is shown is another than was rendered into last.
    """
    return _engines.get((_slot(), scene.session_uid), "")


def forget() -> None:
    """Forget all engines, as when another file is opened."""
    _engines.clear()
