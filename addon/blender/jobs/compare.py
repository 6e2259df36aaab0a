"""Trace and Compare: has Blender export and draw the scene, and returns the work that is left.

`gather_case` makes everything that only Blender can give, in one uninterrupted call. What it
returns holds no reference to Blender's data, so that tracing may go on while the user works.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ...arrays import Colors
from ...causes.case import Case
from ...comparison.comparing import compared
from ...comparison.comparison import Comparison
from ...manifest import Manifest
from ...pictures.palette import VIEWPORT, By, GivenColors, Palette
from ...pictures.picture import Picture, Source
from ...pictures.renderers import EMBREE, RASTER
from ...report import comparison as comparison_report
from ...report import folders
from ...scene import Scene
from ...tracer.memory import ALWAYS, COMPARED, check_memory
from ...tracer.progress import Work
from ...tracer.render import Tracer
from ...tracer.settings import Settings
from ..drawing.behind import behind
from ..drawing.drawings import Drawing, with_identity, with_what_draws_itself
from ..drawing.judge import Judge
from ..drawing.judges import judge_named
from ..drawing.picture import picture, prepare_scene
from ..drawing.rasteriser import snapping_of
from ..drawing.shading import anti_aliasing, of_shading, solid_shading, use_view_shading
from ..drawing.stand_ins import stand_ins
from ..drawing.workbench import WORKBENCH
from ..engine import export_for_judge
from ..reading.camera import export_camera
from ..reading.opened import absolute
from ..reading.palettes import automatic, palette_by
from ..reading.unmodelled import by_handlers
from ..temporary import go_to, temporary_scene
from ..values import values_restored
from .variants import variants

if TYPE_CHECKING:
    from ..engine import Certified


@dataclass(frozen=True)
class Choices:
    """How to compare."""

    settings: Settings
    judge: str  # its name in capitals, or AUTO
    as_is: bool  # Blender draws with the shading that the scene has
    colors: By | GivenColors  # where the colours come from; as it is, they are the viewport's
    identity: bool  # whose surface each pixel shows is found, too
    self_check: bool  # the comparison is tried on known faults, too
    diagnose: bool  # what accounts for unexplained pixels is looked for
    tracer: Tracer | None = None  # what traces; by default, this process

    @classmethod
    def of(cls, scene: Any, given: dict[str, Any]) -> Choices:
        """Return what is given; what is not, or is None, is as a `bpy.types.Scene` stores it."""
        stored = scene.reference_tracer
        own = cls(
            stored.settings(),
            stored.judge,
            stored.shading == "AS_IS",
            By(stored.colors.lower()),
            stored.identity,
            stored.self_check,
            stored.diagnose,
        )
        return replace(own, **{name: value for name, value in given.items() if value is not None})


def gather_case(context: Any, **choices: Any) -> Case:
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
    scene = context.scene
    layer = context.view_layer.name
    chosen = Choices.of(scene, choices)
    like_for_like = not chosen.as_is
    camera = export_camera(scene)  # first: its errors name the user's scene, say what to do
    is_panorama = not camera.projection.is_linear
    judge = judge_named(chosen.judge, bpy.app.background, is_panorama)
    of_view = judge.needs_window and not like_for_like
    view_shading = solid_shading(context) if of_view else None
    check_memory(
        camera.region.width, camera.region.height, COMPARED, 2 * ALWAYS
    )  # before Blender draws
    with ExitStack() as stack:

        def begun(palette: Palette) -> tuple[Any, dict[str, Any], Certified]:
            tmp = stack.enter_context(temporary_scene(scene, layer, judge.ignores, palette))
            used = _prepared(tmp, judge, like_for_like, view_shading)
            return tmp, used | {"colors": palette.by.value}, export_for_judge(tmp, layer, judge)

        palette = palette_by(scene, chosen.colors) if like_for_like else VIEWPORT
        tmp, used, (exported, manifest, certificate) = begun(palette)
        if like_for_like and chosen.colors == By.AUTOMATIC:
            palette = automatic(scene, exported, manifest)
        if palette.by != used["colors"]:
            stack.close()
            tmp, used, (exported, manifest, certificate) = begun(palette)
        palette.check(exported, manifest.owners)
        if palette.note:
            manifest = replace(manifest, notes=(*manifest.notes, palette.note))
        if certificate:
            certificate.check()
        there = [o.name_full for o in scene.objects]
        if like_for_like and used["color_type"] == "RANDOM":
            judge.check_random(exported, manifest.owners)
        if not like_for_like:
            of_picture = of_shading(tmp, judge, used["anti_aliasing"])
            own = (replace(u, object=f"scene '{scene.name}'") for u in of_picture)
            manifest = replace(manifest, unmodelled=(*manifest.unmodelled, *own))
        later = _a_frame_later(tmp, layer, judge) if chosen.self_check else None
        snapping = snapping_of(judge)  # its drawing is the first, which may differ from the others
        planes = manifest.owners[len(exported.instances) :]
        with stand_ins(tmp, layer, exported, planes) as with_planes:
            pixels = picture(tmp, layer, judge, exported.camera, like_for_like)
    shown = _picture(pixels, judge, used, snapping)
    drawing = Drawing(scene, layer, judge, like_for_like, view_shading, exported, manifest, palette)
    if chosen.identity:
        shown = with_identity(drawing, shown)
    shown, manifest = with_what_draws_itself(drawing, shown)
    if there != [o.name_full for o in scene.objects]:
        manifest = replace(manifest, unmodelled=(*manifest.unmodelled, by_handlers(scene)))
    settings = chosen.settings
    if like_for_like:  # Blender's picture has one sample in a pixel: so has the traced one
        settings = replace(settings, samples=1)
    case = Case(with_planes, manifest, settings, shown, certificate)
    if like_for_like:
        color_type = scene.display.shading.color_type
        made = partial(_picture, judge=judge, used=used, snapping=snapping)
        case = replace(case, behind=behind(drawing, case, color_type, made, chosen.identity))
    return replace(
        case,
        self_check=chosen.self_check,
        next_frame=later,
        tracer=chosen.tracer,
        variants=partial(variants, scene.name_full, layer, judge.ignores, palette),
    )


def _prepared(tmp: Any, judge: Judge, like_for_like: bool, view_shading: Any) -> dict[str, Any]:
    """Set a temporary scene up for a judge; return the settings that the picture is made with."""
    if view_shading:
        use_view_shading(tmp, view_shading)
    used = prepare_scene(tmp, like_for_like)
    used["shading_of"] = "3D view" if view_shading else "scene"
    used["anti_aliasing"] = anti_aliasing(tmp, judge, like_for_like)
    return used


def _picture(pixels: Colors, judge: Judge, used: dict[str, Any], snapping: float) -> Picture:
    smooth = used["anti_aliasing"]
    return Picture(
        pixels,
        Source(judge.name, bpy.app.version_string, settings=used),
        sample_radius=judge.sample_radius,
        farthest=judge.farthest,
        filter_radius=0.0 if smooth == "OFF" else judge.filter_radius,
        sums=int(smooth) if smooth.isdigit() else 0,
        snapping=snapping,
        renderer=EMBREE if judge.traces_rays else RASTER,
    )


def _a_frame_later(tmp: Any, layer: str, judge: Judge) -> Scene:
    """Return the scene of the next frame, and go back to this one."""
    now = tmp.frame_current
    with values_restored():
        go_to(tmp, now + 1)
        later, _, _ = export_for_judge(tmp, layer, judge)
        go_to(tmp, now)
    return later


def compare_open_file(
    context: Any,
    directory: str = "",
    trade: bool = False,
    extremes: bool = False,
    told: Callable[[Comparison], object] = lambda comparison: None,
    **choices: Any,
) -> Work[Comparison]:
    """Gather at once; return the work of tracing, comparing, diagnosing, and writing the files.

    Nothing is written if the directory is empty. With `trade` and `extremes`, these are measured
    for the page, too. `told` hears of the comparison before the diagnosis, if there is one. The
    choices are the fields of :class:`Choices`. On failure the folder's JSON says why.

    Raises
    ------
    OSError
        If the folder cannot be written; else what :func:`gather_case` and the comparison raise.
    """
    diagnose = Choices.of(context.scene, choices).diagnose
    if not directory:
        return compared(gather_case(context, **choices), diagnose, told)
    folder = made_folder(directory)  # now, not after all the work
    with comparison_report.failure_written(folder):
        case = gather_case(context, **choices)
    return comparison_report.written(folder, case, diagnose, trade, extremes, told)


def made_folder(directory: str) -> Path:
    """Make a folder, and return it; its path is as Blender writes it, or as the shell does.

    Raises
    ------
    OSError
        If it cannot be made or written.
    """
    folder = absolute(directory)
    folders.make(folder)
    return folder


def export_open_file(
    context: Any, judge: Judge | None = None, palette: Palette = VIEWPORT
) -> tuple[Scene, Manifest, Settings]:
    """Export the context's scene as a render has it, with the settings that it stores.

    For a judge, it is exported as for a comparison with its picture.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    scene = context.scene
    layer = context.view_layer.name
    stored = scene.reference_tracer
    export_camera(scene)  # first: its errors name the user's scene, say what to do
    with temporary_scene(scene, layer, judge.ignores if judge else None, palette) as tmp:
        if judge:
            prepare_scene(tmp, stored.shading == "LIKE_FOR_LIKE")
        exported, manifest, _ = export_for_judge(tmp, layer, judge or WORKBENCH)
    return exported, manifest, stored.settings()
