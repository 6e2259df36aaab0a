"""A formula in plain text -> MathML, which browsers set without a script or a network.

What it knows is what `formulas.py` writes: letters and words with indices (p₁, nₛ₁, u_min, x.y for
a component), ² and operators, and one fraction, "/" between spaces, at the top of a right side.
"""

from __future__ import annotations

import re
from html import escape

from .formulas import VECTORS, Formula

_TOKEN = re.compile(r"([A-Za-z]+)([ₛᵢ₁₂₃]+)?(?:_([a-z]+)|\.([xyz]))?|(½|\d+)|(²)|(‖)|(\S)")
_BARS = '<mo stretchy="false">‖</mo>'
_SIGNS = re.compile(r"\d|[a-z]+")
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
    parts = (inline(_bare(part.removeprefix("−"))) for part in (above, below))
    return f"{minus}<mfrac>{''.join(f'<mrow>{p}</mrow>' for p in parts)}</mfrac>"


def _bare(text: str) -> str:
    """Return text without the brackets around all of it, which a bar makes needless."""
    return text[1:-1] if text.startswith("(") and text.endswith(")") else text


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
    below = "".join(_index(sign) for index in indices if index for sign in _SIGNS.findall(index))
    return f"<msub>{letter}<mrow>{below}</mrow></msub>" if below else letter


def _index(sign: str) -> str:
    tag = "mn" if sign.isdigit() else "mi"
    return f"<{tag}>{sign}</{tag}>"


def _last_group(out: list[str]) -> str:
    """Take ‖…‖, or the last sign alone, off the end of what is there."""
    first = len(out) - 1
    if out[first] == _BARS:
        first = max(k for k in range(first) if out[k] == _BARS)
    group = "".join(out[first:])
    del out[first:]
    return f"<mrow>{group}</mrow>"
