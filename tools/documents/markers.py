"""What `make docs` fills in: the parts of a Markdown file between markers.

    <!-- run: reftrace trace scene.blend --out out/a.png -->      a command, and what it prints
    <!-- run here: ... -->          the same, where what it prints depends on the machine
    <!-- run silently: ... -->      the command alone: what it prints is of no interest
    <!-- run folded: ... -->, <!-- run here folded: ... -->     and what it prints is folded away
    <!-- not run: REASON -->        a block that stays as it is, and why
    <!-- /run -->
    <!-- NAME -->123<!-- / --> a figure of `figures.py`; a part of `derivations.py`, of `records.py`

Seconds are left out, as they are other ones every time.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

MARKED = "<!-- "  # a file without this has no markers
_RUN = re.compile(
    r"<!-- run(?P<how>| here| silently| folded| here folded): (?P<command>[^\n]+?) -->\n"
    r"(?P<body>.*?)<!-- /run -->",
    re.S,
)
_FIGURE = re.compile(r"<!-- (?P<name>[a-z][a-z0-9_]*) -->(?P<body>.*?)<!-- / -->", re.S)
_LEFT = re.compile(r"<!-- not run: [^\n]+? -->\n.*?<!-- /run -->", re.S)
_UNFOLDED = ("", "</details>")
_SUMMARY = re.compile(r"<summary>(.+?)</summary>")
_SECONDS = re.compile(r"\b\d+\.\d+ s\b")
_BLENDERS_OWN = re.compile(r"^(\d\d:\d\d\.\d+ |Array iterator out of range).*\n", re.M)  # its log


@dataclass(frozen=True)
class Command:
    """A command that a text names: how it is run, and what the text has of it."""

    how: str
    text: str
    body: str


def commands(text: str) -> list[Command]:
    """Return the commands of a text, in their order."""
    return [
        Command(m["how"].strip(), m["command"], m["body"].strip("\n")) for m in _RUN.finditer(text)
    ]


def figures(text: str) -> list[str]:
    """Return the names of the figures that a text has."""
    return [m["name"] for m in _FIGURE.finditer(text)]


def unmarked(text: str) -> str:
    """Return a text without its commands and what is said not to be run."""
    return _LEFT.sub("", _RUN.sub("", text))


def settled(output: str) -> str:
    """Return what a command prints without what is another every time."""
    return _SECONDS.sub("… s", _BLENDERS_OWN.sub("", output)).strip("\n")


def block(command: Command, output: str) -> str:
    """Return a command as a block, with what it prints unless that is of no interest."""
    lines = ["```", f"$ {command.text}"]
    if command.how.endswith("folded"):
        own = _SUMMARY.search(command.body)  # in the document's language
        summary = own[1] if own else "What it prints"
        lines += ["```", "", f"<details><summary>{summary}</summary>", "", "```"]
    if command.how != "silently" and output:
        lines.append(output)
    return "\n".join([*lines, "```", *_UNFOLDED * command.how.endswith("folded")])


def printed(command: Command) -> str:
    """Return what a block has of a command's output."""
    blocks = re.findall(r"^```\n(.*?)\n```$", command.body, re.S | re.M)
    return "\n".join(blocks).partition("\n")[2]


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
        command = Command(m["how"].strip(), m["command"], m["body"])
        body = block(command, settled(run(command)))
        return f"<!-- run{m['how']}: {command.text} -->\n{body}\n<!-- /run -->"

    text = _RUN.sub(filled, text)
    return _FIGURE.sub(lambda m: f"<!-- {m['name']} -->{values[m['name']]}<!-- / -->", text)
