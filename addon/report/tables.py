"""Writes rows of cells as the lines of a text table, for a terminal or a file."""

from __future__ import annotations

from collections.abc import Collection, Sequence


def columns(rows: Sequence[Sequence[str] | str], left: Collection[int] = (0,)) -> list[str]:
    """Return rows of cells as lines, each column as wide as its widest cell.

    All rows have the same number of cells. A str is a line by itself, such as a title. The cells of
    the columns `left` are flush left, those of the others flush right.
    """
    cells = [row for row in rows if not isinstance(row, str)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]

    def line(row: Sequence[str]) -> str:
        padded = (
            cell.ljust(width) if k in left else cell.rjust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        return "  ".join(padded).rstrip()

    return [row if isinstance(row, str) else line(row) for row in rows]


def percent(share: float) -> str:
    """Return a share as a number of percent: only all is written as 100, and only none as 0."""
    if share in (0, 1):
        return f"{100 * share:.0f}"
    return f"{min(max(100 * share, 0.1), 99.9):.1f}"
