"""The documents as HTML pages that need no network, for the lesson pack."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from html import escape
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.anchors import anchors_plugin

PRINTED = "plans", "worksheets", "solutions"  # folders whose documents are PDFs, too
_FIGURE = re.compile(r"<!--(?:[a-z][a-z0-9_]*|/)-->")
_INDEX = re.compile(r"\b([a-z])_(s?[\dᵢ])\b")  # n_s1: set on paper as an index
_TITLE = re.compile(r"^# (.+)$", re.M)
_STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 52rem; margin: 2rem auto; padding: 0 1rem; }
img { max-width: 100%; }
table { border-collapse: collapse; display: block; overflow-x: auto; font-size: 14px; }
td, th { border: 1px solid #8886; padding: .25rem .6rem; text-align: left; }
pre { overflow-x: auto; padding: .7rem 1rem; background: #8882; font-size: 13px; }
li { margin: .35rem 0; }
summary { cursor: pointer; }
@media print {
  body { margin: 0; font-size: 12pt; }
  nav { display: none; }
  .worksheets > ol > li { break-inside: avoid; padding-bottom: 4.5cm; } /* for the answer */
}
"""


def unmarked(path: Path) -> str:
    """Return a document without its figures' marks: Marp takes comments for a speaker's notes."""
    return _FIGURE.sub("", path.read_text(encoding="utf-8"))


def title(text: str) -> str:
    """Return a document's title: its first heading."""
    return _TITLE.findall(text)[0]


def translations(lessons: Path) -> list[Path]:
    """Return the folders of the lessons in other languages: `de` and so on."""
    return [path for path in sorted(lessons.glob("[a-z][a-z]")) if path.is_dir()]


def anchor(heading: str) -> str:
    """Return a heading's name in links, as code forges make it."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def page(path: Path, docs: Path) -> str:
    """Return a document as a page; links that lead out of the documents are plain text there."""
    text = unmarked(path)
    markdown = MarkdownIt("commonmark", {"html": True}).enable("table")
    markdown.use(anchors_plugin, max_level=4, slug_func=anchor)
    tokens = markdown.parse(text)
    on_paper = path.parent.name == "worksheets"
    if on_paper:  # the formulas that it speaks of are its lesson's
        lesson = markdown.parse(unmarked(path.parents[1] / path.name))
        first = next(k for k, token in enumerate(tokens) if token.type == "ordered_list_open")
        tokens[first:first] = [token for token in lesson if token.type == "code_block"]
    for token in tokens:
        if token.children and on_paper:
            token.children = [t for t in token.children if not t.type.startswith("link_")]
        elif token.children:
            token.children = list(_linked(token.children, path.parent, docs))
    body = markdown.renderer.render(tokens, markdown.options, {})
    if on_paper:
        body = _INDEX.sub(r"\1<sub>\2</sub>", body)
    lessons = docs / "lessons"
    own = [folder for folder in translations(lessons) if path.is_relative_to(folder)]
    index = [lessons, *own][-1] / "README.md"
    to_index = os.path.relpath(index.with_suffix(".html"), path.parent)
    links = {title(index.read_text(encoding="utf-8")): to_index}
    if path.parent.name in PRINTED:
        links["PDF"] = f"{path.stem}.pdf"
    nav = " · ".join(f'<a href="{to}">{name}</a>' for name, to in links.items())
    language = own[0].name if own else "en"
    main = f'<main class="{path.parent.name}">\n{body}</main>\n'
    return as_page(title(text), f"<nav>{nav}</nav>\n{main}", language)


def as_page(title: str, body: str, language: str = "en") -> str:
    """Return a page around a body of HTML."""
    return (
        f'<!DOCTYPE html>\n<html lang="{language}"><head><meta charset="utf-8">'
        f"<title>{escape(title)}</title><style>{_STYLE}</style></head>\n<body>\n{body}</body></html>\n"
    )


def _linked(tokens: list[Token], folder: Path, docs: Path) -> Iterator[Token]:
    """Turn links to documents and notebooks into links to what the pack has of them."""
    dropped = False
    for token in tokens:
        if token.type == "link_open":
            name, mark, part = str(token.attrs["href"]).partition("#")
            if name and "://" not in name:
                dropped = not (folder / name).resolve().is_relative_to(docs)
                name = re.sub(r"notebooks/(\w+)\.py$", r"notebooks/\1.ipynb", name)
                token.attrs["href"] = re.sub(r"\.md$", ".html", name) + mark + part
        if not (dropped and token.type in ("link_open", "link_close")):
            yield token
        if token.type == "link_close":
            dropped = False
