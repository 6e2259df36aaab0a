"""What the commands of `reftrace` share."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

from ..arguments import DONE_HELP, EXIT_CODES_HELP, Parser, check_options
from ..images import MissingLibraryError

Commands = Any  # what argparse's add_subparsers returns, which has no public name


def command(
    commands: Commands,
    name: str,
    run: Callable[[argparse.Namespace], int],
    text: str,
    example: str,
    source: str | None = None,
    around: Callable[[argparse.Namespace], AbstractContextManager[Any]] = nullcontext,
) -> Parser:
    """Add a command, which checks its options first, and return its parser.

    `run` does the work, and returns the exit code; `around` gives what lasts as long as that does.
    The text and the example are for its help. `source` says what its SCENE may be; without it, the
    command takes none.
    """

    def checked(options: argparse.Namespace) -> int:
        check_options(options)
        with around(options):
            return run(options)

    codes = EXIT_CODES_HELP if name == "compare" else DONE_HELP
    parser = commands.add_parser(
        name,
        help=text,
        description=text[0].upper() + text[1:] + ".",
        epilog=f"example:\n  {example}\n\n{codes}",
    )
    parser.set_defaults(run=checked)
    if source:
        parser.add_argument("scene", type=Path, metavar="SCENE", help=source)
    return parser


def write_study(directory: str, write: Callable[[], None]) -> None:
    """Write a study; where pictures need a library that is not there, say so and do without."""
    try:
        write()
    except MissingLibraryError as error:
        print(f"reftrace: {error}", file=sys.stderr)
    print(f"written to {directory}")
