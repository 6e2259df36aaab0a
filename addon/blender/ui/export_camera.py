"""The operator that writes the scene's camera as another program reads it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty
from bpy.types import Context
from bpy_extras.io_utils import ExportHelper

from ...wording import say
from .long_work import Answer, is_blocked, named

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
    def poll(cls, context: Context) -> bool:
        """Allow it where there is a camera, and nothing else at work."""
        return not is_blocked(cls, context, needs_camera=True)

    def check(self, context: Context) -> bool:  # type: ignore[override]  # the stub returns nothing
        """Give the file the ending of the convention; returns whether the name is another now."""
        from ...camera_files.files import WRITTEN

        ending = Path(WRITTEN[self.convention].file).suffix
        before = self.filepath
        path = Path(before)
        endings = {Path(c.file).suffix for c in WRITTEN.values()}
        if not path.suffix or path.suffix in endings:
            self.filepath = str(path.with_suffix(ending))
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
