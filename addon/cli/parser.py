"""What parses a command line, `reftrace`'s or `blender --command`'s, and its exit codes.

Its options are listed in `options.toml`. Little is imported here: `reftrace --help` takes no longer
than Python itself.
"""

from __future__ import annotations

import argparse
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import NoReturn

AGREE, WARNINGS, DIFFERENCES, SIZES_DIFFER, INPUT_ERROR = range(5)
INTERRUPTED = 130  # by Ctrl-C, as shells have it: see `cli/running.py`

_CODES = """
  4  the input is wrong, or cannot be read; or standard output cannot be written: files stay
  130  interrupted by Ctrl-C (129, 143: by SIGHUP, SIGTERM)"""
DONE_HELP = f"exit codes:\n  0  done{_CODES}"
EXIT_CODES_HELP = f"""exit codes:
  0  the pictures agree
  1  warnings: something is not modelled, or not decidable; or so much that it is not comparable
  2  differences that no cause explains
  3  the sizes of the pictures do not match{_CODES}"""

_NAMED = {"int": int, "float": float, "path": Path, "boolean": argparse.BooleanOptionalAction}
# What the words of `options.toml` mean to argparse.
_MEANT = {
    "type": _NAMED.get,
    "action": lambda word: _NAMED.get(word, word),
    "metavar": lambda word: word if isinstance(word, str) else tuple(word),
}


class Parser(argparse.ArgumentParser):
    """An argument parser that ends with INPUT_ERROR, as 2 means differences here."""

    opened: Path | None = None  # the scene of the command, where it is open in Blender

    def __init__(self, *args: object, **options: object) -> None:
        """Name the exit codes below the help, and keep their lines."""
        super().__init__(*args, formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message: str) -> NoReturn:
        """Print the message and how to go on, and exit."""
        self.exit(INPUT_ERROR, f"{self.prog}: {message}\n{self.prog} --help lists the options.\n")


def add_options(
    parser: argparse.ArgumentParser,
    *names: str,
    words: Mapping[str, object] | None = None,
    **own: Mapping[str, object],
) -> None:
    """Add the options that `options.toml` lists by these names, below their title if one has one.

    `words` fill the braces in their help; `own` has what only the code knows of an option.
    """
    listed = tomllib.loads(Path(__file__).with_name("options.toml").read_text(encoding="utf-8"))
    found = {option: held for name in names for option, held in listed[name].items()}
    title = found.pop("title", None)
    group = parser.add_argument_group(title) if title else parser
    for option, held in found.items():
        held |= own.get(option.removeprefix("--").replace("-", "_"), {})
        for key in held.keys() & _MEANT:
            held[key] = _MEANT[key](held[key])
        if words:
            held["help"] = held["help"].format(**words)
        group.add_argument(option, **held)
