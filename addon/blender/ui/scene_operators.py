"""The operators that add to a scene, or write it; the work is done elsewhere."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, EnumProperty, StringProperty
from bpy.types import Context
from bpy_extras.io_utils import ExportHelper

from ...tracer.progress import Work
from ...wording import count_of, say
from .long_work import Answer, LongWork, named, why_blocked, with_ending


@named
class REFERENCE_TRACER_OT_frame_all(bpy.types.Operator):
    bl_label = "Add a Camera That Frames All"
    bl_description = (
        "Add a camera that sees all that a render shows, from the front, the right and above, "
        "and make it the scene's"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Context) -> Answer:
        from ..jobs.choice import frame_all

        camera = frame_all(context.scene, context.view_layer)
        camera.name = "Camera"
        camera.data.name = "Camera"
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_write_colors(bpy.types.Operator):
    bl_label = "Write the Colors"
    bl_description = (
        "Add a copy of the scene, of plain meshes whose materials emit the colours of a "
        "comparison. Render it with any engine, then press Trace and Compare there"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Return what is in the way: it needs a camera, and runs alone."""
        return why_blocked(context, needs_camera=True)

    def execute(self, context: Any) -> Answer:
        from ...pictures.palette import By
        from ..jobs.colors_scene import colors_scene

        made = colors_scene(context, By(context.scene.reference_tracer.colors.lower()))
        if context.window:
            context.window.scene = made
        said = rpt_("'{}' is added: render it with any engine, then press Trace and Compare")
        self.report({"INFO"}, said.format(made.name))
        return {"FINISHED"}


@named
class REFERENCE_TRACER_OT_export(ExportHelper, LongWork, bpy.types.Operator):
    bl_label = "Export Reference Tracer Scene"
    bl_description = (
        "Write what the camera sees, as a render has it, to a file that `reftrace trace "
        "FILE.npz` traces without Blender"
    )
    bl_options = set()  # it leaves nothing in Blender
    filename_ext = ".npz"
    needs_camera = True
    announced = "Blender evaluates the scene"

    filepath: StringProperty(
        name="File",
        description="The file to write; its name ends in .npz",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )
    filter_glob: StringProperty(default="*.npz", options={"HIDDEN"})

    def begin(self, context: Context) -> Work[Any]:
        """Export the scene as a render has it, and write it: it is whole, or not there."""
        from ...files.scenes import save_scene
        from ...report import folders
        from ..jobs.open_file import export_open_file

        path = with_ending(self.filepath, self.filename_ext)
        scene, manifest, _ = export_open_file(context)
        yield None
        with folders.made_for_file(path), folders.replacing_file(path) as new:
            save_scene(new, scene, manifest)
        say(*manifest.lines())
        return scene

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        return "INFO", f"{count_of(result.triangle_count, 'triangle')}: {self.filepath}"


_items: list[tuple[str, str, str]] = []  # Blender does not keep the texts that a function gives


def _conventions(operator: Any, context: Context) -> list[tuple[str, str, str]]:
    from ...camera_files.files import WRITTEN

    _items[:] = _items or [(name, own.title, own.file) for name, own in WRITTEN.items()]
    return _items


@named
class REFERENCE_TRACER_OT_export_camera(ExportHelper, bpy.types.Operator):
    bl_label = "Export Camera"
    bl_description = (
        "Write the scene's camera as another program reads it, and measure how far that is from "
        "Blender's own matrix. What the other program cannot say is refused by name"
    )
    bl_options = set()  # it leaves nothing in Blender
    filename_ext = ".json"

    filepath: StringProperty(
        name="File",
        description="The file to write, or the folder where a convention has several",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )
    convention: EnumProperty(
        name="Convention",
        description="The program that is to read the camera",
        items=_conventions,
    )
    integer_centers: BoolProperty(
        name="Pixel Centers at Integers",
        description="The center of the first pixel is at (0, 0), as in OpenCV's functions, and not "
        "at (0.5, 0.5)",
    )
    animation: BoolProperty(
        name="Animation", description="Write the camera of every frame of the scene"
    )

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Return what is in the way: it needs a camera, and runs alone."""
        return why_blocked(context, needs_camera=True)

    def check(self, context: Context) -> bool:  # type: ignore[override]  # the stub returns nothing
        """Give the file its convention's ending, a folder none; returns whether it is another."""
        from ...camera_files.files import WRITTEN

        of_files = {n: Path(c.file).suffix for n, c in WRITTEN.items() if "folder" not in c.file}
        before = self.filepath
        path = Path(before)
        if path.suffix in ("", *of_files.values()):
            self.filepath = str(path.with_suffix(of_files.get(self.convention, "")))
        return self.filepath != before

    def execute(self, context: Context) -> Answer:
        """Write the camera, or those of all frames."""
        from ...camera_files.convention import HALF, INTEGER
        from ...camera_files.files import WRITTEN
        from ...report.cameras import write_cameras
        from ..jobs.animation import frames_of
        from ..jobs.cameras import cameras
        from ..paths import absolute

        frames = frames_of(context.scene) if self.animation else None
        centers = INTEGER if self.integer_centers else HALF
        convention = WRITTEN[self.convention]
        line = write_cameras(absolute(self.filepath), list(cameras(frames)), convention, centers)
        say(line)
        self.report({"INFO"}, line)
        return {"FINISHED"}
