"""Writes the derivation of a pixel to a file, or returns it to be printed: for `explain`."""

from __future__ import annotations

from pathlib import Path

from ..derivation import reproducer
from ..derivation.derivation import derive_pixel
from ..derivation.document import answer_sentence
from ..derivation.pixel import Pixel
from ..derivation.writers import WRITERS
from . import folders


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
