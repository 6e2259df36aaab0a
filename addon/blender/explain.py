"""A pixel of the open scene -> its derivation."""

from __future__ import annotations

from typing import Any

import bpy

from ..compare.comparison import Comparison
from ..explain.candidates import LIMIT
from ..explain.derivation import Derivation, derive
from ..scene import Scene
from . import results
from .camera import export_camera
from .compare import export_for_judge
from .judges import JUDGES, find
from .temporary import temporary_scene
from .viewport import prepare


def derive_here(
    context: Any, x: int, y: int, source: str = "SCENE", limit: int = LIMIT
) -> Derivation:
    """Derive a pixel of the context's scene.

    Parameters
    ----------
    context : bpy.types.Context
    x, y : int
        Of the picture; (0, 0) is its lower left.
    source : {'SCENE', 'RENDER', 'COMPARISON'}
        The scene as *Trace and Compare* would export it now; as a render would; or as the latest
        comparison did, which is the scene now where there is none.
    limit : int
        Triangles shown.

    Raises
    ------
    SceneError
        If the scene cannot be traced, or has no such pixel.
    """
    latest = results.latest(Comparison, context.scene)
    if source == "COMPARISON" and latest:
        scene = latest.content.scene
    else:
        scene = exported(context, source == "RENDER")
    file = bpy.path.basename(bpy.data.filepath) or "the unsaved file"
    return derive(scene, x, y, limit, file)


def exported(context: Any, as_rendered: bool = False) -> Scene:
    """Export the context's scene as a comparison does, or as a render."""
    scene, layer, stored = context.scene, context.view_layer.name, context.scene.reference_tracer
    export_camera(scene)  # first, as its errors name the user's scene and say what to do
    judge = JUDGES["workbench"] if as_rendered else find(stored.judge, bpy.app.background)
    with temporary_scene(scene, layer, judge) as tmp:
        prepare(tmp, stored.shading == "LIKE_FOR_LIKE" and not as_rendered)
        return export_for_judge(tmp, layer, judge)[0]
