"""The open scene as a foreign picture may have it: what a flag hides, and the frames beside.

For comparisons with a picture of which nobody says how it was made.
"""

from __future__ import annotations

from typing import Any

import bpy

from ..compare.alternatives import Alternative, with_object, without
from ..manifest import Manifest, ObjectEntry
from ..scene import Scene
from .animation import values_kept
from .engine import export_for_render
from .export import export
from .temporary import temporary_scene

MOST = 16  # each is traced where pixels are left open


def alternatives(context: Any, scene: Scene, manifest: Manifest) -> tuple[Alternative, ...]:
    """Return scenes that differ from the exported one in what one flag, or the frame, changes.

    Parameters
    ----------
    context : bpy.types.Context
    scene, manifest
        What was exported as a render has it.
    """
    other, viewport = export(context.evaluated_depsgraph_get())
    drawn, seen = _by_name(manifest), _by_name(viewport)
    out = []
    for name in seen.keys() & drawn.keys():
        if drawn[name].hidden and seen[name].exported:
            out.append(Alternative(name, drawn[name].reason, with_object(scene, other, name)))
        elif seen[name].hidden and drawn[name].exported:
            out.append(Alternative(name, seen[name].reason, without(scene, name)))
    out.sort(key=lambda a: a.object)
    return (*out[:MOST], *_frames(context))


def _by_name(manifest: Manifest) -> dict[str, ObjectEntry]:
    return {entry.name: entry for entry in manifest.objects}


def _frames(context: Any) -> list[Alternative]:
    """Return the scene a frame before and a frame later, if something in the file is animated."""
    if not len(bpy.data.actions):
        return []
    out = []
    now = context.scene.frame_current
    with values_kept(), temporary_scene(context.scene, context.view_layer.name) as tmp:
        for frame in (now - 1, now + 1):
            tmp.frame_set(frame)
            scene, _, _ = export_for_render(tmp)
            reason = f"the picture is of frame {frame}, the scene is at {now}"
            out.append(Alternative("what is animated", reason, scene))
        tmp.frame_set(now)
    return out
