"""Fills in parts of a Markdown file, for `make docs`.

    ```console              a command, and what it prints; if the text has nothing of that, it is
    $ reftrace trace …      only run
    what it prints
    ```
    <!--not run: REASON-->  above a block that stays as it is
    <!--NAME-->123<!--/-->  a figure of `figures.py`; a part of `derivations.py`, of `records.py`

Seconds are left out, as they are other ones every time.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

_RUN = re.compile(r"^```console\n\$ (?P<command>[^\n]+)\n(?P<body>.*?)^```$", re.M | re.S)
_FIGURE = re.compile(r"<!--(?P<name>[a-z][a-z0-9_]*)-->(?P<body>.*?)<!--/-->", re.S)
_LEFT = re.compile(r"<!--not run: [^\n]+?-->\n(?P<in> *)```.*?^(?P=in)```$", re.M | re.S)
_SECONDS = re.compile(r"\b\d+\.\d+ s\b")
_BLENDERS_OWN = re.compile(r"^(\d\d:\d\d\.\d+ |Array iterator out of range).*\n", re.M)  # its log


@dataclass(frozen=True)
class Command:
    """A command of a text, and what the text has of its output."""

    text: str
    printed: str


def commands(text: str) -> list[Command]:
    """Return the commands of a text, in their order."""
    return [_command(m) for m in _RUN.finditer(text)]


def _command(m: re.Match) -> Command:
    return Command(m["command"], m["body"].strip("\n"))


def figures(text: str) -> list[str]:
    """Return the names of the figures that a text has."""
    return [m["name"] for m in _FIGURE.finditer(text)]


def unmarked(text: str) -> str:
    """Return a text without its commands and what is said not to be run."""
    return _LEFT.sub("", _RUN.sub("", text))


def settled(output: str) -> str:
    """Return what a command prints without what is another every time."""
    return _SECONDS.sub("… s", _BLENDERS_OWN.sub("", output)).strip("\n")


def refreshed(text: str, run: Callable[[Command], str], values: Mapping[str, str]) -> str:
    """Return a text with all its commands run, and its figures filled in.

    Parameters
    ----------
    text : str
    run : callable
        Runs a command; returns what it prints.
    values : mapping
        Figures by their names.

    Raises
    ------
    KeyError
        If there is no figure of a name.
    """

    def filled(m: re.Match) -> str:
        command = _command(m)
        output = settled(run(command))
        shown = [output] if command.printed else []
        return "\n".join(["```console", f"$ {command.text}", *shown, "```"])

    text = _RUN.sub(filled, text)
    return _FIGURE.sub(lambda m: f"<!--{m['name']}-->{values[m['name']]}<!--/-->", text)
