"""Options that take several NAME=VALUE: each name is a row of a table, which the help shows."""

from __future__ import annotations

from argparse import (
    Action,
    ArgumentError,
    ArgumentParser,
    ArgumentTypeError,
    Namespace,
    _ActionsContainer,
)
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import Any

_WIDTH = 74  # of the help's lines


@dataclass(frozen=True)
class Setting:
    """A name that such an option knows."""

    name: str
    form: str  # of its value, in the help
    read: Callable[[str], object]  # a ValueError or an ArgumentTypeError says what is wrong
    help: str
    dest: str = ""  # where the value is kept; '' for the name itself, with _ for -
    alone: bool = False  # typed without its name

    @property
    def kept(self) -> str:
        """The name of the value among what was parsed."""
        return self.dest or self.name.replace("-", "_")

    def lines(self) -> list[str]:
        """Return its lines of the help."""
        typed = self.form if self.alone else f"{self.name}={self.form}"
        return wrap(
            f"{typed}: {self.help}",
            _WIDTH,
            subsequent_indent="    ",
            break_on_hyphens=False,
        )


class Named(Action):
    """Reads the words NAME=VALUE of an option; the last of several for a name counts."""

    rows: Sequence[Setting]

    @property
    def lines(self) -> list[str]:
        """The lines of the help that the names have."""
        return [line for row in self.rows for line in row.lines()]

    def __call__(
        self,
        parser: ArgumentParser,
        given: Namespace,
        words: Any,
        option: str | None = None,
    ) -> None:
        """Keep each value, and the words as they were typed."""
        for word in words:
            name, equals, text = word.partition("=")
            row = next((row for row in self.rows if row.name == name), None)
            if row is None or not equals:
                names = [row.name for row in self.rows if not row.alone]
                say = f"{option} takes NAME=VALUE, not '{word}'{nearest(name, names)}"
                say += f"; the names are {', '.join(names)}"
                raise ArgumentError(None, say if equals else f"{say} (files come before it)")
            try:
                value = row.read(text)
            except (ValueError, ArgumentTypeError) as error:
                raise ArgumentError(None, f"{option} {name}: {error}") from error
            setattr(given, row.kept, value)
            given.typed = {**given.typed, row.kept: f"{option} {name}"}
        setattr(given, self.dest, [*getattr(given, self.dest), *words])


def nearest(word: str, names: Iterable[str]) -> str:
    """Return which of some names a word may be a misspelling of, for a message; '' for none."""
    from difflib import get_close_matches

    return "".join(f"; {name} is the nearest" for name in get_close_matches(word, names, 1))


def add_named(
    group: _ActionsContainer,
    option: str,
    rows: Sequence[Setting],
    action: type[Named] = Named,
    metavar: str = "NAME=VALUE",
) -> None:
    """Add an option for the names of a table."""
    added = group.add_argument(option, nargs="+", action=action, default=[], metavar=metavar)
    assert isinstance(added, Named)
    added.rows = rows
    group.set_defaults(typed={}, **dict.fromkeys(row.kept for row in rows))


def one_of(*choices: str) -> Callable[[str], str]:
    """Return the function that reads one of some words."""

    def read(text: str) -> str:
        if text in choices:
            return text
        raise ArgumentTypeError(f"{text} is none of {', '.join(choices)}")

    return read
