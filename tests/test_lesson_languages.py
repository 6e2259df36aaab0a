"""The lessons in other languages have what the English ones have: questions, figures, links."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

import pytest
from documents.markers import commands, refreshed

LESSONS = Path(__file__).parent.parent / "docs" / "lessons"
EDITIONS = [path for path in sorted(LESSONS.glob("[a-z][a-z]")) if path.is_dir()]
PAGES = [page for folder in EDITIONS for page in sorted(folder.glob("*/*.md"))] + [
    page for folder in EDITIONS for page in sorted(folder.glob("*.md")) if page.stem != "README"
]
LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)[^)]*\)")
PARTS = {
    "headings": r"^#+ ",
    "slides": r"^---$",
    "questions": r"^\d+\. ",
    "rows": r"^\|",
    "figures": r"<!--[a-z][a-z0-9_]*-->.*?<!--/-->",
    "commands": r"^```console.*?^```$",
    "numbers": r"(?<![\w.])[\d]+(?:[.,]\d+)*",
    "code": r"`[^`\n]+`|^    [^\n]+$",
    "formulas": r"\$\$.+?\$\$|\$[^$\n]+\$",
    "keys": r"<kbd>.+?</kbd>",
}
# In a formula: these are translated.
WORDS = re.compile(r"\\text\{[^}]*\}| {3}[^\W\d]+ {3}")


def parts(text: str) -> dict[str, Counter]:
    """What a translation shares with its original, but for links."""
    text = WORDS.sub("", LINK.sub("]", text))
    return {name: Counter(re.findall(p, text, re.M | re.S)) for name, p in PARTS.items()}


def edition(page: Path) -> Path:
    return next(folder for folder in EDITIONS if page.is_relative_to(folder))


def original(page: Path) -> Path:
    return LESSONS / page.relative_to(edition(page))


def leads_to(page: Path) -> list[Path]:
    return [(page.parent / link).resolve() for link in LINK.findall(page.read_text("utf-8"))]


def by_language(path):
    return f"{edition(path).name}-{path.parent.name}-{path.stem}"


@pytest.mark.parametrize("page", PAGES, ids=by_language)
def test_a_translation_has_all_that_the_original_has(page):
    ours, theirs = (parts(path.read_text("utf-8")) for path in (page, original(page)))
    for name in PARTS:
        assert ours[name] == theirs[name], name


def test_make_docs_fills_in_what_it_does_in_the_original_and_leaves_the_language():
    page = LESSONS / "de" / "triangle.md"
    text, theirs = (path.read_text("utf-8") for path in (page, original(page)))
    output = {command.text: command.printed for command in commands(theirs)}
    figures = dict(re.findall(r"<!--(\w+)-->(.*?)<!--/-->", theirs, re.S))
    again = refreshed(text.replace(">40<", "><"), lambda command: output[command.text], figures)
    assert again == text


@pytest.mark.parametrize("page", PAGES, ids=by_language)
def test_its_links_lead_where_the_originals_do_and_to_translations_where_there_are(page):
    folder = edition(page)
    found = leads_to(page)
    as_english = [
        LESSONS / to.relative_to(folder) if to.is_relative_to(folder) else to for to in found
    ]
    assert Counter(as_english) == Counter(leads_to(original(page)))
    for to in found:
        if to.is_relative_to(LESSONS) and not to.is_relative_to(folder):
            assert not (folder / to.relative_to(LESSONS)).exists(), to


@pytest.mark.parametrize("folder", EDITIONS, ids=lambda folder: folder.name)
def test_its_index_names_all_that_is_translated_and_the_english_one_names_it(folder):
    assert {p for p in PAGES if edition(p) == folder} <= set(leads_to(folder / "README.md"))
    assert folder / "README.md" in leads_to(LESSONS / "README.md")
    for slides in (folder / "slides").glob("*.md"):
        assert f"\nlang: {folder.name}\n" in slides.read_text("utf-8")
