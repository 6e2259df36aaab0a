"""The buttons of the comparison, and its operators for scripts. They hold no maths."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
from bpy.props import BoolProperty

from ..compare import engines
from ..compare.animation import FrameRow, worst_first
from ..compare.comparison import Comparison
from ..compare.engines import EngineRow
from ..report import animation as frames_report
from ..report import engines as engines_report
from ..report import page
from ..scene import SceneError
from ..study.extremes import ExtremesRow
from ..study.trade import Trade
from ..tracer.progress import Work
from . import animation, results
from .choice import frame_all
from .compare import compare_all, compare_to_folder, compared, gather_case
from .judges import JUDGES
from .long_work import LongWork, failed, say
from .properties import SAID
from .results import redraw

*_FIRST, _LAST = ("the viewport" if j.needs_window else j.label for j in JUDGES.values())
_ENGINES = f"{', '.join(_FIRST)} and {_LAST}"


class REFERENCE_TRACER_OT_compare(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.compare"
    bl_label = "Trace and Compare"
    bl_description = (
        "Trace the scene by the method that is chosen, and compare every pixel with Blender's own "
        "picture; the textbook's formulas and the proven picture are listed side by side"
    )
    needs_camera = True

    def begin(self, context: Any) -> Work[Comparison]:
        """Have Blender draw the scene at once; return the work that is left."""
        if self.directory:
            return compare_to_folder(context, self.directory)
        return compared(gather_case(context))

    def finish(self, context: Any, result: Comparison) -> tuple[str, str]:
        lines = results.keep_comparison(context, result).lines
        say(*result.manifest.lines(), *lines)
        return "INFO" if result.verdict == "agree" else "WARNING", lines[0]


class REFERENCE_TRACER_OT_compare_all(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.compare_all"
    bl_label = "Compare All Engines"
    bl_description = (
        f"Trace the scene, and compare {_ENGINES} with it, each in turn: which of them shows a "
        "wrong object, where, and why"
    )
    needs_camera = True

    def begin(self, context: Any) -> Work[Any]:
        """Have every engine draw the scene at once; return the work that is left."""
        return compare_all(context, self.directory)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        lines = engines_report.lines(result)
        say(*results.keep(EngineRow, tuple(result), lines, context.scene.name).lines)
        verdict = engines.worst(result)
        text = ", ".join(f"{row.engine}: {row.verdict}" for row in result)
        return "INFO" if verdict == "agree" else "WARNING", text[0].upper() + text[1:]


class REFERENCE_TRACER_OT_compare_animation(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.compare_animation"
    bl_label = "Compare Animation"
    bl_description = (
        "Step the scene through its frames, in order, and compare each: the worst come first. Esc "
        "keeps the frames that are done; the scene goes back to where it is"
    )
    needs_camera = alone = True

    def begin(self, context: Any) -> Work[Any]:
        if context.screen and context.screen.is_animation_playing:
            raise SceneError("The animation is playing: stop it, then compare it.")
        folder = self.folder() or results.session_folder() / "animation"
        frames = animation.frames_of(context.scene)

        def told(rows: list[FrameRow]) -> None:
            content = folder / frames_report.PAGE, worst_first(rows)
            lines = frames_report.lines(frames, rows)
            found = results.keep(FrameRow, content, lines, context.scene.name)
            self.left = ", ".join(found.lines[-2:])
            redraw(context)

        return animation.compare_frames(str(folder), frames, told)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        say(*results.latest(FrameRow, context.scene).lines)
        return "INFO" if self.left.endswith(": agree") else "WARNING", self.left.capitalize()


class REFERENCE_TRACER_OT_open_page(LongWork, bpy.types.Operator):
    bl_idname = "reference_tracer.open_page"
    bl_label = "Open Page"
    bl_description = (
        "Write the comparison as one HTML file, with every pixel's cause, numbers and derivation, "
        "and what was measured besides, and open it in the browser"
    )
    bl_options: set[str] = set()  # it leaves nothing in Blender

    open_browser: BoolProperty(options={"SKIP_SAVE"}, **SAID["open_page"]["open_browser"])  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Allow it where there is a comparison, and nothing else at work."""
        found = results.latest(Comparison, context.scene)
        if not found:
            cls.poll_message_set("Trace and Compare comes first")
        return super().poll(context) and bool(found)

    def begin(self, context: Any) -> Work[page.Extras]:
        self._folder = self.folder() or results.session_folder()
        self._comparison = results.latest(Comparison, context.scene).content
        return page.extras(self._comparison)

    def finish(self, context: Any, result: page.Extras) -> tuple[str, str]:
        """Write the page, with the studies that there are, and open it."""
        path = self._folder / page.NAME
        kinds = {"trade": Trade, "extremes": ExtremesRow}
        kept = {name: results.latest(kind, context.scene) for name, kind in kinds.items()}
        more = {name: found.content for name, found in kept.items() if found and found.content}
        page.write(path, self._comparison, replace(result, **more))
        if self.open_browser:
            bpy.ops.wm.url_open(url=path.resolve().as_uri())
        return "INFO", f"The page is {path}"


class REFERENCE_TRACER_OT_frame_all(bpy.types.Operator):
    bl_idname = "reference_tracer.frame_all"
    bl_label = "Add a Camera That Frames All"
    bl_description = (
        "Add a camera that sees all that a render shows, from the front, the right and above, and "
        "make it the scene's"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Any) -> set[str]:
        try:
            camera = frame_all(context.scene, context.view_layer)
        except Exception as error:
            return failed(self, error)
        camera.name = camera.data.name = "Camera"
        return {"FINISHED"}


CLASSES = (
    REFERENCE_TRACER_OT_frame_all,
    REFERENCE_TRACER_OT_compare,
    REFERENCE_TRACER_OT_compare_all,
    REFERENCE_TRACER_OT_compare_animation,
    REFERENCE_TRACER_OT_open_page,
)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
