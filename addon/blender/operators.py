"""Trace and Compare, as a button and as an operator for scripts."""

from __future__ import annotations

import time
import traceback
from typing import Any, ClassVar

import bpy
from bpy.props import StringProperty

from ..scene import SceneError
from ..tracer.progress import result_of
from . import results
from .compare import compare_to_folder, gather

STEP = 0.04  # seconds of work between two looks at the events: Esc is answered within 0.2 s
PAUSE = 0.005  # seconds that the interface gets in between


class REFERENCE_TRACER_OT_compare(bpy.types.Operator):
    """The button and the script's way to one comparison."""

    bl_idname = "reference_tracer.compare"
    bl_label = "Trace and Compare"
    bl_description = (
        "Trace the scene with the textbook's maths, and compare every pixel with "
        "Blender's own picture"
    )
    bl_options = {"UNDO"}  # the three images are one step

    running: ClassVar[bool] = False  # in some window

    directory: StringProperty(  # type: ignore[valid-type]
        name="Folder",
        subtype="DIR_PATH",
        options={"SKIP_SAVE"},
        description="Where to write the pictures and comparison.json; nothing is written if empty",
    )

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Allow one at a time."""
        if cls.running:
            cls.poll_message_set("It is running already: Esc cancels it")
        return not cls.running

    def execute(self, context: Any) -> set[str]:
        """Run through, as a script wants it."""
        try:
            if self.directory:
                comparison = compare_to_folder(context, self.directory)
            else:
                comparison = result_of(gather(context).steps())
            self._finish(context, comparison)
        except Exception as error:
            return self._fail(error)
        return {"FINISHED"}

    def invoke(self, context: Any, event: Any) -> set[str]:
        """Gather at once, then trace while the interface stays alive."""
        if bpy.app.background or self.directory:
            return self.execute(context)
        try:
            self._work = gather(context).steps()
        except Exception as error:
            return self._fail(error)
        manager = context.window_manager
        self._timer = manager.event_timer_add(PAUSE, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        self._began = time.monotonic()
        type(self).running = True
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Work for one step, or stop at Esc."""
        if event.type == "ESC" and event.value == "PRESS":
            self._clean_up(context)
            self.report({"WARNING"}, "Trace and Compare was cancelled; nothing was changed")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        until = time.monotonic() + STEP
        try:
            while time.monotonic() < until:
                share = next(self._work)
        except StopIteration as stop:
            self._clean_up(context)
            try:
                self._finish(context, stop.value)
            except Exception as error:
                return self._fail(error)
            return {"FINISHED"}
        except Exception as error:
            self._clean_up(context)
            return self._fail(error)
        self._show_progress(context, share)
        return {"PASS_THROUGH"}  # the timers of others are theirs

    def cancel(self, context: Any) -> None:
        """Stop when Blender itself ends the operator, as at quitting or loading a file."""
        self._clean_up(context)

    def _show_progress(self, context: Any, share: float) -> None:
        context.window_manager.progress_update(int(100 * share))
        past = time.monotonic() - self._began
        left = f"  {past * (1 - share) / share:.0f} s left" if share > 0.01 else ""
        context.workspace.status_text_set(
            f"Trace and Compare: {int(100 * share)} %{left}  (Esc: cancel)"
        )

    def _clean_up(self, context: Any) -> None:
        type(self).running = False
        self._work.close()
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        if context.workspace:
            context.workspace.status_text_set(None)

    def _finish(self, context: Any, comparison: Any) -> None:
        result = results.keep(context, comparison)
        for line in (*comparison.manifest.lines(), *result.lines):
            print(f"Reference Tracer: {line}")
        for area in context.window.screen.areas if context.window else ():
            area.tag_redraw()
        level = "INFO" if comparison.verdict == "agree" else "WARNING"
        self.report({level}, result.lines[0])

    def _fail(self, error: Exception) -> set[str]:
        if not isinstance(error, (SceneError, OSError)):
            traceback.print_exc()
        self.report({"ERROR"}, str(error) or type(error).__name__)
        return {"CANCELLED"}


@bpy.app.handlers.persistent
def _file_closes(*_: Any) -> None:
    """Forget what was of the file that goes: its comparison, and one that was under way."""
    results.forget()
    REFERENCE_TRACER_OT_compare.running = False


def register() -> None:
    """Register the operator."""
    bpy.app.handlers.load_pre.append(_file_closes)
    bpy.utils.register_class(REFERENCE_TRACER_OT_compare)


def unregister() -> None:
    """Undo :func:`register`."""
    results.forget()
    bpy.app.handlers.load_pre.remove(_file_closes)
    bpy.utils.unregister_class(REFERENCE_TRACER_OT_compare)
