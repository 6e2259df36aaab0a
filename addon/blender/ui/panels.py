"""The interface: in the Render properties, in the 3D view's sidebar, and on objects."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from typing import Any

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ...methods import Method
from ..drawing.judges import JUDGES
from ..engine import ENGINE
from . import operators, results
from .menus import REFERENCE_TRACER_PT_presets
from .results import Kind

_PARTS = "interior", "boundary"
_WORST = 5  # frames of an animation that are listed
NARROW = 0.37  # of a table's width: a short name

_LETTER = 6.5  # mean width in pixels at a scale of 1: what Blender's own font has
# Blender's own panels that this engine has no use for.
_NOT_OURS = {f"RENDER_PT_{n}" for n in ("simplify", "freestyle", "stamp")} | {"VIEWLAYER_PT_filter"}
# Those of other engines that say which colours and passes are shown.
_OURS_TOO = {"RENDER_PT_opengl_color", "RENDER_PT_opengl_film", "VIEWLAYER_PT_layer_passes"}
_PROPERTIES = {"bl_space_type": "PROPERTIES", "bl_region_type": "WINDOW", "bl_context": "render"}
_SIDEBAR = {"bl_space_type": "VIEW_3D", "bl_region_type": "UI", "bl_category": "Reference Tracer"}


def both(part: type, suffix: str = "", **in_properties: Any) -> tuple[type, type]:
    """Return a part as two panels: in the Render properties, and in the 3D view's sidebar.

    One with a suffix stands within the main one. `in_properties` is of the first alone.
    """
    made = []
    for prefix, place in (("RENDER", _PROPERTIES | in_properties), ("VIEW3D", _SIDEBAR)):
        main = f"{prefix}_PT_reference_tracer"
        parent = {"bl_parent_id": main} if suffix else {}
        made.append(type(main + suffix, (part, bpy.types.Panel), place | parent))
    return tuple(made)


def short_name(row: Any) -> str:
    """Return a row's method and precision, as short as a narrow table needs: 'Textbook 32'."""
    name = Method(row.method).record.short
    return f"{name[0].upper()}{name[1:]} {row.precision.removeprefix('float')}"


def draw_table(layout: Any, rows: Sequence[Sequence[str]], first: float = 0.45) -> None:
    """Draw rows of text in columns; `first` is the first column's share of the width."""
    split = layout.split(factor=first)
    names, rest = split.column(align=True), split.row()
    columns = [names, *(rest.column(align=True) for _ in rows[0][1:])]
    for column in columns:
        column.scale_y = 0.8
    for row in rows:
        for column, text in zip(columns, row, strict=True):
            column.label(text=text)


def wrapped(layout: Any, context: Any, text: str, icon: str = "NONE") -> None:
    """Draw a sentence in as many lines as the panel's width needs."""
    scale = context.preferences.system.ui_scale
    letters = int(context.region.width / scale / _LETTER) - (10 if icon != "NONE" else 6)
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in textwrap.wrap(iface_(text), max(16, letters)):
        column.label(text=line, icon=icon, translate=False)
        icon = "BLANK1" if icon != "NONE" else icon


class _Main:
    bl_label = "Reference Tracer"

    def draw_header_preset(self, _: Any) -> None:
        REFERENCE_TRACER_PT_presets.draw_panel_header(self.layout)

    def draw(self, context: Any) -> None:
        """Draw the button and what it will do."""
        layout, stored = self.layout, context.scene.reference_tracer
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
        for name in ("judge", "shading", "identity", "self_check"):
            column.prop(stored, name)
        layout.operator(operators.REFERENCE_TRACER_OT_compare_all.bl_idname, icon="RENDERLAYERS")
        if found := results.latest(Kind.ENGINES, context.scene):
            rows = [("Engine", "Differ", "Wrong", "Open")]
            for row in found.content:
                p = row.pixels or {"differ": "-", "unexplained": "-"}
                wrong = "?" if row.wrong_objects is None else row.wrong_objects
                shown = JUDGES[row.engine].label, p["differ"], wrong, p["unexplained"]
                rows.append(tuple(map(str, shown)))
            draw_table(layout.box(), rows, NARROW)
        button = operators.REFERENCE_TRACER_OT_compare_animation.bl_idname
        layout.operator(button, icon="RENDER_ANIMATION")
        if found := results.latest(Kind.FRAMES, context.scene):
            path, rows = found.content
            column = layout.box().column(align=True)
            for row in rows[:_WORST]:
                differ, wrong = row.explained + row.unexplained, row.unexplained
                counts = iface_("{} differ, {} open").format(differ, wrong)
                text = f"{iface_('Frame')} {row.frame}: {row.error or counts}"
                go = column.operator("wm.context_set_int", text=text)
                go.data_path, go.value = "scene.frame_current", row.frame
            button = column.operator("wm.url_open", text="Open Page of All Frames", icon="URL")
            button.url = path.resolve().as_uri()


class _Result:
    bl_label = "Comparison"

    @classmethod
    def poll(cls, context: Any) -> bool:
        return results.latest(Kind.COMPARISON, context.scene) is not None

    def draw(self, context: Any) -> None:
        from ...compare import self_check
        from ...compare.causes import CAUSES

        comparison = results.latest(Kind.COMPARISON, context.scene).content
        pixels, measured = comparison.pixels, comparison.metrics
        icon = {"agree": "CHECKMARK", "differences": "CANCEL"}.get(comparison.verdict, "ERROR")
        self.layout.label(text=comparison.verdict.capitalize(), icon=icon)
        rows = [("Agree", pixels["agree"]), ("Differ", pixels["differ"])]
        counts = ((cause, pixels["by_cause"].get(cause.key)) for cause in sorted(CAUSES))
        rows += [(f"  {cause.label.capitalize()}", n) for cause, n in counts if n]
        rows += [(f"Differ, {part.capitalize()}", pixels[part]["differ"]) for part in _PARTS]
        rows = [(label, f"{n:,} px") for label, n in rows]
        psnr = measured["psnr"]
        x, y = measured["largest_difference"]["pixel"]
        rows += [
            ("RMSE", f"{measured['rmse']:.3g}"),
            ("PSNR", "infinite" if psnr is None else f"{psnr:.1f} dB"),
            ("SSIM", f"{measured['ssim']:.6f}"),
            ("Largest Difference", f"{measured['largest_difference']['value']:.3g} at ({x}, {y})"),
            ("Compared With", JUDGES[comparison.case.picture.source.name].label),
            ("Traced In", f"{comparison.frame.statistics.seconds:.2f} s"),
        ]
        draw_table(self.layout, rows)
        rows = [("Traced by", "s", "Wrong", "Ambig.")]
        for m in comparison.methods:
            wrong = "?" if m.wrong_pixels is None else f"{m.wrong_pixels:,}"
            rows.append((short_name(m), f"{m.seconds:.2f}", wrong, f"{m.ambiguous:,}"))
        draw_table(self.layout.box(), rows, NARROW)
        for line in (*comparison.required, *self_check.table(comparison.self_check)[:1]):
            wrapped(self.layout, context, line)
        self.layout.operator(operators.REFERENCE_TRACER_OT_open_page.bl_idname, icon="URL")


class _Export:
    bl_label = "Export"
    bl_options = {"DEFAULT_CLOSED"}
    poll = _Result.poll

    def draw(self, context: Any) -> None:
        """Draw the manifest: what was exported, skipped, not modelled."""
        manifest = results.latest(Kind.COMPARISON, context.scene).content.manifest
        column = self.layout.column(align=True)
        column.scale_y = 0.8
        for line, warns in manifest.facts():
            column.label(text=line.strip(), icon="ERROR" if warns else "NONE")


class OBJECT_PT_reference_tracer(bpy.types.Panel):
    bl_label = "Reference Tracer"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        return context.object is not None

    def draw(self, context: Any) -> None:
        self.layout.use_property_split = True
        self.layout.prop(context.object.reference_tracer, "infinite_plane")


def _draw_passes(panel: Any, context: Any) -> None:
    """Draw, in Blender's own panel, what is rendered beside the picture."""
    if context.engine == ENGINE:
        panel.layout.column().prop(context.view_layer.reference_tracer, "passes")


_PANELS = *both(_Main), *both(_Result, "_result"), *both(_Export, "_export")
CLASSES = *_PANELS, OBJECT_PT_reference_tracer
_register, _unregister = bpy.utils.register_classes_factory(CLASSES)


def register() -> None:
    """Register the panels; Blender's own show for this engine, too: format, camera, colours."""
    _register()
    for panel in bpy.types.Panel.__subclasses__():
        name, shown_for = panel.__name__, getattr(panel, "COMPAT_ENGINES", ())
        if name in _OURS_TOO or ("BLENDER_RENDER" in shown_for and name not in _NOT_OURS):
            panel.COMPAT_ENGINES.add(ENGINE)
    bpy.types.VIEWLAYER_PT_layer_passes.append(_draw_passes)


def unregister() -> None:
    """Undo :func:`register`."""
    for panel in bpy.types.Panel.__subclasses__():
        getattr(panel, "COMPAT_ENGINES", set()).discard(ENGINE)
    bpy.types.VIEWLAYER_PT_layer_passes.remove(_draw_passes)
    _unregister()
