"""Writes a comparison as one HTML file that opens offline and says why each pixel differs.

`content.py` gathers what it shows, and `page.schema.json` says what that is.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from ...comparison.comparison import Comparison
from ...comparison.extras import Extras
from ..folders import replacing_file
from ..templates import html as html
from ..templates import json_text as json_text
from .content import content

NAME = "page.html"  # of the file that a comparison leaves


def write(
    path: str | Path,
    comparison: Comparison,
    extras: Extras | None = None,
    stored: Mapping[str, bytes] | None = None,
) -> None:
    """Write the page of a comparison, and of what else was found out.

    `stored` is as :func:`content.content` has it.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    text = html(content(comparison, extras, stored=stored))
    with replacing_file(Path(path)) as new:
        new.write_text(text, encoding="utf-8")
