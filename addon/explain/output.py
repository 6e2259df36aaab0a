"""A derivation as a file, by its ending."""

from __future__ import annotations

from collections.abc import Callable

from . import as_json, html, markdown
from .derivation import Derivation

WRITERS: dict[str, Callable[[Derivation], str]] = {
    ".md": markdown.text,
    ".html": html.page,
    ".json": as_json.text_of,
}
