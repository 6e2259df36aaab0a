"""What the commands of `reftrace` share."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

from ..arguments import check_options
from ..images import MissingLibraryError
from ..parser import DONE_HELP, Parser


def command(
    parser: Parser,
    run: Callable[[argparse.Namespace], int],
    example: str,
    source: str | None = None,
    around: Callable[[argparse.Namespace], AbstractContextManager[Any]] = nullcontext,
    codes: str = DONE_HELP,
) -> None:
    """Let a command's parser run it, which checks its options first.

    `run` does the work, and returns the exit code; `around` gives what lasts as long as that does.
    The example and the exit codes are for its help. `source` says what its SCENE may be; without
    it, the command takes none.
    """

    def checked(options: argparse.Namespace) -> int:
        check_options(options)
        with around(options):
            return run(options)

    parser.epilog = f"example:\n  {example}\n\n{codes}"
    parser.set_defaults(run=checked)
    if source:
        parser.add_argument("scene", type=Path, metavar="SCENE", help=source)


def write_study(directory: str, write: Callable[[], None]) -> None:
    """Write a study; where pictures need a library that is not there, say so and do without."""
    try:
        write()
    except MissingLibraryError as error:
        print(f"reftrace: {error}", file=sys.stderr)
    print(f"written to {directory}")
