"""What a lecture is made of: headings, sentences, tables, numbers. Text, and no markup."""

from __future__ import annotations

from dataclasses import dataclass

from .arithmetic import FLOATS
from .derivation import Quantity
from .digits import Parts, exact_text, marked, off_text, ulps
from .formulas import Formula, component_labels


@dataclass(frozen=True)
class Heading:
    """A title, of level 1 to 3.

    `name` is what a link can lead to; `folded`: what is below it may be read later.
    """

    level: int
    text: str
    name: str = ""
    folded: bool = False


@dataclass(frozen=True)
class Paragraph:
    """Sentences; `tone` is "", "answer" (the result), "note" or "warning"."""

    text: str
    tone: str = ""


@dataclass(frozen=True)
class Table:
    """Rows of text below a head."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Row:
    """A number: what it is called, and for each float its digits and its error in ulp.

    The first of a vector's three says where the vector comes from.
    """

    label: str
    formula: Formula | None
    floats: tuple[tuple[Parts, str], ...]
    exact: str


@dataclass(frozen=True)
class Numbers:
    """Numbers below one another, in float32, float64 and exactly."""

    rows: tuple[Row, ...]


@dataclass(frozen=True)
class Swatch:
    """A colour to look at: sRGB as #rrggbb, and the text beside it."""

    srgb: str
    text: str


Block = Heading | Paragraph | Table | Numbers | Swatch


def numbers(quantities: tuple[Quantity, ...]) -> Numbers:
    """Return a table of numbers, a row for each component."""
    rows = []
    for q in quantities:
        labels = component_labels(q.formula, q.count)
        for k, label in enumerate(labels):
            exact = q.exact(k)
            values = [q.values[kind][k] for kind in FLOATS]
            floats = tuple((marked(v, exact), off_text(ulps(v, exact))) for v in values)
            truth = "undefined" if exact is None else exact_text(exact)
            rows.append(Row(label, None if k else q.formula, floats, truth))
    return Numbers(tuple(rows))
