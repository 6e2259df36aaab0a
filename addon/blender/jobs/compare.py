"""Trace and Compare: has Blender export and draw the scene, and returns the work that is left.

`gather_case` makes everything that only Blender can give, in one uninterrupted call. What it
returns holds no reference to Blender's data, so that tracing may go on while the user works.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import bpy
from bpy.types import Context, Depsgraph

from ...arrays import Colors
from ...causes.case import Case
from ...comparison.comparing import compared
from ...comparison.comparison import Comparison
from ...manifest import Manifest
from ...pictures.identity import Owners
from ...pictures.palette import VIEWPORT, By
from ...pictures.picture import Picture
from ...pictures.renderers import EMBREE, RASTER
from ...pictures.sampling import Sampling
from ...pictures.source import Source
from ...pictures.storage import Storage
from ...report import comparison as comparison_report
from ...scene import Scene
from ...tracer.memory import ALWAYS, COMPARED, check_memory, give_back
from ...tracer.progress import Work
from ..drawing.behind import behind
from ..drawing.constant_material import check_slots
from ..drawing.drawings import Drawing, Plan, with_what_draws_itself
from ..drawing.judge import Judge
from ..drawing.judges import judge_or_none
from ..drawing.rasteriser import snapping_of
from ..drawing.shading import of_shading, solid_shading
from ..evaluating import export_at
from ..reading.camera import certify_camera, export_camera
from ..reading.export import export
from ..reading.palettes import automatic, noted, palette_by
from ..reading.unmodelled import by_handlers
from ..temporary import show_in
from ..values import is_animated
from .given import gather_given
from .open_file import Choices
from .variants import variants

# Pixels from a pixel's centre that Blender's anti-aliasing mixes. Workbench's samples lie within a
# pixel and a half; what smooths their edges takes in the pixel beside.
_FILTER_RADIUS = 2.0


def gather_case(context: Context, **choices: Any) -> Case:
    """Export the context's scene and view layer, and have Blender draw them.

    Parameters
    ----------
    context : bpy.types.Context
    **choices
        Fields of :class:`Choices`; the others are as the scene stores them.

    Raises
    ------
    SceneError
        If the scene cannot be traced, or Blender's camera is another.
    RuntimeError
        If Blender makes no picture of it.
    """
    chosen = Choices.of(context.scene, choices)
    is_panorama = not export_camera(context.scene).projection.is_linear  # its errors come first
    judge = judge_or_none(chosen.judge, bpy.app.background, is_panorama)
    if judge is None or not judge.known:
        return gather_given(context, chosen, judge)
    plan = _planned(context, chosen, judge)
    user = plan.scene
    layer = plan.layer
    snapping = snapping_of(judge)  # its drawing is the first, which may differ from the others
    there = _names(user)
    is_automatic = plan.like_for_like and chosen.colors == By.AUTOMATIC
    drawing, pixels, owners = plan.drawn(partial(_export, plan, is_automatic), chosen.identity)
    made = partial(_picture, judge=judge, used=drawing.used, snapping=snapping)
    shown = made(pixels, owners=owners)
    later = _a_frame_later(drawing) if chosen.self_check else None
    shown, manifest = with_what_draws_itself(drawing, shown, chosen.identity)
    if there != _names(user):
        manifest = replace(manifest, unmodelled=(*manifest.unmodelled, by_handlers(user)))
    case = Case(
        drawing.exported,
        manifest,
        # Like for like, Blender's picture has one sample in a pixel: so has the traced one.
        replace(chosen.settings, samples=1) if plan.like_for_like else chosen.settings,
        shown,
        drawing.certificate,
        self_check=chosen.self_check,
        next_frame=later,
        tracer=chosen.tracer,
        variants=partial(variants, user.name_full, layer, judge.ignores, drawing.plan.palette),
    )
    if plan.like_for_like:
        color_type = user.display.shading.color_type
        case = replace(case, behind=behind(drawing, case, color_type, made, chosen.identity))
    give_back()  # what Blender's pictures took
    return case


def _planned(context: Context, chosen: Choices, judge: Judge) -> Plan:
    """Return how the context's scene is to be drawn, which is decided before Blender draws."""
    scene = context.scene
    shading = solid_shading(context) if judge.needs_window and chosen.as_is else None
    region = export_camera(scene).region
    check_memory(region.width, region.height, COMPARED, 2 * ALWAYS)  # before Blender draws
    palette = VIEWPORT if chosen.as_is else palette_by(scene, chosen.colors)
    return Plan(scene, context.view_layer.name, judge, not chosen.as_is, shading, palette)


def _export(
    plan: Plan, is_automatic: bool, tmp: Any, used: dict[str, Any], depsgraph: Depsgraph
) -> Drawing:
    """Export a scene in the colours that are wanted, and refuse what the judge cannot draw."""
    meshes: dict[Any, Any] = {}
    scene, manifest = export(depsgraph, meshes)
    certificate = certify_camera(depsgraph, scene.camera)
    palette = automatic(plan.scene, scene, manifest) if is_automatic else plan.palette
    if palette.by != plan.palette.by:
        animated = {o.name_full for o in bpy.data.objects if is_animated(o, "color")}
        show_in(tmp, depsgraph, {n: c for n, c in palette.colors.items() if n not in animated})
        used |= {"color_type": "OBJECT", "colors": palette.by.value}
        scene, manifest = export(depsgraph, meshes)
    manifest = noted(palette, scene, manifest)
    if certificate:
        certificate.check()
    if plan.like_for_like:
        _check_colors(plan.judge, scene, manifest, used["color_type"], tmp)
    else:
        of_picture = of_shading(tmp, plan.judge, used["anti_aliasing"])
        manifest = replace(manifest, unmodelled=(*manifest.unmodelled, *of_picture))
    return Drawing(replace(plan, palette=palette), scene, manifest, used, certificate)


def _check_colors(
    judge: Judge, scene: Scene, manifest: Manifest, color_type: str, tmp: Any
) -> None:
    """Refuse what a judge would not show in the colours that the tracer has."""
    if color_type == "RANDOM":
        judge.check_random(scene, manifest.owners)
    if not judge.solid:
        check_slots(scene, color_type)
    if judge.check_colors:
        judge.check_colors(scene, color_type, tmp.view_layers[0].objects)


def _names(scene: bpy.types.Scene) -> list[str]:
    return [o.name_full for o in scene.objects]


def _picture(
    pixels: Colors, owners: Owners | None, judge: Judge, used: dict[str, Any], snapping: float
) -> Picture:
    smooth = used["anti_aliasing"]
    return Picture(
        pixels,
        Source(judge.name, bpy.app.version_string, settings=used),
        sampling=Sampling(
            judge.sample_radius,
            0.0 if smooth == "OFF" else _FILTER_RADIUS,
            snapping,
            judge.farthest,
            EMBREE if judge.traces_rays else RASTER,
        ),
        storage=Storage(sums=int(smooth) if smooth.isdigit() else 0),
        owners=owners,
    )


def _a_frame_later(drawing: Drawing) -> Scene:
    """Return the scene of the next frame."""
    with drawing.plan.prepared() as (tmp, _):
        return export_at(tmp, tmp.frame_current + 1, drawing.plan.judge)


def compare_open_file(
    context: Context,
    folder: Path | None = None,
    trade: bool = False,
    extremes: bool = False,
    literal: bool = True,
    **choices: Any,
) -> Work[Comparison]:
    """Gather at once; return the work of tracing, comparing, diagnosing, and writing the files.

    Nothing is written without a folder. With `trade` and `extremes`, these are measured
    for the page, too. The page has the literal textbook's picture, if that is wanted. The choices
    are the fields of :class:`Choices`. On failure the JSON of a folder without results says why.

    Raises
    ------
    SceneError, RuntimeError
        What :func:`gather_case` raises; the work, what the comparison and writing raise.
    """
    diagnose = Choices.of(context.scene, choices).diagnose
    if folder is None:
        return compared(gather_case(context, **choices), diagnose)
    with comparison_report.failure_written(folder):
        case = gather_case(context, **choices)
    return comparison_report.written(folder, case, diagnose, trade, extremes, literal)
