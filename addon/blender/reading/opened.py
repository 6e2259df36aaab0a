"""Opens a .blend, and remembers what Blender reported of it.

Blender opens a file also where it cannot take over all that is in it, such as a strip of the
sequencer in a channel that it does not have: it reports an error, and goes on.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import bpy
from bpy.types import Window

from ...wording import show

_reports: dict[str, tuple[str, ...]] = {}  # by the file's path: of the one that was opened last


def open_file(path: Path) -> None:
    """Open a .blend, without its scripts and its windows.

    Nothing of it is evaluated yet: the world matrix of each object is still the identity.

    Raises
    ------
    RuntimeError
        If it cannot be opened, with Blender's reason. What was open before then still is.
    """
    said: list[str] = []
    printed = StringIO()  # what Blender reports by Python, which is no result of ours
    try:
        with _heard() as loaded, redirect_stdout(printed):
            bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), load_ui=False, use_scripts=False)
    except RuntimeError as error:
        if not loaded:
            raise
        said = [line.removeprefix("Error: ").strip() for line in str(error).splitlines()]
    finally:
        show(*printed.getvalue().splitlines(), file=sys.stderr)
    _reports.clear()
    _reports[bpy.data.filepath] = tuple(line for line in said if line)


@contextmanager
def _heard() -> Iterator[list[Any]]:
    """Give a list that is empty until Blender has opened a file, and then has its scene.

    Blender would evaluate the scene that the window then shows: so that is an empty one for as
    long. Only objects in Edit Mode need their own scene, to stay in it.
    """
    loaded: list[Any] = []
    shown: list[Any] = []

    @bpy.app.handlers.persistent
    def hear(*_: Any) -> None:
        window: Window = bpy.context.window
        loaded.append(window.scene)
        if all(obj.mode == "OBJECT" for obj in bpy.data.objects):
            empty: Any = bpy.data.scenes.new("Reference Tracer")
            empty.view_layers[0].name = window.view_layer.name  # the window keeps the name
            window.scene = empty
            shown.append(empty)

    bpy.app.handlers.load_post.append(hear)
    try:
        yield loaded
    finally:
        bpy.app.handlers.load_post.remove(hear)
        for empty in shown:
            empty.user_remap(loaded[0])  # to set the window's scene would evaluate it
            bpy.data.batch_remove([empty])


def notes() -> tuple[str, ...]:
    """Return notes on how the open file was opened, a sentence each."""
    reported = _reports.get(bpy.data.filepath, ())
    said = [f"Blender opened the file with a report: {line}" for line in reported]
    if bpy.app.autoexec_fail:
        scripts = [f"'{text.name}'" for text in bpy.data.texts if text.use_module]
        said += [f"script {name} of the file is not run: scripts are off" for name in scripts]
    return tuple(said)
