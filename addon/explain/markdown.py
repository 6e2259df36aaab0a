"""A derivation as Markdown: wrong digits are bold."""

from __future__ import annotations

import re
from functools import singledispatch

from .blocks import Block, Heading, Numbers, Paragraph, Swatch, Table
from .derivation import Derivation
from .digits import Parts
from .document import blocks

# What would be markup where it stands; an index as in u_min and a "<" before a space would not.
_ESCAPED = re.compile(
    r"([\\`*\[\]|~]|<(?=[a-zA-Z/!?])|&(?=#?\w+;)|(?<![a-zA-Z\d])_|_(?![a-zA-Z\d]))"
)
_HEAD = "| | | float32 | off | float64 | off | exact |\n|---|---|---|--:|---|--:|---|"


def text(derivation: Derivation) -> str:
    """Return the Markdown text."""
    return "\n\n".join(_block(block) for block in blocks(derivation)) + "\n"


def escaped(plain: str) -> str:
    """Return text in which nothing is markup."""
    return _ESCAPED.sub(r"\\\1", " ".join(plain.split()))


@singledispatch
def _block(block: Block) -> str:
    raise TypeError(type(block).__name__)


@_block.register
def _(block: Heading) -> str:
    return f"{'#' * block.level} {escaped(block.text)}"


@_block.register
def _(block: Paragraph) -> str:
    plain = escaped(block.text)
    return {"answer": f"**{plain}**", "warning": f"⚠ **{plain}**", "note": f"*{plain}*"}.get(
        block.tone, plain
    )


@_block.register
def _(block: Table) -> str:
    rows = [block.head, ["---"] * len(block.head), *block.rows]
    return "\n".join(f"| {' | '.join(map(_cell, row))} |" for row in rows)


def _cell(plain: str) -> str:
    return plain if plain == "---" else escaped(plain)


@_block.register
def _(block: Numbers) -> str:
    lines = [_HEAD]
    for row in block.rows:
        cells = [str(row.formula or ""), row.label]
        for parts, off in row.floats:
            cells += [_marked(parts), off]
        lines.append(f"| {' | '.join([*cells, row.exact])} |")
    return "\n".join(lines)


def _marked(parts: Parts) -> str:
    wrong = f"**{parts.wrong}**" if parts.wrong else ""
    return f"{parts.right}{wrong}{parts.exponent}"


@_block.register
def _(block: Swatch) -> str:
    return escaped(block.text)
