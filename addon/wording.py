"""Prints lines, and has words that many messages share: a count with its noun."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TextIO

LONGEST = 2000  # letters of a line: a name in a file may have a million


def count_of(number: int, one: str, several: str = "") -> str:
    """Return a count with its noun, and what else differs: 1 row, 2 rows; 1 edge is, 2 edges are.

    `several` is what stands behind all counts but 1: by default the same word with an s.
    """
    return f"{number:,} {one if number == 1 else several or f'{one}s'}"


def listed(names: Sequence[str], most: int) -> str:
    """Return some names, and how many there are besides."""
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more} more" if more > 0 else "")


def capital(text: str) -> str:
    """Return a text with a capital as its first letter; the others stay."""
    return text[:1].upper() + text[1:]


def printable(text: str, but: str = "\n\t") -> str:
    """Return text that is safe to show: what steers a terminal, or is no letter, is spelt out."""
    return "".join(
        c if c.isprintable() or c in but else c.encode("unicode_escape").decode() for c in text
    )


def shown(line: str) -> str:
    """Return a line as it may be shown: in one line, spelt out, and cut in its middle."""
    if (beyond := len(line) - LONGEST) > 0:
        half = LONGEST // 2
        line = f"{line[:half]} ... ({beyond:,} letters left out) ... {line[-half:]}"
    return printable(line, but="")


def show(*lines: str, file: TextIO | None = None) -> None:
    """Print lines, by default to standard output: all that this program prints is printed here.

    Lines may hold what a file says: whatever it is, it neither steers the terminal nor begins
    another line. On a terminal, lines of standard error are written over the progress bar.
    """
    stream = file or sys.stdout
    over_bar = "\r\033[K" if stream is sys.stderr and stream.isatty() else ""
    for line in lines:
        print(f"{over_bar}{shown(line)}", file=stream, flush=bool(file))


def say(*lines: str) -> None:
    """Print lines into Blender's console, each under the add-on's name."""
    show(*(f"Reference Tracer: {line}" for line in lines))
