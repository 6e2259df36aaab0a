"""`blender FILE --command reference_tracer COMMAND`, for scripts.

These are the commands of `reftrace` that are part of the add-on, for the file that is open. This is
imported once a command is run: registering the add-on takes no time for it.
"""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Sequence
from pathlib import Path

from . import running
from .commands import COMMANDS
from .parser import DONE_HELP, EXIT_CODES_HELP, Parser


class _Parser(Parser):
    """A parser for the scene that is open, which knows Blender's paths."""

    def runs(self, run: Callable[[Namespace], int], example: str, codes: str = DONE_HELP) -> None:
        """Leave out the example, which is of `reftrace`."""
        super().runs(run, example, codes)
        self.epilog = codes

    def add_scene(self, sources: str) -> None:
        """Take the open file; it is checked once the command needs it."""
        from ..blender.paths import open_path

        self.set_defaults(scene=open_path(), opened=True)

    def path(self, text: str) -> Path:
        """Return a path that was typed; // is the folder of the file."""
        from ..blender.paths import absolute

        return absolute(text)


def run(argv: Sequence[str]) -> int:
    """Run the command; Blender exits with what this returns.

    An exception would make Blender exit with 1, which means warnings here.
    """
    running.keep_stdout()
    try:
        return running.run(lambda: _run(argv), "reference_tracer")
    except SystemExit as stop:
        return int(stop.code or 0)


def _run(argv: Sequence[str]) -> int:
    parser = Parser("blender FILE --command reference_tracer", epilog=EXIT_CODES_HELP)
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)
    for name, command in COMMANDS.items():
        if command.module:
            command.module().add(commands.add_parser(name, help=command.help))
    given = parser.parse_args(argv)
    code: int = given.run(given)
    return code
