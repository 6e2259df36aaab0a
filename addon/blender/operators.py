"""The add-on's buttons, and its operators for scripts. They hold no maths."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

from ..compare import engines
from ..compare.comparison import Comparison
from ..report import extremes as extremes_report
from ..report import trade as trade_report
from ..scene import SceneError
from ..study import tradeoff
from ..study.scenarios.sweeps import MAPS
from ..tracer.progress import Work
from . import results, scenario_scene, studies
from .compare import compare_all, compare_to_folder, compared, gather
from .judges import JUDGES
from .long_work import LongWork
from .properties import SWEEPS

STUDIES = [
    (studies.EVERY, "All", "Every scenario, and the maps of two scales at once"),
    *SWEEPS,
    *((m.name, m.title, m.explanation) for m in MAPS),
]

*_FIRST, _LAST = ("the viewport" if j.needs_window else j.label for j in JUDGES.values())
_ENGINES = f"{', '.join(_FIRST)} and {_LAST}"


class REFERENCE_TRACER_OT_compare(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.compare"
    bl_label = "Trace and Compare"
    bl_description = (
        "Trace the scene by the method that is chosen, and compare every pixel with Blender's own "
        "picture; the textbook's formulas and the proven picture are listed side by side"
    )

    def begin(self, context: Any) -> Work[Comparison]:
        """Have Blender draw the scene at once; return the work that is left."""
        if self.directory:
            return compare_to_folder(context, self.directory)
        return compared(gather(context))

    def finish(self, context: Any, result: Comparison) -> tuple[str, str]:
        """Show the pictures and the numbers."""
        lines = results.keep_comparison(context, result).lines
        _print(*result.manifest.lines(), *lines)
        return "INFO" if result.verdict == "agree" else "WARNING", lines[0]


class REFERENCE_TRACER_OT_compare_all(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.compare_all"
    bl_label = "Compare All Engines"
    bl_description = (
        f"Trace the scene, and compare {_ENGINES} with it, each in turn: which of them shows a "
        "wrong object, where, and why"
    )

    def begin(self, context: Any) -> Work[Any]:
        """Have every engine draw the scene at once; return the work that is left."""
        return compare_all(context, self.directory)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        """Show the table."""
        _print(*results.keep_engines(context, result).lines)
        verdict = engines.worst(result)
        text = ", ".join(f"{row.engine}: {row.verdict}" for row in result)
        return "INFO" if verdict == "agree" else "WARNING", text[0].upper() + text[1:]


class REFERENCE_TRACER_OT_trade(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.trade"
    bl_label = "Measure the Trade"
    bl_description = (
        "Measure on this scene and camera what every method, precision, number of samples and "
        "size takes, and what it gets wrong"
    )

    width: IntProperty(  # type: ignore[valid-type]
        name="Width",
        default=tradeoff.WIDTH,
        min=1,
        soft_max=1920,
        description="Of the largest picture that is measured, in pixels; its height follows",
    )
    samples: IntProperty(  # type: ignore[valid-type]
        name="Samples",
        default=tradeoff.SAMPLES,
        min=1,
        max=16,
        description="Up to this number squared of rays a pixel are measured",
    )

    def begin(self, context: Any) -> Work[Any]:
        """Export the scene at once; return the work of measuring."""
        self._folder = self.folder()
        return studies.trade(context, self.width, self.samples)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        """Show the table, the plot and the advice."""
        studies.write(trade_report, self._folder, result)
        lines = results.keep_trade(context, result).lines
        print(trade_report.table(result), *lines[1:], sep="\n")
        return _told(lines)


class REFERENCE_TRACER_OT_extremes(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.extremes"
    bl_label = "Find Where Methods Break"
    bl_description = (
        "Trace scenes that get harder and harder (far away, tiny, edge-on...) by every method, and "
        "find the first scale at which each goes wrong against exact arithmetic"
    )

    scenario: EnumProperty(name="Scenario", items=STUDIES, default=studies.EVERY)  # type: ignore[valid-type]
    rays: IntProperty(  # type: ignore[valid-type]
        name="Rays",
        default=0,
        min=0,
        soft_max=10_000,
        description="About so many through each scene; 0 for each scene's own number",
    )

    def begin(self, context: Any) -> Work[Any]:
        """Return the work."""
        self._folder = self.folder()
        return studies.extremes(self.scenario, self.rays or None)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        """Show the breaking points and the maps."""
        studies.write(extremes_report, self._folder, result)
        lines = results.keep_extremes(context, result).lines
        print(extremes_report.breaking_table(result), *lines, sep="\n")
        return _told(lines)


class REFERENCE_TRACER_OT_extreme_scene(bpy.types.Operator):
    bl_idname = "reference_tracer.extreme_scene"
    bl_label = "Open Scenario as a Scene"
    bl_description = (
        "Build a scenario at one of its scales as a new scene with its camera and meshes, as "
        "closely as Blender's float32 allows, to look at and to trace and compare there"
    )
    bl_options = {"UNDO"}

    scenario: EnumProperty(name="Scenario", items=SWEEPS)  # type: ignore[valid-type]
    scale: StringProperty(  # type: ignore[valid-type]
        name="Scale",
        description="A number, such as 1e8; the scenario's last and hardest if empty",
    )
    width: IntProperty(  # type: ignore[valid-type]
        name="Width",
        default=0,
        min=0,
        soft_max=1920,
        description="Of the picture, in pixels; 0 for that of the study, one ray a pixel",
    )

    def execute(self, context: Any) -> set[str]:
        """Build the scene, and go there."""
        try:
            scene = scenario_scene.open_scenario(context, self.scenario, self.scale, self.width)
        except SceneError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        changed = scene[scenario_scene.CHANGED].split("\n")
        _print(f"{scene.name}:", *changed)
        self.report({"INFO"}, f"{scene.name}: {changed[0]}")
        return {"FINISHED"}


def _print(*lines: str) -> None:
    for line in lines:
        print(f"Reference Tracer: {line}")


def _told(lines: tuple[str, ...]) -> tuple[str, str]:
    """Return what to report of a study: its sentence, and that its picture can't be had."""
    if lines[1:]:
        return "WARNING", f"{lines[0]} (No picture without Matplotlib: the panel says how.)"
    return "INFO", lines[0]


CLASSES = (
    REFERENCE_TRACER_OT_compare,
    REFERENCE_TRACER_OT_compare_all,
    REFERENCE_TRACER_OT_trade,
    REFERENCE_TRACER_OT_extremes,
    REFERENCE_TRACER_OT_extreme_scene,
)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
