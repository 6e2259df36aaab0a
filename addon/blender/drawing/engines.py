"""Makes judges of the engines that add-ons register: no more is known of these than their names.

They are shown constant colours as Cycles is. How they sample and round is not known, so that their
pictures are compared as anybody's are.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy

from ..temporary import ENGINE
from .judge import Judge

_OWN = ("BLENDER_", "CYCLES", ENGINE)  # how the names of engines begin that are no add-on's


def others() -> dict[str, Judge]:
    """Return the judges that the engines of add-ons are in this Blender, by name."""
    engines = [e for e in _registered(bpy.types.RenderEngine) if not e.bl_idname.startswith(_OWN)]
    return {e.bl_idname.lower(): _judge(e.bl_idname, e.bl_label) for e in engines}


def _registered(base: Any) -> Iterator[Any]:
    """Yield the classes below one that Blender knows now: those that were are still in Python."""
    for engine in base.__subclasses__():
        if "bl_rna" in vars(engine) and hasattr(engine, "bl_idname"):
            yield engine
        yield from _registered(engine)


def _judge(engine: str, label: str) -> Judge:
    return Judge(
        name=engine.lower(),
        label=label,
        engine=engine,
        ignores=("display type", "transparency", "texture", "in-front drawing", "hidden faces"),
        traces_rays=True,
        solid=False,
        known=False,
    )
