"""All commands of `reftrace` in one parser."""

from __future__ import annotations

from importlib.metadata import entry_points

from .. import __version__
from ..arguments import EXIT_CODES_HELP, Parser
from ..scene import SceneError
from . import compare, files, studies
from .parts import Commands

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


def parser() -> Parser:
    """Return the parser of `reftrace`; what it parses has a `run`."""
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
    installed = {found.name: found for found in entry_points(group="reference_tracer.commands")}
    for name, add in COMMANDS.items():
        if add:
            add(commands)
        elif name in installed:
            installed[name].load().add(commands)
        else:
            _add_missing(commands, name)
    return out


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
