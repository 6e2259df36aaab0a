"""Compares with a picture that nothing is known of: another engine's, the Render Result, an image.

It is judged as a file of `--against` is.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import bpy
import numpy as np
from bpy.types import Depsgraph

from ...arrays import Colors
from ...causes.case import Case
from ...pictures.given import Making, picture_of_array, picture_of_file
from ...pictures.palette import APART, By, eight_bits
from ...pictures.picture import Picture
from ...pictures.source import Source
from ...scene import Scene
from ..drawing.drawings import Drawing
from ..drawing.judge import Judge
from ..drawing.judges import RENDER_RESULT
from ..reading.camera import export_camera
from ..reading.pictures import image_file, render_result
from ..temporary import ENGINE
from ..versions import DITHER
from .against import gather_against
from .open_file import Choices

_MOST = 256  # colours of a picture that are compared
_UNSEEN = (
    "which engine rendered it is not known, so only the rounding of rays excuses it: render again "
    "with F12 while the add-on is enabled, or choose Made By"
)
_OTHER_COLORS = (
    "most that {} drew has none of the colours that it was given: by an emission that overrides "
    "all materials, the objects' colours, and the materials' viewport colours"
)


def gather_given(context: Any, chosen: Choices, judge: Judge | None) -> Case:
    """Export the context's scene as a render has it, with the picture that is chosen.

    Parameters
    ----------
    context : bpy.types.Context
    chosen : Choices
        Colours that are to be found automatically are the viewport's: a picture has its own.
    judge : Judge, optional
        The engine that is to render; None for the Render Result, or an image.

    Raises
    ------
    SceneError, OSError, SizeError
        If the scene cannot be traced, or there is no such picture of it.
    """
    making = Making(chosen.renderer, chosen.filter)
    if judge:
        shown: Any = partial(_rendered, judge=judge, like_for_like=not chosen.as_is, making=making)
    elif chosen.judge == RENDER_RESULT:
        with render_result(context.scene, context.view_layer.name) as held:
            making = replace(making, engine=held.rendered_by)
            if not (making.renderer or held.rendered_by):
                held = replace(held, remarks=(*held.remarks, _UNSEEN))
            shown = picture_of_file(held, export_camera(context.scene), making)
    else:
        dither = DITHER * context.scene.render.dither_intensity
        file = image_file(context.scene.reference_tracer.image)
        making = replace(making, default_dither=dither)
        shown = picture_of_file(file, export_camera(context.scene), making)
    colors = chosen.colors
    has_ours = judge or (chosen.judge == RENDER_RESULT and making.engine == ENGINE)
    if colors == By.AUTOMATIC and (chosen.as_is or not has_ours):
        colors = By.VIEWPORT
    case = gather_against(context, shown, chosen.settings, chosen.self_check, colors)
    return replace(case, tracer=chosen.tracer)


def _rendered(drawing: Drawing, judge: Judge, like_for_like: bool, making: Making) -> Picture:
    """Have an engine render what was exported."""
    plan = replace(drawing.plan, judge=judge, like_for_like=like_for_like)

    def export(_: Any, used: dict[str, Any], depsgraph: Depsgraph) -> Drawing:
        if like_for_like and used["color_type"] == "RANDOM":
            judge.check_random(drawing.exported, drawing.manifest.owners)
        return drawing._replace(plan=plan)

    rendered, pixels, _ = plan.drawn(export, identity=False)
    scene = rendered.exported
    shown = picture_of_array(pixels, scene.camera, making)
    source = Source(
        judge.name,
        bpy.app.version_string,
        f"{judge.label}'s render",
        shown.source.known,
        () if _shows_the_colors(pixels, scene) else (_OTHER_COLORS.format(judge.label),),
    )
    return replace(shown, source=source)


def _shows_the_colors(pixels: Colors, scene: Scene) -> bool:
    """Return whether most that is drawn, (h, w, 4), has colours that a scene has."""
    if any(mesh.corner_colors is not None for mesh in scene.meshes):
        return True  # any colour between them
    drawn = eight_bits(pixels[pixels[..., 3] > 0.5][:, :3])
    shown, count = np.unique(drawn, axis=0, return_counts=True)
    often = np.argsort(-count)[:_MOST]
    colors = np.unique(eight_bits(scene.color_table[:, :3]), axis=0).astype(np.int32)
    near = [(np.abs(colors - color).max(axis=1) < APART).any() for color in shown[often]]
    return bool(2 * count[often][near].sum() >= len(drawn))
