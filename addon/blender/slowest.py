"""Names the object that Blender takes longest to evaluate, before it does so again.

To evaluate is to apply every modifier. Nobody hears a key or a signal meanwhile: so it is said
beforehand what takes so long.
"""

from __future__ import annotations

from bpy.app.translations import pgettext_rpt as rpt_
from bpy.types import ViewLayer

LONG = 0.1  # seconds: what takes less is not worth a word; a render may have finer modifiers


def slowest(layer: ViewLayer) -> str:
    """Return the object with most of the modifiers' time in the latest evaluation of a view layer.

    Blender has measured it: nothing is evaluated. Empty if all took little time, no object took
    more than half of it, or nothing was evaluated yet.

    Parameters
    ----------
    layer : bpy.types.ViewLayer
    """
    objects = layer.depsgraph.objects if layer.depsgraph else ()
    seconds = {o.name: sum(m.execution_time for m in o.modifiers) for o in objects}
    name = max(seconds, key=lambda name: seconds[name], default="")
    return name if name and seconds[name] > max(LONG, sum(seconds.values()) / 2) else ""


def announced(layer: ViewLayer, otherwise: str) -> str:
    """Return what takes Blender long, in words: the slowest object, or what else is done."""
    name = slowest(layer)
    return rpt_("Blender evaluates '{}'").format(name) if name else otherwise
