"""Parses a command that was given to Blender, for the scene that is open, and runs it.

It is imported once a command is run: registering the add-on takes no time for it.
"""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable
from pathlib import Path

import bpy

from ..cli.commands import COMMANDS
from ..cli.parser import DONE_HELP, EXIT_CODES_HELP, Parser


class _Parser(Parser):
    """A parser for the scene that is open, which knows Blender's paths."""

    def runs(self, run: Callable[[Namespace], int], example: str, codes: str = DONE_HELP) -> None:
        """Do without the example, which is reftrace's."""
        super().runs(run, example, codes)
        self.epilog = codes

    def add_scene(self, sources: str) -> None:
        """Take the file that is open; that none is open is said once one is needed."""
        # A backup's name ends in .blend1.
        file = Path(bpy.data.filepath or "none").with_suffix(".blend")
        self.set_defaults(scene=file, opened=True)

    def path(self, text: str) -> Path:
        """Return a path that was typed; // is the folder of the file."""
        return Path(bpy.path.abspath(text))


def parse_and_run(argv: list[str]) -> int:
    """Run the command that a line names; return its exit code."""
    parser = Parser("blender FILE --command reference_tracer", epilog=EXIT_CODES_HELP)
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)
    for name, command in COMMANDS.items():
        if command.module:
            command.module().add(commands.add_parser(name, help=command.help))
    given = parser.parse_args(argv)
    code: int = given.run(given)
    return code
