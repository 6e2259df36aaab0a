"""The page: well-formed, the same numbers as the Markdown, no script, no network."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest
from reference_tracer.derivation import blocks, document, formulas, html
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.formulas import Formula
from reference_tracer.derivation.mathml import math
from reference_tracer.derivation.textbook import Arithmetic

from .printed import tables

MATH = formulas.CAMERA | formulas.PLANE | formulas.TRIANGLE | formulas.COLOR
VOID = {"meta"}


class Reader(HTMLParser):
    """Checks that elements are closed in order; keeps the cells of the tables of numbers."""

    def __init__(self):
        super().__init__()
        self.open, self.tags, self.classes, self.cells, self.text = [], set(), set(), [], []
        self.ids, self.links, self.folds = [], [], []

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        attributes = dict(attributes)
        self.classes |= set((attributes.get("class") or "").split())
        assert not {"src", "onclick"} & set(attributes)
        assert attributes.get("href", "#").startswith("#")  # within the page
        self.ids.append(attributes.get("id"))
        self.links.append(attributes.get("href", "")[1:])
        self.folds += [attributes] * (tag == "details")
        if tag not in VOID:
            self.open.append((tag, attributes.get("class")))
        if (tag, attributes.get("class")) == ("td", "derivation-number"):
            self.cells.append("")

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag

    def handle_data(self, data):
        self.text.append(data)
        if ("td", "derivation-number") in self.open:
            self.cells[-1] += data


def read(text):
    reader = Reader()
    reader.feed(text)
    assert not reader.open
    return reader


@pytest.fixture
def derivation(ball_scene):
    return derive(ball_scene, 12, 9)


def test_page(derivation):
    text = html.page(derivation)
    reader = read(text)
    assert text.startswith("<!DOCTYPE html>")
    assert {"math", "mfrac", "table", "mark", "h1"} <= reader.tags
    assert not {"script", "link", "img", "iframe"} & reader.tags
    assert "http" not in text and "url(" not in text and "@import" not in text
    assert all(name.startswith("derivation") for name in reader.classes)


def test_fragment_leaves_colours_to_its_page(derivation):
    text = html.fragment(derivation)
    assert text.startswith("<section") and "<style" not in text
    assert html.page(derivation).count(text) == 1
    for name in ("--ink", "--muted", "--accent", "--paper"):
        assert f"var({name})" in html.STYLE and f"{name}:" not in html.STYLE


def test_only_the_seen_candidate_is_unfolded(derivation):
    reader = read(html.page(derivation))
    names = [test.candidate.name for test in derivation.tests]
    unfolded = [name == derivation.certified.seen for name in names]
    assert sum(unfolded) == 1 < len(names)
    assert ["open" in attributes for attributes in reader.folds] == unfolded
    assert "::details-content" in html.STYLE  # opened on paper


def test_contents_lead_to_headings(derivation):
    reader = read(html.page(derivation))
    links = [name for name in reader.links if name]
    assert len(links) == 6 and set(links) <= set(reader.ids)  # five parts and what is seen
    seen = [t.candidate.name for t in derivation.tests].index(derivation.certified.seen) + 1
    assert f"derivation-2-{seen}" in links


def test_each_t_says_what_it_is(derivation):
    text = html.page(derivation)
    assert "(proven: the exact value, rounded once)" in text
    seen = next(t for t in derivation.tests if t.candidate is derivation.seen)
    t = next(q for q in seen.quantities if q.key == "t").values[Arithmetic.FLOAT64][0]
    assert f"By the textbook’s formula in float64, t = {float(t)!r} m." in text


@pytest.mark.browser
@pytest.mark.parametrize("width", [500, 1200])
def test_no_table_is_cut_off(derivation, chromium, width):
    tab = chromium.new_page(viewport={"width": width, "height": 800})
    tab.set_content(html.page(derivation))
    boxes = "all => all.map(e => [e.scrollWidth, e.clientWidth])"
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= width
    if width == 1200:  # on a small one they scroll
        for inner, outer in tab.locator(".derivation-scroll").evaluate_all(boxes):
            assert inner <= outer
    tab.emulate_media(media="print")
    hidden = tab.locator("details:not([open]) table").first
    assert hidden.evaluate("e => e.checkVisibility({ contentVisibilityAuto: true })")
    assert hidden.bounding_box()["height"] > 100
    tab.close()


def test_the_numbers_are_those_of_the_markdown(derivation):
    expected = []
    for _, columns, _ in tables(document.document_markdown(derivation)):
        for label in columns["float32"]:
            row = (
                columns[kind].get(label, "undefined") for kind in ("float32", "float64", "exact")
            )
            expected += row
    cells = read(html.page(derivation)).cells
    assert len(cells) == len(expected) > 200
    for cell, value in zip(cells, expected, strict=True):
        assert cell == value if isinstance(value, str) else type(value)(float(cell)) == value


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["<script>alert(1)</script>", "a|b*c_d`e", "&amp;", 'x" onclick="y']
)
def test_names_are_text(ball_scene, name):
    names = [name] * len(ball_scene.objects)
    found = derive(replace(ball_scene, objects=names), 12, 9, source=name)
    reader = read(html.page(found))
    assert "script" not in reader.tags
    assert any(name in piece for piece in reader.text)
    rows = [
        line for line in document.document_markdown(found).splitlines() if line.startswith("| 2.")
    ]
    assert len(rows) == len(found.tests)
    assert {row.replace("\\|", "").count("|") for row in rows} == {10}  # no cell more


@pytest.mark.parametrize("formula", MATH.values(), ids=MATH)
def test_formulas_are_mathml(formula):
    tree = ElementTree.fromstring(math(formula))
    assert "".join(tree.itertext()).strip()
    shown = formula.label + formula.right
    assert len(list(tree.iter("mfrac"))) == (1 if " / " in shown else 0)
    assert len(list(tree.iter("msup"))) == shown.count("²")


def test_a_fraction():
    tree = math(Formula("t", "−((o − p₁) · n) / (d · n)"))
    root = ElementTree.fromstring(tree)
    above, below = root.find("mfrac")
    assert "".join(above.itertext()) == "(o−p1)·n" and "".join(below.itertext()) == "d·n"
    assert [e.text for e in root if e.tag == "mo"] == ["=", "−"]
    assert [e.get("class") for e in below.iter("mi")] == ["derivation-vector"] * 2


@pytest.mark.parametrize(
    ("plain", "escaped"),
    [
        ("exercise_triangle.blend", "exercise_triangle.blend"),
        ("_x_ __y__", r"\_x\_ \_\_y\_\_"),
        ("s₂ < 0", "s₂ < 0"),
        ("<b>", r"\<b>"),
        ("a|b*c`e~[f](g)", r"a\|b\*c\`e\~\[f\](g)"),
        ("&amp; &", r"\&amp; &"),
        ("two\nlines", "two lines"),
    ],
)
def test_markdown_escapes_what_would_be_markup(plain, escaped):
    assert blocks.escaped(plain) == escaped
