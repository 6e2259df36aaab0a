"""The pixel inspector: a click on a pixel shows how it comes about.

`picking.py` finds the pixel under the mouse; `reference_tracer.explain` does the work. A ray that
is drawn is a step of undo.
"""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.types import Context, Event

from .long_work import Answer, named, why_blocked

_HINT = (
    "Pixel Inspector: click a pixel in the render, in an image of the comparison, or in the "
    "camera's view  (Esc: end)"
)


@named
class REFERENCE_TRACER_OT_inspect(bpy.types.Operator):
    bl_label = "Inspect Pixels"
    bl_description = (
        "Click on pixels in the render, in an image of the comparison, or in the camera's "
        "view, and read how each comes about. Esc ends it"
    )
    running: ClassVar[bool] = False

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Allow one at a time, where there is a camera, and none beside long work."""
        if cls.running:
            return rpt_("The inspector is on: click a pixel, or end it with Esc")
        return why_blocked(context, needs_camera=True)

    def execute(self, context: Context) -> Answer:
        """Refuse a script's call: it has no mouse."""
        self.report({"ERROR"}, "There is no mouse to click with: use reference_tracer.explain")
        return {"CANCELLED"}

    def invoke(self, context: Context, event: Event) -> Answer:
        if bpy.app.background:
            return self.execute(context)
        type(self).running = True
        context.window.cursor_modal_set("EYEDROPPER")
        context.workspace.status_text_set(rpt_(_HINT))
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Event) -> Answer:
        """Explain the pixel under a click; leave all else to the interface."""
        if event.type == "ESC" and event.value == "PRESS":
            self.cancel(context)
            return {"FINISHED"}
        if event.type != "LEFTMOUSE" or event.value != "PRESS":
            return {"PASS_THROUGH"}
        from ...errors import words
        from ...scene import SceneError
        from .picking import pick

        try:
            found = pick(context, event.mouse_x, event.mouse_y)
            if found is None:
                return {"PASS_THROUGH"}
            draw_ray = context.window_manager.reference_tracer.draw_ray
            # As a button does it: a ray that is drawn is a step of undo.
            ops: Any = bpy.ops
            ops.reference_tracer.explain("EXEC_DEFAULT", True, **found._asdict(), draw_ray=draw_ray)
        except (SceneError, RuntimeError) as error:  # what an operator reports is one, too
            said = words(error).removeprefix("Error: ")
            self.report({"WARNING"}, said)
            context.workspace.status_text_set(f"{said}  (Esc: end)")
        else:
            context.workspace.status_text_set(rpt_(_HINT))
        return {"RUNNING_MODAL"}

    def cancel(self, context: Context) -> None:
        """End, also when Blender itself ends it, as at quitting or loading a file."""
        type(self).running = False
        if context.window:
            context.window.cursor_modal_restore()
        if context.workspace:
            context.workspace.status_text_set(None)
