"""Sets a formula of `formulas.py` as MathML.

It knows what these formulas have: letters and words with indices (p₁, nₛ₁, u_min, x.y for a
component), ², operators, and one fraction: "/" between spaces, at the top of a right side.
"""

from __future__ import annotations

import re
from functools import cache
from html import escape

from .formulas import VECTORS, Formula

_TOKEN = re.compile(r"([A-Za-z]+)([ₛᵢ₁₂₃]+)?(?:_([a-z]+)|\.([xyz]))?|(½|\d+)|(²)|(‖)|(\S)")
_BARS = '<mo stretchy="false">‖</mo>'
_SIGNS = re.compile(r"\d|[a-z]+")
_AROUND = re.compile(r"^\((.*)\)$")
_INDEX = str.maketrans("ₛᵢ₁₂₃", "si123")


@cache  # a page has each of them in every surface's table
def math(formula: Formula) -> str:
    """Return `label = right side`, or the label alone where a number is given."""
    inner = _inline(formula.label)
    if formula.right:
        inner += f"<mo>=</mo>{_right(formula.right)}"
    return f'<math displaystyle="true">{inner}</math>'


def _right(text: str) -> str:
    """Return a right side; what is to the left of its slash goes above a bar."""
    above, slash, below = text.partition(" / ")
    if not slash:
        return _inline(text)
    minus = "<mo>−</mo>" if above.startswith("−") else ""
    # Without the brackets around all of it, which a bar makes needless.
    parts = (_inline(_AROUND.sub(r"\1", part.removeprefix("−"))) for part in (above, below))
    return f"{minus}<mfrac>{''.join(f'<mrow>{p}</mrow>' for p in parts)}</mfrac>"


def _inline(text: str) -> str:
    """Return the MathML of text without fractions."""
    out: list[str] = []
    for token in _TOKEN.finditer(text):
        word, small, index, component, number, square, bars, operator = token.groups(default="")
        if word:
            out.append(_word(word, small.translate(_INDEX) + " " + (index or component)))
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


def _word(word: str, indices: str) -> str:
    kind = ' class="derivation-vector"' if word in VECTORS else ""
    letter = f"<mi{kind}>{word}</mi>"
    signs = _SIGNS.findall(indices)
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
