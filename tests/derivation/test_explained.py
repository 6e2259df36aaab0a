"""The page of one pixel: the same numbers as the Markdown, names as text, nothing fetched."""

from __future__ import annotations

from dataclasses import replace

import pytest
from reference_tracer.derivation import blocks, document
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.textbook import Arithmetic


@pytest.fixture
def derivation(ball_scene):
    return derive(ball_scene, 12, 9)


@pytest.mark.browser
def test_only_the_seen_candidate_is_unfolded_and_links_lead_to_headings(derivation, page_of):
    tab = page_of(derivation)
    names = [test.candidate.name for test in derivation.tests]
    unfolded = [name == derivation.certified.seen for name in names]
    assert sum(unfolded) == 1 < len(names)
    assert tab.locator("details").evaluate_all("all => all.map(e => e.open)") == unfolded
    links = tab.locator("nav a").evaluate_all("all => all.map(e => e.hash)")
    assert len(links) == 6  # five parts and what is seen
    assert all(tab.locator(link).count() == 1 for link in links)
    assert f"#derivation-2-{unfolded.index(True) + 1}" in links
    assert tab.title() == tab.locator("h1").inner_text()


@pytest.mark.browser
def test_each_t_says_what_it_is(derivation, page_of):
    text = page_of(derivation).locator(".lecture").inner_text()
    assert "(proven: the exact value, rounded once)" in text
    t = derivation.seen_test.number("t", Arithmetic.FLOAT64)
    assert f"By the textbook’s formula in float64, t = {float(t)!r} m." in text


@pytest.mark.browser
@pytest.mark.parametrize("width", [500, 1200])
def test_no_table_is_cut_off(derivation, page_of, width):
    tab = page_of(derivation, viewport={"width": width, "height": 800})
    boxes = "all => all.map(e => [e.scrollWidth, e.clientWidth])"
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= width
    if width == 1200:  # on a small one they scroll, and say so
        for inner, outer in tab.locator(".scroll").evaluate_all(boxes):
            assert inner <= outer
    assert tab.locator(".scrolls").first.is_visible() == (width == 500)
    tab.emulate_media(media="print")
    hidden = tab.locator("details:not([open]) table").first
    assert hidden.evaluate("e => e.checkVisibility({ contentVisibilityAuto: true })")
    assert hidden.bounding_box()["height"] > 100


@pytest.mark.browser
def test_the_numbers_are_those_of_the_markdown(derivation, page_of):
    tables = [b for b in document.lecture(derivation) if getattr(b, "kind", "") == "numbers"]
    shown = [row[k] for table in tables for row in table.rows for k in (2, 4, 6)]
    tab = page_of(derivation)
    assert tab.locator(".digits").all_text_contents() == [str(cell) for cell in shown]
    wrong = sum(bool(cell.wrong) for cell in shown)
    assert tab.locator(".digits mark").count() == wrong > 0
    assert document.document_markdown(derivation).count("**") // 2 == (
        wrong + tab.locator(".answer, .warning").count()
    )


@pytest.mark.browser
@pytest.mark.parametrize(
    "name", ["<script>alert(1)</script>", "a|b*c_d`e", "&amp;", 'x" onclick="y']
)
def test_names_are_text(ball_scene, page_of, name):
    names = [name] * len(ball_scene.objects)
    found = derive(replace(ball_scene, objects=names), 12, 9, source=name)
    tab = page_of(found)
    assert name in tab.locator("h1").inner_text() and name in tab.locator("h3").first.inner_text()
    assert tab.locator(".lecture script, [onclick]").count() == 0
    text = document.document_markdown(found)
    rows = [line for line in text.splitlines() if line.startswith("| 2.")]
    assert len(rows) == len(found.tests)
    assert {row.replace("\\|", "").count("|") for row in rows} == {10}  # no cell more


@pytest.mark.browser
def test_formulas_are_set(derivation, page_of):
    """All letters of a formula are there; vectors are upright, indices and components are not."""
    tab = page_of(derivation)
    shown = tab.locator(".numbers td:first-child .formula").all_text_contents()
    of_tests = (q for test in derivation.tests for q in test.quantities)
    steps = (*derivation.camera, *derivation.ray, *of_tests)
    assert shown == [str(q.formula._replace(remark="")).replace("_", "") for q in steps]
    vectors = tab.locator(".formula var.vector").all_text_contents()
    assert {"o", "d", "n", "right"} <= set(vectors) and "t" not in vectors
    first = tab.locator(".numbers .formula", has_text="p₁.x").first
    assert first.locator("var").evaluate_all("all => all.map(e => e.className)") == ["vector", ""]
    assert tab.locator(".formula sub").first.inner_text() == "min"


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
