"""A derivation as HTML: a fragment for a page of the caller's, or a page by itself.

No script and no network: formulas are MathML, of what `formulas.py` writes: letters and words with
indices (p₁, nₛ₁, u_min, x.y for a component), ² and operators, and one fraction, "/" between
spaces, at the top of a right side. The fragment's classes begin with `derivation-`; its colours are
the page's CSS variables --ink, --paper, --muted and --accent; STYLE goes into the page once.
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
from .formulas import VECTORS, Formula

_HERE = Path(__file__).parent
STYLE, _PAGE_STYLE = (
    "\n" + (_HERE / name).read_text(encoding="utf-8") for name in ("fragment.css", "document.css")
)


def fragment(derivation: Derivation) -> str:
    """Return a <section> for a page that has STYLE in it."""
    parts = _parts(lecture(derivation))
    inner = "\n".join([_part(parts[0]), _contents(parts), *map(_part, parts[1:])])
    return f'<section class="derivation">\n{inner}\n</section>\n'


def page(derivation: Derivation) -> str:
    """Return a page by itself, readable in light and dark."""
    title, style = escape(lecture(derivation)[0].text), _PAGE_STYLE + STYLE
    page = Template((_HERE / "document.html").read_text(encoding="utf-8"))
    return page.substitute(title=title, style=style, body=fragment(derivation))


def _parts(flat: list[Block]) -> list[list[Block]]:
    """Return a heading and what is below it, each."""
    parts: list[list[Block]] = []
    for block in flat:
        if isinstance(block, Heading):
            parts.append([])
        parts[-1].append(block)
    return parts


def _part(part: list[Block]) -> str:
    """Return a part; of a candidate's what is below its name can be folded."""
    head, *below = map(_block, part)
    if part[0].level == 3:
        opened = "" if part[0].folded else " open"
        head = f"<details{opened}><summary>{head}</summary>"
        below.append("</details>")
    return "\n".join([head, *below])


def _contents(parts: list[list[Block]]) -> str:
    """Return links to the parts, and to the one candidate that is not folded."""
    heads = [head for head, *_ in parts if head.name and not head.folded]
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
        shown = math(row.formula)
        if row.formula.remark:
            shown += f'<span class="derivation-remark">{escape(row.formula.remark)}</span>'
    marked = '<td class="derivation-number">{}</td><td class="derivation-off">{}</td>'
    wrong = '<mark class="derivation-wrong">{}</mark>'
    cells = "".join(marked.format(parts.with_wrong(wrong), off) for parts, off in row.floats)
    return (
        f"<tr{first}><th>{shown}</th><td>{math(Formula(row.label))}</td>{cells}"
        f'<td class="derivation-number">{row.exact}</td></tr>'
    )


_TOKEN = re.compile(r"([A-Za-z]+)([ₛᵢ₁₂₃]+)?(?:_([a-z]+)|\.([xyz]))?|(½|\d+)|(²)|(‖)|(\S)")
_BARS = '<mo stretchy="false">‖</mo>'
_SIGNS = re.compile(r"\d|[a-z]+")
_AROUND = re.compile(r"^\((.*)\)$")
_INDEX = str.maketrans("ₛᵢ₁₂₃", "si123")


def math(formula: Formula) -> str:
    """Return `label = right side`, or the label alone where a number is given."""
    inner = inline(formula.label)
    if formula.right:
        inner += f"<mo>=</mo>{_right(formula.right)}"
    return f'<math displaystyle="true">{inner}</math>'


def _right(text: str) -> str:
    """Return a right side; what is to the left of its slash goes above a bar."""
    above, slash, below = text.partition(" / ")
    if not slash:
        return inline(text)
    minus = "<mo>−</mo>" if above.startswith("−") else ""
    # Without the brackets around all of it, which a bar makes needless.
    parts = (inline(_AROUND.sub(r"\1", part.removeprefix("−"))) for part in (above, below))
    return f"{minus}<mfrac>{''.join(f'<mrow>{p}</mrow>' for p in parts)}</mfrac>"


def inline(text: str) -> str:
    """Return the MathML of text without fractions."""
    out: list[str] = []
    for token in _TOKEN.finditer(text):
        word, small, index, component, number, square, bars, operator = token.groups()
        if word:
            out.append(_word(word, [(small or "").translate(_INDEX), index or component]))
        elif number:
            out.append(f"<mn>{number}</mn>")
        elif square:
            out.append(f"<msup>{_last_group(out)}<mn>2</mn></msup>")
        elif bars:
            out.append(_BARS)
        else:
            still = ' stretchy="false"' if operator in "()" else ""
            out.append(f"<mo{still}>{escape(operator)}</mo>")
    return "".join(out)


def _word(word: str, indices: list[str | None]) -> str:
    kind = ' class="derivation-vector"' if word in VECTORS else ""
    letter = f"<mi{kind}>{word}</mi>"
    signs = _SIGNS.findall(" ".join(index for index in indices if index))
    below = "".join(f"<mn>{s}</mn>" if s.isdigit() else f"<mi>{s}</mi>" for s in signs)
    return f"<msub>{letter}<mrow>{below}</mrow></msub>" if below else letter


def _last_group(out: list[str]) -> str:
    """Take ‖…‖, or the last sign alone, off the end of what is there."""
    first = len(out) - 1
    if out[first] == _BARS:
        first = max(k for k in range(first) if out[k] == _BARS)
    group = "".join(out[first:])
    del out[first:]
    return f"<mrow>{group}</mrow>"
