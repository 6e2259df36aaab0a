"""The trade and the extremes: their work, their files, and their operators."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

from ...tracer.progress import Work
from . import results
from .long_work import LongWork, named, say
from .properties import MAPS, SAID, SWEEPS

_TRADE, _EXTREMES, _SCENE = (SAID[of] for of in ("trade", "extremes", "extreme_scene"))
EVERY = "ALL"  # in place of a scenario's name
STUDIES = [(EVERY, "All", "Every scenario, and the maps of two scales at once"), *SWEEPS, *MAPS]


@named
class REFERENCE_TRACER_OT_trade(LongWork, bpy.types.Operator):
    needs_camera = True

    width: IntProperty(**_TRADE["width"])  # type: ignore[valid-type]
    samples: IntProperty(**_TRADE["samples"])  # type: ignore[valid-type]

    def begin(self, context: Any) -> Work[Any]:
        """Export the scene at once, as a render has it; return the work of measuring."""
        from ...study import tradeoff
        from ..compare import export_open_file

        self._folder = self.folder()
        scene, manifest, _ = export_open_file(context)
        return tradeoff.measure(scene, self.width, self.samples, manifest.scene)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        from ...report import trade as trade_report

        if self._folder:
            trade_report.write(self._folder, result)
        results.keep_trade(result)
        print(trade_report.table(result))
        return "INFO", result.advice


@named
class REFERENCE_TRACER_OT_extremes(LongWork, bpy.types.Operator):
    scenario: EnumProperty(items=STUDIES, default=EVERY, **_EXTREMES["scenario"])  # type: ignore[valid-type]
    rays: IntProperty(**_EXTREMES["rays"])  # type: ignore[valid-type]

    def begin(self, context: Any) -> Work[Any]:
        """Return the work; a map has a scenario of its name for each of its rows."""
        from ...study.extremes import measure
        from ...study.scenarios.sweeps import ALL

        self._folder = self.folder()
        scenarios = [s for s in ALL if self.scenario in (EVERY, s.name)]
        return measure(scenarios, self.rays or None)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        from ...report import extremes as extremes_report

        if self._folder:
            extremes_report.write(self._folder, result)
        [said] = results.keep_extremes(result).lines
        print(extremes_report.breaking_table(result), said, sep="\n")
        return "INFO", said


@named
class REFERENCE_TRACER_OT_extreme_scene(bpy.types.Operator):
    bl_options = {"UNDO"}

    scenario: EnumProperty(items=SWEEPS, **_SCENE["scenario"])  # type: ignore[valid-type]
    scale: StringProperty(**_SCENE["scale"])  # type: ignore[valid-type]
    width: IntProperty(**_SCENE["width"])  # type: ignore[valid-type]

    def execute(self, context: Any) -> set[str]:
        from . import scenario_scene

        scene = scenario_scene.open_scenario(context, self.scenario, self.scale, self.width)
        changed = scene[scenario_scene.CHANGED].split("\n")
        say(f"{scene.name}:", *changed)
        self.report({"INFO"}, f"{scene.name}: {changed[0]}")
        return {"FINISHED"}
