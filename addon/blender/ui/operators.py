"""The buttons of the comparison, and its operators for scripts. They hold no maths."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
from bpy.props import BoolProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ...tracer.progress import Work
from . import results
from .long_work import LongWork, named, say, with_ending
from .properties import SAID
from .results import Kind, redraw


@named
class REFERENCE_TRACER_OT_compare(LongWork, bpy.types.Operator):
    needs_camera = True

    def begin(self, context: Any) -> Work[Any]:
        """Have Blender draw the scene at once; return the work that is left."""
        from ..compare import compare_to_folder, compared, gather_case

        if folder := self.folder():
            return compare_to_folder(context, str(folder))
        return compared(gather_case(context))

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        lines = results.keep_comparison(context, result).lines
        say(*result.manifest.lines(), *lines)
        return "INFO" if result.verdict == "agree" else "WARNING", lines[0]


@named
class REFERENCE_TRACER_OT_compare_all(LongWork, bpy.types.Operator):
    needs_camera = True

    def begin(self, context: Any) -> Work[Any]:
        """Have every engine draw the scene at once; return the work that is left."""
        from ..compare import compare_all

        return compare_all(context, str(self.folder() or ""))

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        from ...compare import engines
        from ...report import engines as engines_report

        lines = engines_report.lines(result)
        say(*results.keep(Kind.ENGINES, tuple(result), lines, context.scene.name).lines)
        verdict = engines.worst(result)
        text = ", ".join(f"{row.engine}: {row.verdict}" for row in result)
        return "INFO" if verdict == "agree" else "WARNING", text[0].upper() + text[1:]


@named
class REFERENCE_TRACER_OT_compare_animation(LongWork, bpy.types.Operator):
    needs_camera = alone = True

    def begin(self, context: Any) -> Work[Any]:
        from ...compare.animation import worst_first
        from ...report import animation as frames_report
        from ...scene import SceneError
        from .. import animation

        if context.screen and context.screen.is_animation_playing:
            raise SceneError("The animation is playing: stop it, then compare it.")
        folder = self.folder() or results.session_folder() / "animation"
        frames = animation.frames_of(context.scene)

        def told(rows: list[Any]) -> None:
            content = folder / frames_report.PAGE, worst_first(rows)
            lines = frames_report.lines(frames, rows)
            found = results.keep(Kind.FRAMES, content, lines, context.scene.name)
            self.left = ", ".join(found.lines[-2:])
            redraw(context)

        return animation.compare_frames(str(folder), frames, told)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        say(*results.latest(Kind.FRAMES, context.scene).lines)
        return "INFO" if self.left.endswith(": agree") else "WARNING", self.left.capitalize()


@named
class REFERENCE_TRACER_OT_open_page(LongWork, bpy.types.Operator):
    bl_options: set[str] = set()  # it leaves nothing in Blender

    open_browser: BoolProperty(options={"SKIP_SAVE"}, **SAID["open_page"]["open_browser"])  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Allow it where there is a comparison, and nothing else at work."""
        found = results.latest(Kind.COMPARISON, context.scene)
        if not found:
            cls.poll_message_set("Trace and Compare comes first")
        return super().poll(context) and bool(found)

    def begin(self, context: Any) -> Work[Any]:
        from ...report import page

        self._folder = self.folder() or results.session_folder()
        self._comparison = results.latest(Kind.COMPARISON, context.scene).content
        return page.extras(self._comparison)

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        """Write the page, with the studies that there are, and open it."""
        from ...report import page

        path = self._folder / page.NAME
        kinds = Kind.TRADE, Kind.EXTREMES
        kept = {kind.name.lower(): results.latest(kind, context.scene) for kind in kinds}
        more = {name: found.content for name, found in kept.items() if found and found.content}
        page.write(path, self._comparison, replace(result, **more))
        if self.open_browser:
            bpy.ops.wm.url_open(url=path.resolve().as_uri())
        return "INFO", f"The page is {path}"


@named
class REFERENCE_TRACER_OT_frame_all(bpy.types.Operator):
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Any) -> set[str]:
        from ..reading.choice import frame_all

        camera = frame_all(context.scene, context.view_layer)
        camera.name = camera.data.name = "Camera"
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_export(ExportHelper, LongWork, bpy.types.Operator):
    bl_options: set[str] = set()  # it leaves nothing in Blender
    filename_ext = ".npz"
    needs_camera = True

    filepath: StringProperty(options={"SKIP_SAVE"}, **SAID["export"]["filepath"])  # type: ignore[valid-type]
    filter_glob: StringProperty(default="*.npz", options={"HIDDEN"})  # type: ignore[valid-type]

    def begin(self, context: Any) -> Work[Any]:
        """Export the scene as a render has it, and write it: it is whole, or not there."""
        from ...report import folders
        from ...scene_files import save_scene
        from ..compare import export_open_file

        path = with_ending(self.filepath, self.filename_ext)
        scene, manifest, _ = export_open_file(context)
        yield 0.5
        with folders.made_for_file(path), folders.replacing_file(path) as new:
            save_scene(new, scene)
        say(*manifest.lines())
        return scene

    def finish(self, context: Any, result: Any) -> tuple[str, str]:
        return "INFO", f"{result.triangle_count:,} triangles: {self.filepath}"
