"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window.

What a command needs is imported once it is asked for, and in functions: an import that is
interrupted leaves half a module.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from .. import __version__
from ..tracer import signals
from ..wording import capital
from . import running
from .commands import COMMANDS
from .parser import EXIT_CODES_HELP, Parser
from .watch import watched


def main(argv: Sequence[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code.

    Without `argv` it takes the process' own words, and its standard output for its lines alone.
    """
    if argv is None:
        running.keep_stdout()
        argv = sys.argv[1:]
    with watched():
        return running.run(lambda: _run(argv), "reftrace")


def _run(argv: Sequence[str]) -> int:
    """Parse the words, and run their command."""
    with signals.held():
        known = parser(argv)
    given = known.parse_args(argv)
    code: int = given.run(given)
    return code


def parser(argv: Sequence[str]) -> Parser:
    """Return the parser for these words, which knows the options of their command alone.

    The result of parsing has a function `run`, which takes that result.
    """
    out = Parser(
        "reftrace",
        epilog=EXIT_CODES_HELP,
        description=(
            "Trace a scene with the textbook's plane and triangle maths, and compare what Blender "
            "shows with it, pixel by pixel."
        ),
    )
    out.add_argument("--version", action="version", version=f"reftrace {__version__}")
    commands = out.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    asked = next((word for word in argv if not word.startswith("-")), None)
    for name, command in COMMANDS.items():
        text = command.help
        own = commands.add_parser(name, help=text, description=f"{capital(text)}.")
        if name == asked:
            _add_options(own, name)
    return out


def _add_options(own: Parser, name: str) -> None:
    """Add a command's options, and those that packages beside the add-on have for it."""
    from importlib.metadata import entry_points

    for found in entry_points(group="reference_tracer.commands"):
        if found.name == name:
            found.load().add(own)
            return
    module = COMMANDS[name].module
    if module is None:
        from ..scene import SceneError

        raise SceneError(
            f"the command {name} is not part of the add-on: pip install --editable . in a clone "
            "of the project installs it"
        )
    module().add(own)
    for found in entry_points(group="reference_tracer.options"):
        found.load()(own, name)


if __name__ == "__main__":
    sys.exit(main())
