"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window."""

from __future__ import annotations

import sys
from importlib.metadata import entry_points

from . import __version__, interrupts
from .arguments import EXIT_CODES_HELP, INTERRUPTED, Parser, failed
from .commands import compare, files, studies
from .commands.parts import Commands
from .scene import SceneError

# In the order of the help: what adds each. Those that are None are packages of their own.
COMMANDS = {
    "compare": compare.add,
    "trace": files.add_trace,
    "explain": files.add_explain,
    "judge": None,
    "trade": studies.add_trade,
    "extremes": studies.add_extremes,
    "bench": None,
    "export": files.add_export,
}


def main(argv: list[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    for stream in filter(None, (sys.stdout, sys.stderr)):  # which may not have each letter
        stream.reconfigure(errors="backslashreplace")
    options = _parser().parse_args(argv)
    try:
        with interrupts.heard():
            return options.run(options)
    except KeyboardInterrupt:
        print("reftrace: interrupted", file=sys.stderr)
        return INTERRUPTED
    except Exception as error:  # Python's own exit code for it, 1, means warnings here
        return failed(error, "reftrace")


def _parser() -> Parser:
    parser = Parser(
        "reftrace",
        epilog=EXIT_CODES_HELP,
        description=(
            "Trace a scene with the textbook's plane and triangle maths, and compare what Blender "
            "shows with it, pixel by pixel."
        ),
    )
    parser.add_argument("--version", action="version", version=f"reftrace {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    installed = {found.name: found for found in entry_points(group="reference_tracer.commands")}
    for name, add in COMMANDS.items():
        if add:
            add(commands)
        elif name in installed:
            installed[name].load().add(commands)
        else:
            _add_missing(commands, name)
    return parser


def _add_missing(commands: Commands, name: str) -> None:
    """Add a command that says how to get it."""

    def run(_: object) -> int:
        raise SceneError(
            f"the command {name} is not part of the add-on: pip install --editable . in a clone of "
            "the project installs it"
        )

    # Without a prefix of options, all that follows is positional, --help too.
    parser = commands.add_parser(
        name, help="(not installed here)", add_help=False, prefix_chars="\0"
    )
    parser.add_argument("rest", nargs="*")
    parser.set_defaults(run=run)


if __name__ == "__main__":
    sys.exit(main())
