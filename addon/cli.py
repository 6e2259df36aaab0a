"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window.

What a command needs is imported in functions: an import that is interrupted leaves half a module.
"""

from __future__ import annotations

import sys
from typing import Any

from . import running


def main(argv: list[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    return running.run(lambda: _run(argv), "reftrace")


def _run(argv: list[str] | None) -> int:
    with running.held():
        known = parser()
    options = known.parse_args(argv)
    return options.run(options)


def parser() -> Any:
    """Return the parser of all commands; what it parses has a `run`."""
    from importlib.metadata import entry_points

    from . import __version__
    from .arguments import EXIT_CODES_HELP, Parser
    from .commands import compare, files, studies

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
    # In the order of the help: what adds each. Those that are None are packages of their own.
    for name, add in {
        "compare": compare.add,
        "trace": files.add_trace,
        "explain": files.add_explain,
        "judge": None,
        "trade": studies.add_trade,
        "extremes": studies.add_extremes,
        "bench": None,
        "export": files.add_export,
    }.items():
        if not add and name in installed:
            add = installed[name].load().add
        if add:
            add(commands)
        else:
            _add_missing(commands, name)
    return out


def _add_missing(commands: Any, name: str) -> None:
    """Add a command that says how to get it."""

    def run(_: object) -> int:
        from .scene import SceneError

        raise SceneError(
            f"the command {name} is not part of the add-on: pip install --editable . in a clone of "
            "the project installs it"
        )

    # Without a prefix of options, all that follows is positional, --help too.
    own = commands.add_parser(name, help="(not installed here)", add_help=False, prefix_chars="\0")
    own.add_argument("rest", nargs="*")
    own.set_defaults(run=run)


if __name__ == "__main__":
    sys.exit(main())
