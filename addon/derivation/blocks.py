"""The blocks of a lecture (headings, sentences, tables, numbers), and each of them in Markdown."""

from __future__ import annotations

import re
from typing import NamedTuple

from .derivation import Quantity
from .digits import Parts, exact_text, marked, off_text, ulps
from .formulas import Formula
from .textbook import FLOATS


class Heading(NamedTuple):
    """A title, of level 1 to 3.

    `name` is what a link can lead to; `folded`: what is below it may be read later.
    """

    level: int
    text: str
    name: str = ""
    folded: bool = False


class Paragraph(NamedTuple):
    """Sentences; `tone` is "", "answer" (the result), "note" or "warning".

    `srgb` is a colour to look at beside them, #rrggbb, if there is one.
    """

    text: str
    tone: str = ""
    srgb: str = ""


Cell = str | Formula | Parts


class Table(NamedTuple):
    """Rows of cells below a head; `kind` is "text" or "numbers"."""

    head: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    kind: str = "text"


Block = Heading | Paragraph | Table


def numbers(quantities: tuple[Quantity, ...]) -> Table:
    """Return a table of numbers in float32, float64 and exactly, a row for each component.

    The first of a vector's three has the vector's formula.
    """
    rows = []
    for q in quantities:
        label = q.formula.label
        for k, part in enumerate([label] if q.count == 1 else [f"{label}.{c}" for c in "xyz"]):
            exact = q.exact(k)
            cells: list[Cell] = ["" if k else q.formula, Formula(part)]
            for kind in FLOATS:
                value = q.values[kind][k]
                off = ulps(value, exact)
                cells += [marked(value, exact, off), off_text(off)]
            cells.append(Parts("undefined" if exact is None else exact_text(exact)))
            rows.append(tuple(cells))
    return Table(("", "", "float32", "off", "float64", "off", "exact"), tuple(rows), "numbers")


# What would be markup where it stands; an index as in u_min and a "<" before a space would not.
_ESCAPED = re.compile(
    r"([\\`*\[\]|~]|<(?=[a-zA-Z/!?])|&(?=#?\w+;)|(?<![a-zA-Z\d])_|_(?![a-zA-Z\d]))"
)
_TONES = {"answer": "**{}**", "warning": "⚠ **{}**", "note": "*{}*"}


def escaped(plain: str) -> str:
    """Return text in which nothing is markup."""
    return _ESCAPED.sub(r"\\\1", " ".join(plain.split()))


def markdown(block: Block) -> str:
    """Return a block as Markdown; wrong digits are bold."""
    match block:
        case Heading():
            return f"{'#' * block.level} {escaped(block.text)}"
        case Paragraph():
            return _TONES.get(block.tone, "{}").format(escaped(block.text))
        case Table():
            head, *rows = [
                f"| {' | '.join(map(_cell, row))} |" for row in (block.head, *block.rows)
            ]
            rule = " | ".join("--:" if name == "off" else "---" for name in block.head)
            return "\n".join([head, f"| {rule} |", *rows])


def _cell(cell: Cell) -> str:
    return cell.with_wrong("**{}**") if isinstance(cell, Parts) else escaped(str(cell))
