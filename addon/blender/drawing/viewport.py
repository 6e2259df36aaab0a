"""The viewport as a judge: Blender's window draws the camera's picture in solid shading."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from .judge import Judge

if TYPE_CHECKING:
    from bpy.types import Depsgraph, Scene


@contextmanager
def _without_anti_aliasing(scene: Scene, depsgraph: Depsgraph) -> Iterator[None]:
    """Switch off the user preference that alone decides on a window's anti-aliasing, for a while.

    The mark that preferences were changed is put back, too: else Blender would save them on exit.
    """
    import bpy

    from ..values import values_restored

    preferences = bpy.context.preferences
    with values_restored([(preferences.system, "viewport_aa"), (preferences, "is_dirty")]):
        preferences.system.viewport_aa = "OFF"
        yield


VIEWPORT = Judge(
    name="viewport",
    label="Viewport",
    ignores=("display type", "holdout", "not visible to the camera", "indirect only"),
    set_up=_without_anti_aliasing,
)
