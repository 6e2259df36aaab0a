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

from ...wording import show

_reports: dict[str, tuple[str, ...]] = {}  # by the file's path: of the one that was opened last


def open_file(path: Path) -> None:
    """Open a .blend, without its scripts and its windows.

    Raises
    ------
    RuntimeError
        If it cannot be opened, with Blender's reason. What was open before then still is.
    """
    said: list[str] = []
    with _heard() as loaded, _reports_shown():
        try:
            bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), load_ui=False, use_scripts=False)
        except RuntimeError as error:
            if not loaded:
                raise
            said = [line.removeprefix("Error: ").strip() for line in str(error).splitlines()]
    _reports.clear()
    _reports[bpy.data.filepath] = tuple(line for line in said if line)


@contextmanager
def _reports_shown() -> Iterator[None]:
    """Print on standard error what Blender reports by Python, once it has opened a file."""
    printed = StringIO()
    try:
        with redirect_stdout(printed):
            yield
    finally:
        show(*printed.getvalue().splitlines(), file=sys.stderr)


@contextmanager
def _heard() -> Iterator[list[Any]]:
    """Give a list that is empty until Blender has opened a file."""
    loaded: list[Any] = []

    @bpy.app.handlers.persistent
    def hear(*_: Any) -> None:
        loaded.append(True)

    bpy.app.handlers.load_post.append(hear)
    try:
        yield loaded
    finally:
        bpy.app.handlers.load_post.remove(hear)


def notes() -> tuple[str, ...]:
    """Return notes on how the open file was opened, a sentence each."""
    said = [f"Blender opened the file with a report: {line}" for line in _reported()]
    if bpy.app.autoexec_fail:
        scripts = [f"'{text.name}'" for text in bpy.data.texts if text.use_module]
        said += [f"script {name} of the file is not run: scripts are off" for name in scripts]
    return tuple(said)


def _reported() -> tuple[str, ...]:
    return _reports.get(bpy.data.filepath, ())
