"""Operators' base classes; long work goes on in steps while the interface stays alive.

An operator returns the work from `begin`: a generator that yields events. Its `show` shows what is
found on the way, and its `finish` the result. A script's call runs through. A button's call goes on
in small steps, with progress, the time left, and Esc. Only one runs at a time.
"""

from __future__ import annotations

import time
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias, TypeVar

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import StringProperty
from bpy.types import Context, Event

from ...tracer.progress import Found, Meter, Work, result_of
from ...wording import say
from ..slowest import announced
from ..temporary import is_temporary
from ..versions import RELATIVE
from .areas import redraw, redraw_said
from .preferences import default_folder
from .results import Kind, drop

if TYPE_CHECKING:
    from bpy.stub_internal.rna_enums import OperatorReturnItems

    Mixin = bpy.types.Operator  # what it is mixed into
else:
    Mixin = object

Answer: TypeAlias = "set[OperatorReturnItems]"
T = TypeVar("T", bound=type)

SECONDS_A_STEP = 0.04  # of work between two looks at the events: Esc is answered within 0.2 s
PAUSE = 0.005  # seconds that the interface gets in between
SHOWN_EVERY = 0.25  # seconds: showing progress redraws the window, which may cost more than a step

OPERATORS: list[type] = []  # to be registered


def named(operator: T) -> T:
    """Give an operator its identifier, have it report errors, and have it registered.

    Where it says by `blocked` why it cannot be pressed, its tooltip does, too.
    """
    own: Any = operator
    execute = own.execute

    def guarded(self: Any, context: Context) -> Answer:
        try:
            return execute(self, context)
        except Exception as error:
            return failed(self, error)

    own.bl_idname = f"reference_tracer.{operator.__name__.rpartition('_OT_')[2]}"
    own.execute = guarded
    if hasattr(own, "blocked"):
        own.poll = classmethod(_poll)
    OPERATORS.append(operator)
    return operator


def _poll(operator: Any, context: Context) -> bool:
    why = operator.blocked(context)
    if why:
        operator.poll_message_set(why)
    return not why


class LongWork(Mixin):
    """Mixed into an operator with long work, which gives its `begin` and its `finish`."""

    bl_options = set()  # it leaves results, which no undo step has

    running: ClassVar[str] = ""  # the label of the one that is, in whichever window
    said: ClassVar[str] = ""  # what it does, how far it is, and how to end it
    meter: ClassVar[Meter] = Meter()  # how far it is
    _work: ClassVar[Work[Any]]  # of that one
    _timer: ClassVar[Any]
    _told: ClassVar[set[int]] = set()  # the addresses of the workspaces whose status bar says so
    kind: Kind | None = None  # of its result: if it fails, the one before is dropped
    needs_camera: ClassVar[bool] = False
    alone: ClassVar[bool] = False  # the user's scene is at work: the window hears nothing but Esc
    left: str = "nothing was changed"  # at Esc
    announced: ClassVar[str] = ""  # what is done in one go at the beginning, and takes long
    pressed: bool = False  # by a user, who is to see the result
    scene: int  # the `session_uid` of the scene that it is of

    directory: StringProperty(
        name="Folder",
        description="The folder for the results. If this is empty, they go where the preferences "
        "say, or nowhere",
        subtype="DIR_PATH",
        options={"SKIP_SAVE"} | RELATIVE,
    )

    def folder(self) -> Path | None:
        """Make the folder, and return it; None where nothing is to be written."""
        from ...report import folders
        from ..paths import absolute

        directory = self.directory or default_folder(self.bl_idname.rpartition("_OT_")[2])
        if directory and not self.directory:
            say(f"Results go to {directory}")
        if not directory:
            return None
        folder = absolute(directory)
        folders.make(folder)
        return folder

    def begin(self, context: Context) -> Work[Any]:
        """Return the work; what has to be done in one go is done here."""
        raise NotImplementedError

    def show(self, context: Context, result: Any) -> Work[None]:
        """Show a result: the last one, and each that is there before the end."""
        yield from ()

    def finish(self, context: Context, result: Any) -> tuple[str, str]:
        """Show the result of the work; return what to report: 'INFO' or 'WARNING', and a text."""
        raise NotImplementedError

    @classmethod
    def blocked(cls, context: Context) -> str:
        """Return why it cannot be pressed: one runs at a time, with a camera if it needs one."""
        return why_blocked(context, cls.needs_camera)

    def execute(self, context: Context) -> Answer:
        """Run through, as a script wants it."""
        return result_of(self._run(context))

    def invoke(self, context: Context, event: Event) -> Answer:
        """Begin, and go on while the interface stays alive."""
        if bpy.app.background:
            return self.execute(context)
        LongWork._work = self._run(context)
        manager = context.window_manager
        LongWork._timer = manager.event_timer_add(PAUSE, window=context.window)
        manager.progress_begin(0, 100)
        manager.modal_handler_add(self)
        self._began = time.monotonic()
        self._shown = self._began
        LongWork.running = self.bl_label
        LongWork.meter = Meter()
        self.pressed = True
        self._say(context, self.announced and announced(context.view_layer, self.announced))
        return {"RUNNING_MODAL"}

    def _run(self, context: Context) -> Work[Answer]:
        """Do the work, show what it finds, and report its result.

        It begins once what is announced has been drawn: before the timer's first event.
        """
        self.scene = context.scene.session_uid  # its name, and the window's scene, may change
        with closing(self.begin(context)) as work:
            while True:
                try:
                    event = next(work)
                except StopIteration as stop:
                    result = stop.value
                    break
                if isinstance(event, Found):
                    yield from self.show(context, event.result)
                else:
                    yield event
            yield from self.show(context, result)
        level, text = self.finish(context, result)
        redraw(context)
        kind: Any = {level}
        self.report(kind, text)
        return {"FINISHED"}

    def modal(self, context: Context, event: Event) -> Answer:
        """Work for one step, or stop at Esc."""
        if event.type == "ESC" and event.value == "PRESS":
            self.stop(context)
            said = rpt_("{} was cancelled; {}").format(rpt_(self.bl_label), rpt_(self.left))
            self.report({"WARNING"}, said)
            return {"CANCELLED"}
        if event.type != "TIMER":
            is_alone = self.alone or any(map(is_temporary, bpy.data.scenes))
            return {"RUNNING_MODAL"} if is_alone else {"PASS_THROUGH"}
        until = time.monotonic() + SECONDS_A_STEP
        meter = self.meter
        words = meter.words
        try:
            meter.read(next(self._work))  # once in any case: a busy machine may come too late
            while time.monotonic() < until and meter.words == words:
                meter.read(next(self._work))
        except StopIteration as stop:
            self.stop(context)
            answer: Answer = stop.value
            return answer
        except Exception as error:
            self.stop(context)
            return failed(self, error)
        if meter.words != words or time.monotonic() - self._shown >= SHOWN_EVERY:
            self._show_progress(context)
        return {"PASS_THROUGH"}  # the timers of others are theirs

    def _show_progress(self, context: Context) -> None:
        self._shown = time.monotonic()
        percent = int(100 * self.meter.share)
        context.window_manager.progress_update(percent)
        seconds = self.meter.seconds(self._shown - self._began)
        left = "" if seconds is None else f"  {seconds:.0f} s"
        self._say(context, self.meter.words, f": {percent} %{left}")

    def _say(self, context: Context, what: str, rest: str = "") -> None:
        """Show in the status bar and the editors what is done, how far it is, and how to end it."""
        what = ": ".join(map(rpt_, what.split(": ")))  # the frame, too
        said = ", ".join(filter(None, (rpt_(self.bl_label), what))) + rest
        LongWork.said = f"{said}  ({rpt_('Esc: cancel')})"
        LongWork._told.add(context.workspace.as_pointer())
        context.workspace.status_text_set(LongWork.said)
        redraw_said()

    def cancel(self, context: Context) -> None:
        """Stop, as Blender itself asks for at quitting or loading a file."""
        self.stop(context)

    @staticmethod
    def stop(context: Context) -> None:
        """Stop whatever is running."""
        LongWork.running = ""
        LongWork._work.close()
        context.window_manager.event_timer_remove(LongWork._timer)
        context.window_manager.progress_end()
        for workspace in bpy.data.workspaces:  # the user may have gone to another one
            if workspace.as_pointer() in LongWork._told:
                workspace.status_text_set(None)
        LongWork._told.clear()
        redraw_said()


def failed(operator: Any, error: Exception) -> Answer:
    """Have an operator report an error, with a traceback if it is a fault of ours, and end.

    What is on the screen is not taken for its result.
    """
    from ...errors import EXPECTED, show_traceback, words

    if kind := getattr(operator, "kind", None):
        drop(kind)
        redraw(bpy.context)
    if not isinstance(error, EXPECTED):
        show_traceback(error)
    operator.report({"ERROR"}, words(error))
    return {"CANCELLED"}


def with_ending(filepath: str, *endings: str) -> Path:
    """Return the path of a file with one of these endings.

    // is beside the .blend.

    Raises
    ------
    SceneError
        If it has another.
    """
    from ...scene import SceneError
    from ..paths import absolute

    path = absolute(filepath)
    if path.suffix.lower() not in endings:
        raise SceneError(f"'{filepath}' must end in {' or '.join(endings)}")
    return path


def why_blocked(context: Context, needs_camera: bool) -> str:
    """Return what is in the way, in words: long work, or that there is no camera."""
    if LongWork.running:
        return rpt_("{} is running: Esc cancels it").format(rpt_(LongWork.running))
    if needs_camera and context.scene.camera is None:
        said = rpt_("Scene '{}' has no camera: add one, or make one active")
        return said.format(context.scene.name)
    return ""
