"""`blender FILE --command reference_tracer compare|explain|trade|extremes`, for scripts.

These are the commands of `reftrace`, for the file that is open.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy

_handle: Any = None


def run(argv: list[str]) -> int:
    """Run the command; Blender exits with what this returns.

    An exception would make Blender exit with 1, which means warnings here.
    """
    from ..cli import running

    try:
        return running.run(lambda: _run(argv), "reference_tracer")
    except SystemExit as stop:
        return int(stop.code or 0)


def _run(argv: list[str]) -> int:
    options = _parser().parse_args(argv)
    for name in ("out", "reproducer", "against"):
        if path := getattr(options, name, None):  # // is beside the file
            setattr(options, name, type(path)(bpy.path.abspath(str(path))))
    return options.run(options)


def _parser() -> Any:
    from ..cli.commands import HELP, compare, files, studies
    from ..cli.parser import EXIT_CODES_HELP, Parser

    parser = Parser("blender FILE --command reference_tracer", epilog=EXIT_CODES_HELP)
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    # A backup's name ends in .blend1; that no file is open is said once one is needed.
    file = Path(bpy.data.filepath or "none").with_suffix(".blend")
    adding = compare.add_compare, files.add_explain, studies.add_trade, studies.add_extremes
    for add in adding:
        name = add.__name__.removeprefix("add_")
        own = commands.add_parser(name, help=HELP[name])
        own.opened = file
        add(own)
    return parser


def register() -> None:
    """Register the command."""
    global _handle
    _handle = bpy.utils.register_cli_command("reference_tracer", run)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.utils.unregister_cli_command(_handle)
