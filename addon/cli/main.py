"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window.

What a command needs is imported once it is asked for, and in functions: an import that is
interrupted leaves half a module.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from .. import __version__
from . import running
from .commands import FILES, HELP
from .parser import EXIT_CODES_HELP, Parser


def main(argv: Sequence[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    argv = sys.argv[1:] if argv is None else argv
    return running.run(lambda: _run(argv), "reftrace")


def _run(argv: Sequence[str]) -> int:
    with running.held():
        known = parser(argv)
    options = known.parse_args(argv)
    return options.run(options)


def parser(argv: Sequence[str]) -> Parser:
    """Return the parser of these words: of all commands it knows the options of theirs alone.

    What it parses has a `run`.
    """
    from importlib import import_module
    from importlib.metadata import entry_points

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
    installed = {found.name: found for found in entry_points(group="reference_tracer.commands")}
    for name, text in HELP.items():
        file = FILES.get(name)
        if not file and name not in installed:
            # Without a prefix of options, all that follows is positional, --help too.
            missing = commands.add_parser(
                name, help="(not installed here)", add_help=False, prefix_chars="\0"
            )
            missing.add_argument("rest", nargs="*")
            missing.set_defaults(run=_missing, name=name)
            continue
        own = commands.add_parser(name, help=text, description=f"{text[0].upper()}{text[1:]}.")
        if name == asked and file:
            getattr(import_module(f"{__package__}.commands.{file}"), f"add_{name}")(own)
            for found in entry_points(group="reference_tracer.options"):
                found.load()(own, name)
        elif name == asked:
            installed[name].load().add(own)
    return out


def _missing(options: object) -> int:
    """Say how to get a command."""
    from ..scene import SceneError

    raise SceneError(
        f"the command {options.name} is not part of the add-on: pip install --editable . in a "
        "clone of the project installs it"
    )


if __name__ == "__main__":
    sys.exit(main())
