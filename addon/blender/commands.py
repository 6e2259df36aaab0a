"""`blender FILE --command reference_tracer COMMAND`, for scripts.

These are the commands of `reftrace` that are part of the add-on, for the file that is open.
"""

from __future__ import annotations

from typing import Any

import bpy

_registered: list[Any] = []


def run(argv: list[str]) -> int:
    """Run the command; Blender exits with what this returns.

    An exception would make Blender exit with 1, which means warnings here.
    """
    from ..cli import running
    from .command_line import parse_and_run

    running.keep_stdout()
    try:
        return running.run(lambda: parse_and_run(argv), "reference_tracer")
    except SystemExit as stop:
        return int(stop.code or 0)


def register() -> None:
    """Register the command."""
    _registered.append(bpy.utils.register_cli_command("reference_tracer", run))


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.utils.unregister_cli_command(_registered.pop())
