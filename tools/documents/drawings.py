"""The lessons' drawings: what `reftrace explain` draws of some pixels, each a file of its own."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from reference_tracer.derivation import drawing, html
from reference_tracer.derivation.derivation import derive

from .figures import scene

# By the scene: which pixel, and which of its drawings.
DRAWN = {
    "orthographic": (200, 240, "side"),
    "perspective": (200, 240, "film"),
    "plane": (320, 60, "side"),
    "triangle": (154, 167, "plane"),
}
# Of the page's light version, on paper of their own: a file cannot follow a page's colours.
_COLORS = (
    "--ink: #1d1d1f; --paper: #ffffff; --muted: #77777d; --accent: #b4501e; "
    "--s1: #c23030; --s2: #1d8a3a; --s3: #2b5fd0"
)
_RULES = re.compile(r"^\.derivation-drawings (?!\{|figure|figcaption|svg)(.+?\})$", re.M | re.S)


def drawings() -> Iterator[tuple[str, str]]:
    """Each drawing's name and its SVG."""
    rules = "\n".join(_RULES.findall(html.STYLE))
    style = f"<style>svg {{ {_COLORS}; font: 13px sans-serif; background: #fff }}\n{rules}</style>"
    for name, (x, y, which) in DRAWN.items():
        drawn = drawing.figures(derive(scene(name), x, y))
        found = rf'<svg ([^>]*data-name="{which}"[^>]*>)(.*?</svg>)'
        [(head, rest)] = re.findall(found, drawn, re.S)
        yield f"drawn_{name}", f'<svg xmlns="http://www.w3.org/2000/svg" {head}{style}{rest}\n'


def write(folder: Path) -> None:
    """Write them all: docs/images/lessons."""
    for name, drawn in drawings():
        (folder / f"{name}.svg").write_text(drawn, encoding="utf-8")
