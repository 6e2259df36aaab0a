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


class Table(NamedTuple):
    """Rows of text below a head."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


class BlockRow(NamedTuple):
    """A number's label, and for each float its digits and its error in ulp.

    The first of a vector's three has the vector's formula.
    """

    label: str
    formula: Formula | None
    floats: tuple[tuple[Parts, str], ...]
    exact: str


class Numbers(NamedTuple):
    """Numbers below one another, in float32, float64 and exactly."""

    rows: tuple[BlockRow, ...]


Block = Heading | Paragraph | Table | Numbers


def numbers(quantities: tuple[Quantity, ...]) -> Numbers:
    """Return a table of numbers, a row for each component."""
    rows = []
    for q in quantities:
        label = q.formula.label
        for k, part in enumerate([label] if q.count == 1 else [f"{label}.{c}" for c in "xyz"]):
            exact = q.exact(k)
            values = [q.values[kind][k] for kind in FLOATS]
            floats = tuple((marked(v, exact), off_text(ulps(v, exact))) for v in values)
            truth = "undefined" if exact is None else exact_text(exact)
            rows.append(BlockRow(part, None if k else q.formula, floats, truth))
    return Numbers(tuple(rows))


# What would be markup where it stands; an index as in u_min and a "<" before a space would not.
_ESCAPED = re.compile(
    r"([\\`*\[\]|~]|<(?=[a-zA-Z/!?])|&(?=#?\w+;)|(?<![a-zA-Z\d])_|_(?![a-zA-Z\d]))"
)
_HEAD = "| | | float32 | off | float64 | off | exact |\n|---|---|---|--:|---|--:|---|"
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
            rows = [map(escaped, row) for row in (block.head, *block.rows)]
            lines = [f"| {' | '.join(row)} |" for row in rows]
            return "\n".join([lines[0], f"| {' | '.join(['---'] * len(block.head))} |", *lines[1:]])
        case Numbers():
            return "\n".join([_HEAD, *map(_row, block.rows)])
    raise TypeError(type(block).__name__)


def _row(row: BlockRow) -> str:
    cells = [str(row.formula or ""), row.label]
    for parts, off in row.floats:
        cells += [parts.with_wrong("**{}**"), off]
    return f"| {' | '.join([*cells, row.exact])} |"
