"""The panels of the studies: what tracing costs on the scene, and where each method breaks."""

from __future__ import annotations

from typing import Any

import bpy

from ..methods import MEASURED, PLAIN, Method
from ..study.extremes import BreakingPoint, written
from ..study.scenarios.sweeps import SCENARIOS
from ..study.trade import Row, Trade
from . import results
from .operators import (
    REFERENCE_TRACER_OT_extreme_scene,
    REFERENCE_TRACER_OT_extremes,
    REFERENCE_TRACER_OT_trade,
)
from .panels import NARROW, both, short_name, table, wrapped
from .scenario_scene import CHANGED

_BY_NAME = {s.name: s for s in SCENARIOS}
_COLUMNS = 3  # of buttons


class _Trade:
    bl_label = "Trade"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Any) -> None:
        """Draw the button, and what was measured: the methods, then what no other row beats."""
        layout = self.layout
        layout.operator(REFERENCE_TRACER_OT_trade.bl_idname, icon="TIME")
        found = results.latest(Trade, context.scene)
        if not found:
            return
        trade = found.content
        wrapped(layout, context, found.lines[0], "INFO")
        box, rows = layout.box(), trade.whole
        box.label(text=f"{rows[0].width} × {rows[0].height} pixels, one ray each")
        table(box, [("", "s", "Wrong", "MiB"), *(_method(r) for r in rows)], NARROW)
        box = layout.box()
        box.label(text=f"Nearest to {trade.converged} × {trade.converged} rays a pixel")
        best = sorted((r for r in trade.rows if r.best_coverage), key=lambda r: r.seconds)
        table(box, [("", "Size", "s", "RMS"), *(_coverage(r) for r in best)], NARROW)
        wrapped(layout, context, "* no other is faster with as few wrong pixels")
        _say_why(layout, context, found)


def _say_why(layout: Any, context: Any, found: results.Result) -> None:
    """Say why there is no picture, and how it can be had."""
    for line in found.lines[1:]:
        wrapped(layout, context, line, "ERROR")


def _method(row: Row) -> tuple[str, ...]:
    star = " *" if row.best_pixels else ""
    memory = f"{row.peak_bytes / 2**20:.1f}"
    name = short_name(row.method, row.precision)
    return name, f"{row.seconds:.3f}", f"{row.wrong_pixels:,}{star}", memory


def _coverage(row: Row) -> tuple[str, ...]:
    size = f"{row.width}, {row.samples}²"
    name = short_name(row.method, row.precision)
    return name, size, f"{row.seconds:.3f}", f"{row.coverage_error:.4f}"


class _Extremes:
    bl_label = "Extremes"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: Any) -> None:
        """Draw the button, the breaking points, and the way to each scene."""
        layout, shown = self.layout, context.window_manager.reference_tracer
        layout.operator(REFERENCE_TRACER_OT_extremes.bl_idname, icon="MOD_NOISE")
        found = results.latest(BreakingPoint, context.scene)
        if found:
            wrapped(layout, context, found.lines[0], "INFO")
            _say_why(layout, context, found)
        if found and found.content:
            wrapped(layout, context, "First scale at which a ray is lost, + crosses too many")
            layout.row().prop(shown, "precision", expand=True)
            _breaking_points(layout.box(), found.content, shown.precision)
        box = layout.box()
        box.prop(shown, "scenario", text="")
        scenario = _BY_NAME[shown.scenario]
        wrapped(box, context, scenario.explanation)
        unit = f", {scenario.unit}" if scenario.unit else ""
        box.label(text=f"Open as a Scene ({scenario.scale_name}{unit}):")
        grid = box.grid_flow(columns=_COLUMNS, row_major=True, align=True)
        for scale in scenario.scales:
            button = grid.operator(REFERENCE_TRACER_OT_extreme_scene.bl_idname, text=written(scale))
            button.scenario, button.scale = scenario.name, repr(float(scale))
        if changed := context.scene.get(CHANGED):
            wrapped(layout, context, "This scene is one of the study's, stored in float32:", "INFO")
            for line in changed.split("\n"):
                wrapped(layout, context, line)


def _breaking_points(layout: Any, points: tuple[BreakingPoint, ...], precision: str) -> None:
    """Draw a table: below each scenario's title a value for each method in a precision.

    What is certified is so in float64; it has a column where it breaks, which it should not.
    """
    proven = {p.scenario: p for p in points if p.method == Method.CERTIFIED}
    holds = all(p.never for p in proven.values())
    _cells(layout, [m.head for m in (PLAIN if holds else MEASURED)])
    for name in proven:
        of = {p.method: p for p in points if p.scenario == name and p.precision == precision}
        cells = [_point(of[m]) for m in PLAIN] + ([] if holds else [_point(proven[name])])
        scenario = _BY_NAME[name]
        column = layout.column(align=True)
        column.scale_y = 0.75
        column.label(text=f"{scenario.title}, {scenario.scale_name}")
        _cells(column, cells)


def _cells(layout: Any, texts: list[str]) -> None:
    row = layout.row()
    for text in texts:
        row.label(text=text)


def _point(point: BreakingPoint) -> str:
    if point.never:
        return "never"
    lost = "." if point.lost is None else written(point.lost)
    return lost if point.doubled is None else f"{lost} +"


CLASSES = (*both(_Trade, "_trade"), *both(_Extremes, "_extremes"))
register, unregister = bpy.utils.register_classes_factory(CLASSES)
