"""The command `reftrace`: the tracer, the comparison and the studies outside Blender's window.

What a command needs is imported once it is asked for, and in functions: an import that is
interrupted leaves half a module.
"""

from __future__ import annotations

import sys
from argparse import Namespace, _SubParsersAction
from collections.abc import Sequence
from typing import TYPE_CHECKING

from .. import __version__
from . import running
from .commands import HELP, IN_PACKAGES
from .parser import EXIT_CODES_HELP, Parser

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint


def main(argv: Sequence[str] | None = None) -> int:
    """Run `reftrace`; returns the exit code."""
    argv = sys.argv[1:] if argv is None else argv
    return running.run(lambda: _run(argv), "reftrace")


def _run(argv: Sequence[str]) -> int:
    with running.held():
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
    installed = _found("commands")
    for name, text in HELP.items():
        if name in IN_PACKAGES and name not in installed:
            _add_missing(commands, name)
            continue
        own = commands.add_parser(name, help=text, description=f"{text[0].upper()}{text[1:]}.")
        if name == asked:
            _add_options(own, name, installed)
    return out


def _found(group: str) -> dict[str, EntryPoint]:
    """Return what packages beside the add-on have for `reftrace`, by name."""
    from importlib.metadata import entry_points

    return {found.name: found for found in entry_points(group=f"reference_tracer.{group}")}


def _add_options(own: Parser, name: str, installed: dict[str, EntryPoint]) -> None:
    """Add a command's options, and those that packages beside the add-on have for it."""
    from importlib import import_module

    if name in installed:
        installed[name].load().add(own)
        return
    import_module(f"{__package__}.commands.{name}").add(own)
    for found in _found("options").values():
        found.load()(own, name)


def _add_missing(commands: _SubParsersAction[Parser], name: str) -> None:
    """Add a command of a package that is not installed: it only says how to get it."""
    # Without a prefix of options, all that follows is positional, --help too.
    missing = commands.add_parser(
        name, help="(not installed here)", add_help=False, prefix_chars="\0"
    )
    missing.add_argument("rest", nargs="*")
    missing.set_defaults(run=_missing, name=name)


def _missing(given: Namespace) -> int:
    """Say how to get a command."""
    from ..scene import SceneError

    raise SceneError(
        f"the command {given.name} is not part of the add-on: pip install --editable . in a "
        "clone of the project installs it"
    )


if __name__ == "__main__":
    sys.exit(main())
