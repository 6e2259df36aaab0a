"""What the commands of `reftrace` share."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path

from ..arguments import check_options
from ..parser import DONE_HELP, Parser


def command(
    parser: Parser,
    run: Callable[[argparse.Namespace], int | None],
    example: str,
    source: str | None = None,
    codes: str = DONE_HELP,
) -> None:
    """Let a command's parser run it, which checks its options first.

    `run` does the work, and may return an exit code. The example and the codes are for its help.
    `source` says what its SCENE may be, where none is open; without it, the command takes none.
    The options' `place` gives, for as long as it is entered, the parameters that have the work done
    elsewhere: none, unless a package beside the add-on has set another one.
    """

    def checked(options: argparse.Namespace) -> int:
        check_options(options)
        return run(options) or 0

    parser.set_defaults(run=checked, place=lambda options: nullcontext({}))
    parser.epilog = codes if parser.opened else f"example:\n  {example}\n\n{codes}"
    if source and parser.opened:
        parser.set_defaults(scene=parser.opened, opened=True)
    elif source:
        parser.add_argument("scene", type=Path, metavar="SCENE", help=source)
