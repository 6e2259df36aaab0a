"""`blender FILE --command reference_tracer compare --out DIR`, for scripts and render farms."""

from __future__ import annotations

import sys
import traceback
from contextlib import suppress
from typing import Any

import bpy

from ..arguments import (
    EXIT_CODES,
    INPUT_ERROR,
    SIZES_DIFFER,
    Parser,
    add_judge,
    add_settings,
    settings_from,
)
from ..compare.comparison import EXIT_CODES as VERDICT_CODES
from ..compare.comparison import SizeError
from ..report import files
from ..scene import SceneError
from .compare import compare_to_folder

_handle: Any = None


def run(argv: list[str]) -> int:
    """Run the command; Blender exits with what this returns.

    An exception would make Blender exit with 1, which means warnings here.
    """
    parser = Parser("blender FILE --command reference_tracer", epilog=EXIT_CODES)
    commands = parser.add_subparsers(dest="command", required=True)
    compare = commands.add_parser(
        "compare",
        help="trace the open scene, compare it with Blender's picture, write files",
        epilog=EXIT_CODES,
    )
    compare.add_argument("--out", required=True, metavar="DIR", help="folder for what is found")
    add_settings(compare)
    add_judge(compare)
    try:
        options = parser.parse_args(argv)
    except SystemExit as stop:
        return int(stop.code or 0)
    if not bpy.data.filepath:
        return failed(
            SceneError("no file is open (is its name right?): name a .blend before --command"),
            options.out,
        )
    return compare_open_file(options)


def compare_open_file(options: Any, progress: Any = None) -> int:
    """Compare the scene of the open file as the options say, print what came of it.

    Returns
    -------
    int
        The exit code.
    """
    try:
        settings = settings_from(options, bpy.context.scene.reference_tracer.settings())
        comparison = compare_to_folder(
            bpy.context,
            options.out,
            progress,
            settings=settings,
            judge=options.judge.upper() if options.judge else None,
            as_is=options.as_is or None,
        )
    except Exception as error:
        return failed(error, options.out)
    print(*comparison.manifest.lines(), *comparison.lines(), f"written to {options.out}", sep="\n")
    return VERDICT_CODES[comparison.verdict]


def failed(error: Exception, directory: str) -> int:
    """Say what went wrong, in words and in the folder's JSON; returns the exit code."""
    if not isinstance(error, (SizeError, SceneError, OSError)):
        traceback.print_exception(error)
    print(f"reference_tracer: {error}", file=sys.stderr)
    with suppress(OSError):  # where it is the folder that cannot be written
        files.write_failure(bpy.path.abspath(directory), error)
    return SIZES_DIFFER if isinstance(error, SizeError) else INPUT_ERROR


def register() -> None:
    """Register the command."""
    global _handle
    _handle = bpy.utils.register_cli_command("reference_tracer", run)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.utils.unregister_cli_command(_handle)
