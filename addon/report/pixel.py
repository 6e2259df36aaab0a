"""Writes the derivation of a pixel as Markdown, HTML or JSON, or returns it to be printed."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ..derivation import reproducer
from ..derivation.derivation import Derivation, derive_pixel
from ..derivation.document import answer_sentence, document_markdown
from ..derivation.pixel import Pixel
from ..derivation.writers import json_text
from . import folders
from .templates import alone


def html(derivation: Derivation) -> str:
    """Return a page by itself, which opens offline, in light and dark."""
    pixel = derivation.pixel
    return alone(f"The ray through pixel ({pixel.x}, {pixel.y})", [derivation])


# By a file's ending.
WRITERS: dict[str, Callable[[Derivation], str]] = {
    ".md": document_markdown,
    ".html": html,
    ".json": json_text,
}


def write(pixel: Pixel, out: Path | None = None, again: Path | None = None) -> str:
    """Derive a pixel, and write it to `out` by that file's ending; return the text to print.

    Without `out` that text is the derivation as Markdown. `again` is where the pixel's own JSON
    goes, from which it can be derived without the scene.
    """
    derivation = derive_pixel(pixel)
    if again:
        folders.write_text(again, reproducer.text(pixel))
    if not out:
        return WRITERS[".md"](derivation)
    folders.write_text(out, WRITERS[out.suffix.lower()](derivation))
    return f"{answer_sentence(derivation)} {out}\n"
