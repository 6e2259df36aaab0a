"""The panels of the comparison: in the Render properties, in the 3D view's sidebar, on objects."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ..drawing.judges import JUDGES, label_of
from ..engine import ENGINE
from . import operators, results
from .findings import draw_findings
from .layout import NARROW, Part, both, draw_table, short_name, wrapped
from .menus import REFERENCE_TRACER_PT_presets
from .results import Kind

if TYPE_CHECKING:
    from ...causes.counts import PixelCounts
    from ...comparison.animation import FrameRow
    from ...comparison.comparison import Comparison
    from ...comparison.engines import EngineRow

_WORST = 5  # frames of an animation that are listed

# Blender's own panels for every engine that this one has no use for.
_NOT_OURS = {f"RENDER_PT_{n}" for n in ("simplify", "freestyle", "stamp")} | {"VIEWLAYER_PT_filter"}
# Panels of other engines that this one uses: for colours and passes.
_OURS_TOO = {"RENDER_PT_opengl_color", "RENDER_PT_opengl_film", "VIEWLAYER_PT_layer_passes"}


class _Main(Part):
    bl_label = "Reference Tracer"

    def draw_header_preset(self, _: Any) -> None:
        REFERENCE_TRACER_PT_presets.draw_panel_header(self.layout)

    def draw(self, context: Any) -> None:
        """Draw the settings and the buttons of the comparisons, with their latest results."""
        layout = self.layout
        stored = context.scene.reference_tracer
        if context.scene.camera is None:
            layout.operator(operators.REFERENCE_TRACER_OT_frame_all.bl_idname, icon="CAMERA_DATA")
        layout.operator(operators.REFERENCE_TRACER_OT_compare.bl_idname, icon="RENDER_RESULT")
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column()
        for name in ("method", "precision", "samples", "color"):
            row = column.row()
            row.enabled = name != "precision" or stored.has_precision
            row.prop(stored, name)
        column.separator()
        column.prop(stored, "show")
        column = layout.column()
        for name in ("judge", "shading", "colors", "identity", "self_check", "diagnose"):
            row = column.row()
            row.enabled = name != "colors" or stored.shading == "LIKE_FOR_LIKE"
            row.prop(stored, name)
            if name == "judge":
                stored.draw_given(column)
        layout.operator(operators.REFERENCE_TRACER_OT_compare_all.bl_idname, icon="RENDERLAYERS")
        if found := results.content(Kind.ENGINES, context.scene):
            _draw_engines(layout.box(), found)
        button = operators.REFERENCE_TRACER_OT_compare_animation.bl_idname
        layout.operator(button, icon="RENDER_ANIMATION")
        if found := results.content(Kind.FRAMES, context.scene):
            _draw_frames(layout.box(), *found)


def _draw_engines(layout: Any, found: Sequence[EngineRow]) -> None:
    rows = [("Engine", "Differ", "Wrong", "Open")]
    for row in found:
        counts = (row.counts.differ, row.counts.unexplained) if row.counts else ("-", "-")
        wrong = "?" if row.wrong_objects is None else str(row.wrong_objects)
        label = JUDGES[row.engine].label
        rows.append((label, str(counts[0]), wrong, str(counts[1])))
    draw_table(layout, rows, NARROW)


def _draw_frames(layout: Any, path: Path, rows: Sequence[FrameRow]) -> None:
    """Draw the worst frames, each with a button that goes there."""
    column = layout.column(align=True)
    for row in rows[:_WORST]:
        counts = iface_("{} differ, {} open").format(
            row.explained + row.unexplained, row.unexplained
        )
        text = f"{iface_('Frame')} {row.frame}: {row.error or counts}"
        go = column.operator("wm.context_set_int", text=text)
        go.data_path = "scene.frame_current"
        go.value = row.frame
    button = column.operator("wm.url_open", text="Open Page of All Frames", icon="URL")
    button.url = path.resolve().as_uri()


class _Result(Part):
    bl_label = "Comparison"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return results.latest(Kind.COMPARISON, context.scene) is not None

    def draw(self, context: Any) -> None:
        """Draw the verdict, the counts by cause, and the table of methods."""
        from ...diagnosis import self_check

        layout = self.layout
        comparison = results.content(Kind.COMPARISON, context.scene)
        icon = {"agree": "CHECKMARK", "differences": "CANCEL"}.get(comparison.verdict, "ERROR")
        layout.label(text=comparison.verdict.capitalize(), icon=icon)
        for line in comparison.excused.lines():
            wrapped(layout, context, line.strip(), "ERROR")
        draw_findings(layout, context, comparison)
        draw_table(layout, [*_counts(comparison.counts), *_measures(comparison)])
        rows = [("Traced by", "s", "Wrong", "Ambig.")]
        for m in comparison.methods:
            wrong = "?" if m.wrong_pixels is None else f"{m.wrong_pixels:,}"
            rows.append((short_name(m), f"{m.seconds:.2f}", wrong, f"{m.ambiguous:,}"))
        draw_table(layout.box(), rows, NARROW)
        for line in (*comparison.required, *self_check.table(comparison.self_check)[:1]):
            wrapped(layout, context, line)
        layout.operator(operators.REFERENCE_TRACER_OT_open_page.bl_idname, icon="URL")


def _counts(pixels: PixelCounts) -> list[tuple[str, str]]:
    """Return how many pixels agree and differ: by cause, and in and around surfaces."""
    from ...causes.explain import CAUSES

    counts = {"Agree": pixels.agree, "Differ": pixels.differ}
    for cause in sorted(CAUSES):
        if count := pixels.by_cause.get(cause.key):
            counts[f"  {cause.label.capitalize()}"] = count
    counts |= {
        "Differ, Interior": pixels.interior.differ,
        "Differ, Boundary": pixels.boundary.differ,
    }
    return [(label, f"{count:,} px") for label, count in counts.items()]


def _measures(comparison: Comparison) -> list[tuple[str, str]]:
    """Return the metrics of a comparison, what it is with, and how long the tracer took."""
    metrics = comparison.metrics
    largest = metrics.largest_difference
    x, y = largest.pixel
    return [
        ("RMSE", f"{metrics.rmse:.3g}"),
        ("PSNR", f"{metrics.psnr:.1f} dB" if metrics.rmse else "infinite"),
        ("SSIM", f"{metrics.ssim:.6f}"),
        ("Largest Difference", f"{largest.value:.3g} at ({x}, {y})"),
        ("Compared With", label_of(comparison.case.picture.source)),
        ("Traced In", f"{comparison.frame.statistics.seconds:.2f} s"),
    ]


class _Export(Part):
    bl_label = "Export"
    bl_options = {"DEFAULT_CLOSED"}
    poll = _Result.poll

    def draw(self, context: Any) -> None:
        """Draw the manifest: what was exported, skipped, not modelled."""
        manifest = results.content(Kind.COMPARISON, context.scene).manifest
        column = self.layout.column(align=True)
        column.scale_y = 0.8
        for line, warns in manifest.facts():
            column.label(text=line.strip(), icon="ERROR" if warns else "NONE")


class OBJECT_PT_reference_tracer(bpy.types.Panel):
    bl_label = "Reference Tracer"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        return context.object is not None

    def draw(self, context: Any) -> None:
        layout: Any = self.layout
        layout.use_property_split = True
        layout.prop(context.object.reference_tracer, "infinite_plane")


def _draw_passes(panel: Any, context: Any) -> None:
    """Draw the choice of passes in Blender's own panel of passes."""
    if context.engine == ENGINE:
        panel.layout.column().prop(context.view_layer.reference_tracer, "passes")


CLASSES = (
    *both(_Main),
    *both(_Result, "_result"),
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
