"""Writes a derivation as HTML: a fragment for a page of the caller's, or a page by itself.

There is no script and no network in it. The fragment's classes begin with `derivation-`; its
colours are the page's CSS variables --ink, --paper, --muted and --accent; STYLE goes into the page
once.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape
from pathlib import Path
from string import Template

from .blocks import Block, BlockRow, Heading, Numbers, Paragraph, Table
from .derivation import Derivation
from .document import lecture
from .formulas import VECTORS

Part = tuple[Heading, list[Block]]  # a heading and what is below it

_HERE = Path(__file__).parent
STYLE, _PAGE_STYLE = (
    "\n" + (_HERE / name).read_text(encoding="utf-8") for name in ("fragment.css", "document.css")
)


def fragment(derivation: Derivation) -> str:
    """Return a <section> for a page that has STYLE in it."""
    first, *others = parts = _parts(lecture(derivation))
    inner = "\n".join([_part(first), _contents(parts), *map(_part, others)])
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
            return _table(block.head, map(_cells, block.rows), "derivation-text")
        case Numbers():
            head = "", "", "float32", "off", "float64", "off", "exact"
            return _table(head, map(_number, block.rows), "derivation-numbers")
    raise TypeError(type(block).__name__)


def _cells(row: tuple[str, ...]) -> str:
    return f"<tr><th>{escape(row[0])}</th>{''.join(f'<td>{escape(c)}</td>' for c in row[1:])}</tr>"


def _table(head: tuple[str, ...], rows: Iterable[str], kind: str) -> str:
    names = "".join(f"<th>{escape(name)}</th>" for name in head)
    return (
        f'<div class="derivation-scroll"><table class="{kind}"><thead><tr>{names}</tr></thead>'
        "\n<tbody>\n" + "\n".join(rows) + "\n</tbody></table></div>"
    )


def _number(row: BlockRow) -> str:
    first, shown = "", ""
    if row.formula:
        first = ' class="derivation-first"'
        shown = formula(str(row.formula._replace(remark="")))
        if row.formula.remark:
            shown += f'<span class="derivation-remark">{escape(row.formula.remark)}</span>'
    marked = '<td class="derivation-number">{}</td><td class="derivation-off">{}</td>'
    wrong = '<mark class="derivation-wrong">{}</mark>'
    cells = "".join(marked.format(parts.with_wrong(wrong), off) for parts, off in row.floats)
    return (
        f"<tr{first}><th>{shown}</th><td>{formula(row.label)}</td>{cells}"
        f'<td class="derivation-number">{row.exact}</td></tr>'
    )


def formula(text: str) -> str:
    """Return a formula with its letters slanted, and those of vectors upright and bold."""
    return re.sub("[A-Za-z]+|[<>&]", _letter, text)


def _letter(found: re.Match[str]) -> str:
    if not found[0].isalpha():
        return escape(found[0])
    kind = ' class="derivation-vector"' if found[0] in VECTORS else ""
    return f"<var{kind}>{found[0]}</var>"
