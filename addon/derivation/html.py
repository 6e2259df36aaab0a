"""Writes a derivation as HTML: a fragment for a page of the caller's, or a page by itself.

There is no script and no network in it; formulas are MathML. The fragment's classes begin with
`derivation-`; its colours are the page's CSS variables --ink, --paper, --muted and --accent; STYLE
goes into the page once.
"""

from __future__ import annotations

from html import escape
from pathlib import Path
from string import Template

from . import drawing
from .blocks import Block, Cell, Heading, Paragraph, Table
from .derivation import Derivation
from .digits import Parts
from .document import lecture
from .formulas import Formula
from .mathml import math

_NUMBER = '<td class="derivation-number">'
Part = tuple[Heading, list[Block]]  # a heading and what is below it

_HERE = Path(__file__).parent
STYLE, _PAGE_STYLE = (
    "\n" + (_HERE / name).read_text(encoding="utf-8") for name in ("fragment.css", "document.css")
)


def fragment(derivation: Derivation) -> str:
    """Return a <section> for a page that has STYLE in it."""
    first, *others = parts = _parts(lecture(derivation))
    drawn = drawing.figures(derivation)
    inner = "\n".join([_part(first), _contents(parts), drawn, *map(_part, others)])
    return f'<section class="derivation">\n{inner}\n</section>\n'


def page(derivation: Derivation) -> str:
    """Return a page by itself, readable in light and dark."""
    [(heading, _), *_] = _parts(lecture(derivation))
    template = Template((_HERE / "document.html").read_text(encoding="utf-8"))
    return template.substitute(
        title=escape(heading.text), style=_PAGE_STYLE + STYLE, body=fragment(derivation)
    )


def _parts(flat: list[Block]) -> list[Part]:
    parts: list[Part] = []
    for block in flat:
        if isinstance(block, Heading):
            parts.append((block, []))
        else:
            parts[-1][1].append(block)
    return parts


def _part(part: Part) -> str:
    """Return a part; below a candidate's name it can be folded."""
    heading, blocks = part
    head, below = _block(heading), list(map(_block, blocks))
    if heading.level == 3:
        opened = "" if heading.folded else " open"
        head = f"<details{opened}><summary>{head}</summary>"
        below.append("</details>")
    return "\n".join([head, *below])


def _contents(parts: list[Part]) -> str:
    """Return links to the parts, and to the one candidate that is not folded."""
    heads = [head for head, _ in parts if head.name and not head.folded]
    links = (f'<li><a href="#derivation-{h.name}">{escape(h.text)}</a></li>' for h in heads)
    return f'<nav class="derivation-contents" aria-label="Contents"><ol>{"".join(links)}</ol></nav>'


def _block(block: Block) -> str:
    match block:
        case Heading():
            name = f' id="derivation-{block.name}"' if block.name else ""
            return f"<h{block.level}{name}>{escape(block.text)}</h{block.level}>"
        case Paragraph():
            kind = f' class="derivation-{block.tone}"' if block.tone else ""
            color = f'<span class="derivation-swatch" style="background:{block.srgb}"></span>'
            return f"<p{kind}>{block.srgb and color}{escape(block.text)}</p>"
        case Table():
            head = "".join(f"<th>{escape(name)}</th>" for name in block.head)
            return (
                f'<div class="derivation-scroll"><table class="derivation-{block.kind}">'
                f"<thead><tr>{head}</tr></thead>\n<tbody>\n"
                + "\n".join(map(_row, block.rows))
                + "\n</tbody></table></div>"
            )
    raise TypeError(type(block).__name__)


def _row(row: tuple[Cell, ...]) -> str:
    first = ' class="derivation-first"' if isinstance(row[0], Formula) else ""
    cells = (f"{_NUMBER if isinstance(c, Parts) else '<td>'}{_cell(c)}</td>" for c in row[1:])
    return f"<tr{first}><th>{_cell(row[0])}</th>{''.join(cells)}</tr>"


def _cell(cell: Cell) -> str:
    match cell:
        case Formula():
            remark = f'<span class="derivation-remark">{escape(cell.remark)}</span>'
            return math(cell) + (cell.remark and remark)
        case Parts():
            return cell.with_wrong('<mark class="derivation-wrong">{}</mark>')
        case _:
            return escape(cell)
