"""Writes elements of SVG, for the badge.

No font is known here, so the widths of words are estimated.
"""

from __future__ import annotations

from functools import cache
from html import escape

from reference_tracer.report.junit import legal

_LETTER, _WIDE = 0.64, 1.0  # widths in sizes of the font, with room: of a letter; of an ideograph


def element(name: str, *inside: str, **attributes: str | float) -> str:
    """Return an element that holds others; `stroke_width` is its attribute stroke-width."""
    written = (
        f' {key.replace("_", "-")}="{v if isinstance(v, str) else f"{v:.7g}"}"'
        for key, v in attributes.items()
    )
    return f"<{name}{''.join(written)}>{''.join(inside)}</{name}>"


def said(name: str, words: str, **attributes: str | float) -> str:
    """Return an element that holds words, whatever they hold."""
    return element(name, escape(legal(words)), **attributes)


@cache
def width_of(words: str, size: float) -> float:
    """Return how wide the longest line of words is, at most."""
    wide = (sum(_WIDE if c > "\u2e80" else _LETTER for c in line) for line in words.split("\n"))
    return size * max(wide)
