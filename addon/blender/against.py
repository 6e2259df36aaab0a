"""The open scene for a comparison with a picture of which nobody says how it was made.

The scene may have been another then: a flag hides an object, or it was the frame beside.
"""

from __future__ import annotations

from typing import Any

import bpy

from ..compare.case import Alternative, Case
from ..compare.checks.hidden import with_object, without
from ..compare.picture import Picture
from ..manifest import Manifest, ObjectEntry
from ..scene import Scene
from ..tracer.settings import Settings
from .animation import values_kept
from .compare import export_open_file
from .engine import export_for_render
from .export import export
from .temporary import temporary_scene
from .view_transforms import view_transforms

MOST = 16  # each is traced where pixels are left open


def gather_against(
    context: Any, picture: Picture, settings: Settings, self_check: bool = False
) -> Case:
    """Export the context's scene as a render has it, for a picture that Blender need not have made.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    scene, manifest, _ = export_open_file(context)
    return Case(
        scene,
        manifest,
        settings,
        picture,
        alternatives=alternatives(context, scene, manifest),
        curves=view_transforms(context.scene, scene),
        self_check=self_check,
    )


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
