"""The operators of the studies: the trade and the extremes, for buttons and scripts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import EnumProperty, IntProperty
from bpy.types import Context

from ...methods import Method
from ...tracer.progress import Work
from ...wording import show
from . import choices, results
from .long_work import LongWork, named

if TYPE_CHECKING:
    from ...study.extremes import ExtremesRow
    from ...study.trade import Trade


@named
class REFERENCE_TRACER_OT_trade(LongWork, bpy.types.Operator):
    bl_label = "Measure Time and Accuracy"
    bl_description = (
        "Measure on this scene and camera how long every method, precision, number of samples "
        "and size takes, and what it gets wrong"
    )
    kind = results.Kind.TRADE
    needs_camera = True
    announced = "Blender evaluates the scene"

    width: IntProperty(
        name="Width",
        description="Width of the largest picture that is measured, in pixels",
        default=160,
        min=1,
        soft_max=1920,
    )
    samples: IntProperty(
        name="Samples",
        description="The square root of the largest number of rays in a pixel that is measured",
        default=4,
        min=1,
        max=16,
    )

    def begin(self, context: Context) -> Work[Any]:
        """Export the scene at once, as a render has it; return the work of measuring."""
        from ...study import tradeoff
        from ..jobs.open_file import export_open_file

        self._folder = self.folder()
        scene, manifest, _ = export_open_file(context)
        return tradeoff.measure(scene, self.width, self.samples, manifest.scene)

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        from ...report import trade as trade_report

        if self._folder:
            trade_report.write(self._folder, result)
        keep_trade(result, self.scene)
        show(*trade_report.table(result).split("\n"))
        return "INFO", result.advice


@named
class REFERENCE_TRACER_OT_extremes(LongWork, bpy.types.Operator):
    bl_label = "Find Where Methods Break"
    bl_description = (
        "Trace scenes that get harder and harder (far away, tiny, edge-on...) by every "
        "method, and find the first scale at which each differs from exact arithmetic"
    )
    kind = results.Kind.EXTREMES
    scenario: EnumProperty(
        name="Scenario",
        description="The scenario to measure",
        items=choices.STUDIES,
        default=choices.EVERY,
    )
    rays: IntProperty(
        name="Rays",
        description="About how many rays go through each scene; 0 for the scene's own number",
        default=0,
        min=0,
        soft_max=10000,
    )

    def begin(self, context: Context) -> Work[Any]:
        """Return the work."""
        from ...study.extremes import measure
        from ...study.scenarios.sweeps import SCENARIOS

        self._folder = self.folder()
        scenarios = [s for s in SCENARIOS if self.scenario in (choices.EVERY, s.name)]
        return measure(scenarios, self.rays or None)

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        from ...report import extremes as extremes_report

        if self._folder:
            extremes_report.write(self._folder, result)
        [said] = keep_extremes(result).lines
        show(*extremes_report.breaking_table(result).split("\n"), said)
        return "INFO", said


def keep_trade(trade: Trade, scene: int) -> results.Result:
    """Remember a trade of the scene of a `session_uid`, and write its plot for the browser."""
    from ...report import trade as trade_report

    page = _page("trade", trade_report.page(trade))
    return results.keep(results.Kind.TRADE, trade, [trade.advice], scene, page=page)


def keep_extremes(rows: Sequence[ExtremesRow]) -> results.Result:
    """Remember where each method breaks, and write the plot of it for the browser."""
    from ...report import extremes as extremes_report

    page = _page("extremes", extremes_report.page(rows))
    wrong = sum(r.lost + r.doubled for r in rows if Method(r.method).is_proven)
    lines = [f"Certified gets {f'{wrong:,} rays' if wrong else 'no ray'} wrong."]
    return results.keep(results.Kind.EXTREMES, tuple(rows), lines, page=page)


def _page(name: str, text: str) -> str:
    from ...report import folders

    path = results.session_folder() / f"{name}.html"
    folders.write_text(path, text)
    return path.as_uri()
