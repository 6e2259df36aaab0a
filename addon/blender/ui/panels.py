"""The panels of the comparison: in the Render properties, in the 3D view's sidebar, on objects."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_
from bpy.types import Context, Panel, UILayout

from ...methods import Method
from ..drawing.judges import JUDGES
from ..temporary import ENGINE
from . import operators, results, samples, scene_operators
from .layout import Part, both, button, draw_facts, folded, setting, wrapped
from .long_work import LongWork
from .menus import REFERENCE_TRACER_PT_presets
from .outcome import draw_figures, draw_outcome
from .results import Kind

if TYPE_CHECKING:
    from ...comparison.animation import FrameRow
    from ...comparison.engines import EngineRow

_FIRST = "Traces the scene, has Blender draw it, and says why each pixel differs"
_WORST = 5  # frames of an animation that are listed

# Blender's own panels for every engine that this one has no use for.
_NOT_OURS = {f"RENDER_PT_{n}" for n in ("simplify", "freestyle", "stamp")} | {"VIEWLAYER_PT_filter"}
# Panels of other engines that this one uses: for colours and passes.
_OURS_TOO = {"RENDER_PT_opengl_color", "RENDER_PT_opengl_film", "VIEWLAYER_PT_layer_passes"}


_SETTINGS = (  # a group each
    ("method", "precision", "samples", "color"),
    ("show",),
    ("judge", "shading", "colors", "identity", "self_check", "diagnose"),
)


class _Main(Part):
    bl_label = "Reference Tracer"

    def draw_header_preset(self, _: Any) -> None:
        REFERENCE_TRACER_PT_presets.draw_panel_header(self.layout)

    def draw(self, context: Any) -> None:
        """Draw the button and what came of it; then, folded, settings and what else there is."""
        layout = self.layout
        if context.scene.camera is None:
            button(layout, context, scene_operators.REFERENCE_TRACER_OT_frame_all, "CAMERA_DATA")
        if LongWork.running:
            layout.progress(factor=LongWork.meter.share)
            wrapped(layout, context, LongWork.said)
        else:
            row = layout.row()
            row.scale_y = 1.4
            button(row, context, operators.REFERENCE_TRACER_OT_compare, "RENDER_STILL")
        comparison = results.comparison(context)
        if comparison:
            draw_outcome(layout, context, comparison)
        else:
            wrapped(layout, context, _FIRST)
        stored = context.scene.reference_tracer
        if stored.show == "WRONG" and Method(stored.method).is_proven:
            wrapped(layout, context, "No pixel of a proven method is wrong", "INFO")
            show = layout.operator("wm.context_set_enum", text="Show the Textbook's Wrong Pixels")
            show.data_path = "scene.reference_tracer.method"
            show.value = "textbook"
        if body := folded(layout, "settings", "Settings"):
            _draw_settings(body, context, stored)
        if comparison and (body := folded(layout, "figures", "Figures")):
            draw_figures(body, context, comparison)
        if body := folded(layout, "more", "More Comparisons"):
            _draw_more(body, context)
        if samples.scenes() and (body := folded(layout, "samples", samples.TITLE)):
            samples.draw_scenes(body.column(align=True))


def _draw_settings(layout: UILayout, context: Context, stored: Any) -> None:
    layout.use_property_split = True
    layout.use_property_decorate = False
    greyed = {
        "precision": not stored.has_precision,
        "colors": stored.shading != "LIKE_FOR_LIKE",
    }
    for names in _SETTINGS:
        column = layout.column()
        for name in names:
            row = column.row()
            row.enabled = not greyed.get(name)
            setting(row, context, stored, name)
            if name == "judge":
                stored.draw_given(column)


def _draw_more(layout: UILayout, context: Context) -> None:
    button(layout, context, operators.REFERENCE_TRACER_OT_compare_all, "RENDERLAYERS")
    for row in results.content(Kind.ENGINES, context.scene) or ():
        box = layout.box()
        name, verdict = _of_engine(row)
        wrapped(box, context, f"{iface_(name)}: {verdict}")
        if row.wrong_objects is not None:
            draw_facts(box, context, [("Wrong object", f"{row.wrong_objects:,} px")])
        for line in filter(None, (row.error, *row.not_judged)):
            wrapped(box, context, line, "ERROR")
    button(layout, context, operators.REFERENCE_TRACER_OT_compare_animation, "RENDER_ANIMATION")
    if found := results.content(Kind.FRAMES, context.scene):
        _draw_frames(layout.box(), context, *found)


def _of_engine(row: EngineRow) -> tuple[str, str]:
    """Return an engine's name, and the verdict on its picture."""
    from ..drawing.engines import others

    judge = JUDGES.get(row.engine) or others().get(row.engine)
    verdict = row.verdict
    said = verdict.in_words(row.counts, iface_) if row.counts else iface_(verdict.capitalize())
    return judge.label if judge else row.engine, said


def _draw_frames(layout: UILayout, context: Context, path: Path, rows: Sequence[FrameRow]) -> None:
    """Draw the worst frames, each with a button that goes there."""
    for row in rows[:_WORST]:
        go = layout.operator("wm.context_set_int", text=f"{iface_('Frame')} {row.frame}")
        go.data_path = "scene.frame_current"
        go.value = row.frame
        counts = iface_("{} differ, {} open").format(
            row.explained + row.unexplained, row.unexplained
        )
        wrapped(layout, context, row.error or counts)
    page = layout.operator("wm.url_open", text="Open Page of All Frames", icon="SEQUENCE")
    page.url = path.resolve().as_uri()


class _Export(Part):
    bl_label = "Export"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        return results.comparison(context) is not None

    def draw(self, context: Context) -> None:
        """Draw the manifest: what was exported, skipped, not modelled."""
        manifest = results.comparison(context).manifest
        for line, warns in manifest.facts():
            wrapped(self.layout, context, line.strip(), "ERROR" if warns else "NONE")


class OBJECT_PT_reference_tracer(bpy.types.Panel):
    bl_label = "Reference Tracer"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Context) -> bool:
        return context.object is not None

    def draw(self, context: Any) -> None:
        layout: UILayout = self.layout
        layout.use_property_split = True
        layout.prop(context.object.reference_tracer, "infinite_plane")


def _draw_passes(panel: Panel, context: Any) -> None:
    """Draw the choice of passes in Blender's own panel of passes."""
    if context.engine == ENGINE:
        panel.layout.column().prop(context.view_layer.reference_tracer, "passes")


CLASSES = (
    *both(_Main),
    *both(_Export, "_export"),
    OBJECT_PT_reference_tracer,
)
_register, _unregister = bpy.utils.register_classes_factory(CLASSES)


def register() -> None:
    """Register the panels, and have Blender's own show for this engine: format, camera, colours."""
    _register()
    known: Any = bpy.types.Panel
    for panel in known.__subclasses__():
        name = panel.__name__
        shown_for = getattr(panel, "COMPAT_ENGINES", ())
        if name in _OURS_TOO or ("BLENDER_RENDER" in shown_for and name not in _NOT_OURS):
            panel.COMPAT_ENGINES.add(ENGINE)
    bpy.types.VIEWLAYER_PT_layer_passes.append(_draw_passes)


def unregister() -> None:
    """Undo :func:`register`."""
    for panel in bpy.types.Panel.__subclasses__():
        getattr(panel, "COMPAT_ENGINES", set()).discard(ENGINE)
    bpy.types.VIEWLAYER_PT_layer_passes.remove(_draw_passes)
    _unregister()
