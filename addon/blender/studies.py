"""The trade and the extremes: their work, their files, and their operators."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

from ..report import extremes as extremes_report
from ..report import trade as trade_report
from ..study import tradeoff
from ..study.extremes import measure
from ..study.scenarios.sweeps import ALL, MAPS
from ..tracer.progress import Work
from . import results, scenario_scene
from .compare import export_open_file
from .long_work import LongWork, failed, say
from .properties import SAID, SWEEPS

_TRADE, _EXTREMES, _SCENE = (SAID[of] for of in ("trade", "extremes", "extreme_scene"))
EVERY = "ALL"  # in place of a scenario's name
STUDIES = [
    (EVERY, "All", "Every scenario, and the maps of two scales at once"),
    *SWEEPS,
    *((m.name, m.title, m.explanation) for m in MAPS),
]


class REFERENCE_TRACER_OT_trade(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.trade"
    bl_label = "Measure the Trade"
    bl_description = (
        "Measure on this scene and camera what every method, precision, number of samples and "
        "size takes, and what it gets wrong"
    )
    needs_camera = True

    width: IntProperty(default=tradeoff.WIDTH, **_TRADE["width"])  # type: ignore[valid-type]
    samples: IntProperty(default=tradeoff.SAMPLES, **_TRADE["samples"])  # type: ignore[valid-type]

    def begin(self, context: Any) -> Work[Any]:
        """Export the scene at once, as a render has it; return the work of measuring."""
        self._folder = self.folder()
        scene, manifest, _ = export_open_file(context)
        return tradeoff.measure(scene, self.width, self.samples, manifest.scene)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        if self._folder:
            trade_report.write(self._folder, result)
        results.keep_trade(result)
        print(trade_report.table(result))
        return "INFO", result.advice


class REFERENCE_TRACER_OT_extremes(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.extremes"
    bl_label = "Find Where Methods Break"
    bl_description = (
        "Trace scenes that get harder and harder (far away, tiny, edge-on...) by every method, and "
        "find the first scale at which each goes wrong against exact arithmetic"
    )

    scenario: EnumProperty(items=STUDIES, default=EVERY, **_EXTREMES["scenario"])  # type: ignore[valid-type]
    rays: IntProperty(**_EXTREMES["rays"])  # type: ignore[valid-type]

    def begin(self, context: Any) -> Work[Any]:
        """Return the work; a map has a scenario of its name for each of its rows."""
        self._folder = self.folder()
        scenarios = [s for s in ALL if self.scenario in (EVERY, s.name)]
        return measure(scenarios, self.rays or None)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        if self._folder:
            extremes_report.write(self._folder, result)
        [said] = results.keep_extremes(result).lines
        print(extremes_report.breaking_table(result), said, sep="\n")
        return "INFO", said


class REFERENCE_TRACER_OT_extreme_scene(bpy.types.Operator):
    bl_idname = "reference_tracer.extreme_scene"
    bl_label = "Open Scenario as a Scene"
    bl_description = (
        "Build a scenario at one of its scales as a new scene with its camera and meshes, as "
        "closely as Blender's float32 allows, to look at and to trace and compare there"
    )
    bl_options = {"UNDO"}

    scenario: EnumProperty(items=SWEEPS, **_SCENE["scenario"])  # type: ignore[valid-type]
    scale: StringProperty(**_SCENE["scale"])  # type: ignore[valid-type]
    width: IntProperty(**_SCENE["width"])  # type: ignore[valid-type]

    def execute(self, context: Any) -> set[str]:
        try:
            scene = scenario_scene.open_scenario(context, self.scenario, self.scale, self.width)
        except Exception as error:
            return failed(self, error)
        changed = scene[scenario_scene.CHANGED].split("\n")
        say(f"{scene.name}:", *changed)
        self.report({"INFO"}, f"{scene.name}: {changed[0]}")
        return {"FINISHED"}


CLASSES = (
    REFERENCE_TRACER_OT_trade,
    REFERENCE_TRACER_OT_extremes,
    REFERENCE_TRACER_OT_extreme_scene,
)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
