"""Parses a command line, of `reftrace` or of `blender --command`, and names the exit codes.

This module imports little, so that `reftrace --help` takes no longer than Python itself.
"""

from __future__ import annotations

import math
import os
from argparse import (
    ONE_OR_MORE,
    Action,
    ArgumentParser,
    ArgumentTypeError,
    Namespace,
    RawDescriptionHelpFormatter,
)
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from ..wording import show
from .named import nearest

Number = TypeVar("Number", int, float)

AGREE, WARNINGS, DIFFERENCES, SIZES_DIFFER, INPUT_ERROR = range(5)
INTERRUPTED = 130  # by Ctrl-C, as in shells: see `tracer/signals.py`

_CODES = """
  4  the input is wrong or cannot be read, or standard output cannot be written (files stay)
  130  interrupted by Ctrl-C (129, 143: by SIGHUP, SIGTERM)"""
DONE_HELP = f"exit codes:\n  0  done{_CODES}"
EXIT_CODES_HELP = f"""exit codes:
  0  the pictures agree
  1  warnings: something is not modelled or not decidable, perhaps too much of it to compare
  2  differences that no cause explains
  3  the sizes of the pictures do not match{_CODES}"""


class _Help(RawDescriptionHelpFormatter):
    """Help with the required arguments alone in its first line; the options are listed below it."""

    def add_usage(self, usage: Any, actions: Any, groups: Any, prefix: Any = None) -> None:
        """Leave out what may be left out."""
        needed = [action for action in actions if action.required or not action.option_strings]
        super().add_usage(usage, needed, (), prefix)

    def _format_args(self, action: Action, default_metavar: str) -> str:
        """Say but once what may be given several times."""
        if action.nargs == ONE_OR_MORE:
            return f"{action.metavar} ..."
        return super()._format_args(action, default_metavar)

    def _format_action(self, action: Action) -> str:
        """Add the lines of an option that has a table of names."""
        lines = getattr(action, "lines", ())
        return super()._format_action(action) + "".join(f"    {line}\n" for line in lines)


class Parser(ArgumentParser):
    """An argument parser that ends with INPUT_ERROR, since 2 means differences here."""

    def __init__(self, prog: str | None = None, **options: Any) -> None:
        """Keep the lines of the exit codes below the help."""
        super().__init__(prog, formatter_class=_Help, **options)
        self.color = False  # newer Pythons steer the terminal

    def _print_message(self, message: str, file: Any = None) -> None:
        show(*message.removesuffix("\n").split("\n"), file=file)

    def error(self, message: str) -> NoReturn:
        """Print the message and how to go on, and exit."""
        self.exit(INPUT_ERROR, f"{self.prog}: {message}\n{self.prog} --help lists the options.\n")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> tuple[Any, list[str]]:
        """Parse, and refuse what is not known: `ArgumentParser` would leave it to `reftrace`."""
        given, unknown = super().parse_known_args(args, namespace)
        for word in sorted(unknown, key=lambda word: not word.startswith("-")):
            self.error(self._unknown(word.partition("=")[0]))
        return given, unknown

    def _unknown(self, word: str) -> str:
        if not word.startswith("-"):
            return f"'{word}' is one word too many: put a name that holds spaces in quotes"
        for action in self._actions:
            if any(row.name == word.lstrip("-") for row in getattr(action, "rows", ())):
                return f"there is no option {word}: {action.option_strings[0]} {word[2:]}=VALUE"
        return f"there is no option {word}{nearest(word, self._option_string_actions)}"

    def runs(self, run: Callable[[Namespace], int], example: str, codes: str = DONE_HELP) -> None:
        """Set what this parser's command does and returns, and the end of its help."""
        self.set_defaults(run=run)
        self.epilog = f"example:\n  {example}\n\n{codes}"

    def add_scene(self, sources: str) -> None:
        """Add the command's SCENE; `sources` says which files it may be."""
        self.add_argument("scene", type=Path, metavar="SCENE", help=sources)

    def path(self, text: str) -> Path:
        """Return a path that was typed: a shell's, where // at its begin is / (Blender has //)."""
        return Path(os.path.realpath(text) if text.startswith("//") else text)

    def path_ending(self, *endings: str) -> Callable[[str], Path]:
        """Return the function that reads the path of a file with one of these endings."""

        def read(text: str) -> Path:
            path = self.path(text)
            if path.suffix.lower() not in endings:
                raise ArgumentTypeError(f"'{text}' must end in {' or '.join(endings)}")
            return path

        return read


def number(
    kind: Callable[[str], Number], holds: Callable[[Number], bool], must: str
) -> Callable[[str], Number]:
    """Return the function that reads a number for which `holds` is true; `must` says so."""

    def read(text: str) -> Number:
        try:
            if holds(value := kind(text)):
                return value
        except ValueError:
            pass
        point = "; the decimal sign is a point" if "," in text else ""
        raise ArgumentTypeError(f"{text} is not {must}{point}")

    return read


INTEGER = number(int, lambda _: True, "an integer")
COUNT = number(int, lambda value: value >= 1, "an integer of at least 1")
FINITE = number(float, math.isfinite, "a finite number")
POSITIVE = number(float, lambda value: 0 < value < math.inf, "a finite number above 0")
AT_LEAST_0 = number(float, lambda value: 0 <= value < math.inf, "a finite number of at least 0")
