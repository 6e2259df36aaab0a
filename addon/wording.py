"""Words that many messages share: a count with its noun, the add-on's name before a line."""

from __future__ import annotations


def count_of(number: int, one: str, several: str = "") -> str:
    """Return a count with its noun, and what else differs: 1 row, 2 rows; 1 edge is, 2 edges are.

    `several` is what stands behind all counts but 1: by default the same word with an s.
    """
    return f"{number:,} {one if number == 1 else several or f'{one}s'}"


def say(*lines: str, name: str = "Reference Tracer: ") -> None:
    """Print lines into Blender's console, each under the add-on's name."""
    for line in lines:
        print(f"{name}{line}")
