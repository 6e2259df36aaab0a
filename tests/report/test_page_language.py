"""The page in another language: its own texts are translated, also those that come later."""

from __future__ import annotations

import ast
import json
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from reference_tracer import translations
from reference_tracer.causes.cause import AGREE, NOT_TRACED
from reference_tracer.causes.explain import CAUSES
from reference_tracer.certainty import Certainty
from reference_tracer.derivation import formulas
from reference_tracer.report import page
from reference_tracer.report.page.content import content
from reference_tracer.translations import tables

from .browser import settled
from .test_page_wrong import diagnosed

PAGE = Path(page.__file__).parent
TABLES = tables("page")
FIELD = re.compile(r"\{[^}]*\}")
WORD = re.compile(r"[^\W\d_]{2}")
TEXTS = """() => {
  const all = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const ours = (node) => !node.closest("script, style, noscript, svg, code, kbd, [translate=no]");
  const found = [];
  while (all.nextNode())
    if (ours(all.currentNode.parentElement)) found.push(all.currentNode.data);
  for (const e of document.querySelectorAll("[title], [aria-label]"))
    if (ours(e)) found.push(e.title, e.ariaLabel ?? "");
  return found.map((text) => text.replace(/\\s+/g, " ").replace(/^[ :–]+|[ :]+$/g, ""));
}"""


class Fixed(HTMLParser):
    """Collects the texts and labels of page.html."""

    def __init__(self):
        super().__init__()
        self.found, self.inside = set(), ""

    def handle_starttag(self, tag, attrs):
        self.inside = tag
        self.found |= {text for name, text in attrs if name in ("title", "aria-label")}

    def handle_data(self, data):
        if self.inside not in ("title", "p", "h1") or "hint" in data:
            self.found.add(" ".join(data.split()))


def parts(text):
    """Return a text's words between fields and punctuation."""
    return {part.strip() for part in re.split(r"\{[^}]*\}|[,:;()✓✗]", text)}


def computed():
    """Return the texts of records that the page shows."""
    found = {c.sentence for c in CAUSES} | {c.label.capitalize() for c in CAUSES}
    found |= {c.place or c.label for c in CAUSES if c not in (AGREE, NOT_TRACED)}
    found |= {c.sentence for c in Certainty} | {*formulas.ERRATA}
    found |= {name.replace("_", " ").capitalize() for name in Certainty.__members__}
    return found | {v[2] for f in (formulas.PLANE, formulas.TRIANGLE) for v in f.values()}


def strings(held):
    """Yield the keys and the texts of JSON."""
    if isinstance(held, dict):
        held = [*held, *held.values()]
    if isinstance(held, list):
        for value in held:
            yield from strings(value)
    elif isinstance(held, str):
        yield held


def mixed(tab):
    """Return which sentences of the whole add-on would be translated in part, and so be neither."""
    files = (file.read_text(encoding="utf-8") for file in PAGE.parents[1].rglob("*.py"))
    nodes = (node for text in files for node in ast.walk(ast.parse(text)))
    held = (n.value for n in nodes if isinstance(n, ast.Constant) and isinstance(n.value, str))
    own = {FIELD.sub("{}", key) for key in TABLES["de"]}
    texts = sorted(
        {t for t in held if len(t.split()) > 3 and "\n" not in t and FIELD.sub("{}", t) not in own}
    )
    assert len(texts) > 1000
    shown = tab.evaluate("texts => texts.map(translated)", texts)
    changed = {old.strip() for old, new in zip(texts, shown, strict=True) if old != new}
    return {text for text in changed if not text.startswith(("camera ", "scene "))}  # subtitles


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
def test_a_language_has_what_the_page_says_and_no_more(table):
    sources = " ".join(file.read_text(encoding="utf-8") for file in sorted(PAGE.glob("*.*")))
    sources = " ".join([sources, *computed()]).lower()
    unused = {key for key in table if any(part.lower() not in sources for part in parts(key))}
    assert unused == set()
    fixed = Fixed()
    fixed.feed((PAGE / "page.html").read_text(encoding="utf-8"))
    wanted = {FIELD.sub("{}", text) for text in fixed.found | computed() if WORD.search(text)}
    assert wanted - {"Reference Tracer"} - {FIELD.sub("{}", key) for key in table} == set()
    unlike = {k for k, v in table.items() if sorted(FIELD.findall(k)) != sorted(FIELD.findall(v))}
    assert unlike == set()


def test_another_language_is_a_file(monkeypatch, tmp_path, differing):
    french = {"blender": {"Save": "Enregistrer"}, "page": {"Left": "À gauche"}}
    (tmp_path / "fr.json").write_text(json.dumps(french), encoding="utf-8")
    monkeypatch.setattr(translations, "_FOLDER", tmp_path)
    assert tables("blender") == {"fr": french["blender"]}
    assert '{"fr":{"Left":"À gauche"}}' in page.html(content(differing))


@pytest.mark.browser
def test_in_german_nothing_of_the_pages_own_stays_english(show, differing):
    found, _ = diagnosed(differing, told=2)
    held = json.loads(page.json_text(content(found)))
    tab = show(found, held=held, locale="de-AT")
    names = "() => (NAMES.add('Depth'), [translated('Depth'), translated('Facing')])"
    assert tab.evaluate(names) == ["Depth", "Ausrichtung"]  # an object of that name
    assert mixed(tab) == set()
    tab.locator("#next").click()
    tab.evaluate("() => (NAMES.delete('Depth'), byId('help').showModal())")
    german = set(tab.evaluate(TEXTS))
    assert {"Warum Pixel abweichen", "Übereinstimmung", "Nächstes ›"} < german
    assert tab.evaluate("() => document.documentElement.lang") == "de"

    assert tab.locator("#language option").all_inner_texts() == ["English", "Deutsch"]
    tab.locator("#language").select_option("en")
    settled(tab)
    english = set(tab.evaluate(TEXTS))
    assert "Why pixels differ" in english
    same = {text for text, said in TABLES["de"].items() if text == said}
    left = {text for text in english & german - same if WORD.search(text)}
    assert left & TABLES["de"].keys() == set()
    data = " ".join("\n".join(strings(held)).lower().split())  # names, and what is told of them
    parts_left = {part for text in left for part in text.lower().strip("()").split(": ")}
    assert {p for p in parts_left if p not in data} <= {
        "reference tracer",
        "2 px",
        "6 px",
        "30.7 db",
    }
