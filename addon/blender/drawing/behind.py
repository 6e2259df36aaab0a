"""Draws the user's scene without what is seen through, such as glass, to judge what is behind it.

The scene is exported again without it, too: so both sides lack what Blender leaves out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import bpy
from bpy.types import Depsgraph, Object

from ...causes.case import Behind, Case
from ...manifest import Effect, Manifest, Unmodelled
from ...pictures.picture import Picture
from ...scene import SceneError
from ..reading.colors import slot_materials
from ..reading.export import export
from ..reading.unmodelled import TRANSPARENCY
from .drawings import Drawing, with_what_draws_itself


def behind(
    drawing: Drawing,
    case: Case,
    color_type: str,
    made: Callable[..., Picture],
    identity: bool,
) -> Behind | None:
    """Return the case without objects that are seen through; None if there are none.

    Parameters
    ----------
    drawing : Drawing
        How the scene is drawn.
    case : Case
        That of the scene with it.
    color_type : str
        The user's own shading, which chooses the alpha that counts.
    made : callable
        Makes the picture of its pixels, with their owners.
    identity : bool
        Whether to find each pixel's owner, too.
    """
    if TRANSPARENCY in drawing.plan.judge.ignores:
        return None
    left = _see_through(drawing.manifest, set(case.scene.objects), color_type)
    if not left:
        return None
    plan = replace(drawing.plan, left_out=tuple(left))

    def export_without(_: Any, used: dict[str, Any], depsgraph: Depsgraph) -> Drawing:
        return Drawing(plan, *export(depsgraph), used)

    try:
        drawn = plan.drawn(export_without, identity)
        shown = made(drawn.pixels, owners=drawn.owners)
        shown, manifest = with_what_draws_itself(drawn.drawing, shown, identity)
    except (SceneError, RuntimeError):  # nothing is left that could be seen
        return None
    rest = Case(drawn.drawing.exported, manifest, case.settings, shown, tracer=case.tracer)
    return Behind(rest, frozenset(u.object for u in left))


def _see_through(manifest: Manifest, there: set[str], color_type: str) -> list[Unmodelled]:
    """Return the exported objects that are seen through and can be left out.

    A palette draws it opaque: so the user's own colours are asked, too.
    """
    found = {u.object: u for u in manifest.unmodelled if u.feature == TRANSPARENCY}
    for obj in bpy.data.objects:
        if obj.name_full in there - found.keys() and _has_alpha(obj, color_type):
            found[obj.name_full] = Unmodelled(obj.name_full, TRANSPARENCY, effect=Effect.COLOR)
    by_nodes = {u.object for u in manifest.unmodelled if u.by}
    return [u for name, u in found.items() if name in there and name not in by_nodes]


def _has_alpha(obj: Object, color_type: str) -> bool:
    if color_type in ("OBJECT", "VERTEX"):
        return bool(obj.color[3] < 1)
    if color_type not in ("MATERIAL", "TEXTURE") or not hasattr(obj.data, "materials"):
        return False
    return any(m and m.diffuse_color[3] < 1 for m in slot_materials(obj))
