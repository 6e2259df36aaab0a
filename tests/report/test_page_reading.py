"""The page as it is read: in light and dark, large and small, by keyboard, with hostile names."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.comparison.extras import Extras
from reference_tracer.manifest import ObjectEntry
from reference_tracer.pictures.source import Source
from reference_tracer.report import page
from reference_tracer.report.page.content import content
from reference_tracer.study import extremes, tradeoff
from reference_tracer.study.scenarios.sweeps import SCENARIOS
from reference_tracer.tracer.progress import result_of

from .browser import place_of, settled

pytestmark = pytest.mark.browser

COLORS = """() => {
  const probe = document.body.appendChild(document.createElement("i"));
  const of = name => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color;
  };
  const names = ["paper", "panel", "ink", "muted", "accent", "good", "good-paper", "bad",
    "bad-paper", "warn", "warn-paper", "off", "off-ink"];
  return Object.fromEntries(names.map(name => [name, of(name)]));
}"""


def channels(css):
    return [float(v) for v in css[css.index("(") + 1 : -1].split(",")[:3]]


def luminance(css):
    linear = [
        c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4
        for c in (v / 255 for v in channels(css))
    ]
    return float(np.dot(linear, (0.2126, 0.7152, 0.0722)))


def contrast(first, second):
    """WCAG 2.2's contrast ratio."""
    low, high = sorted((luminance(first), luminance(second)))
    return (high + 0.05) / (low + 0.05)


def test_names_are_text_and_nothing_more(show, differing, hostile):
    tab = show(differing)
    assert tab.evaluate("() => window.hacked") is None
    text = tab.locator("#tables").inner_text()
    for name in hostile[:2]:
        assert name in text
    assert "猫" in text and "&amp;" in text
    assert tab.locator("#tables img, #pixel img, script[src]").count() == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_light_and_dark_are_readable(show, differing, scheme):
    tab = show(differing, color_scheme=scheme)
    held = tab.evaluate(COLORS)
    assert (luminance(held["paper"]) > 0.5) == (scheme == "light")
    for ink in ("ink", "muted", "accent", "good", "bad"):
        for paper in ("paper", "panel"):
            assert contrast(held[ink], held[paper]) >= 4.5, (ink, paper)  # AA for text
    for name in ("good", "bad", "warn"):
        assert contrast(held[name], held[f"{name}-paper"]) >= 4.5, name
    assert contrast(held["off-ink"], held["off"]) >= 4.5
    tab.keyboard.press("t")  # the other one, whatever the system says
    assert (luminance(tab.evaluate(COLORS)["paper"]) > 0.5) == (scheme == "dark")
    tab.locator("#theme").click()
    assert tab.evaluate(COLORS) == held


def test_the_system_is_followed_until_one_chooses(show, differing):
    tab = show(differing, color_scheme="light")
    light = tab.evaluate(COLORS)
    tab.emulate_media(color_scheme="dark")
    settled(tab)
    dark = tab.evaluate(COLORS)
    assert luminance(dark["paper"]) < 0.5
    tab.emulate_media(media="print")
    assert tab.evaluate(COLORS) == light  # paper is white
    tab.emulate_media(media="screen")
    assert tab.evaluate(COLORS) == dark
    tab.keyboard.press("t")
    for scheme in ("light", "dark"):
        tab.emulate_media(color_scheme=scheme)
        settled(tab)
        assert tab.evaluate(COLORS) == light, scheme


def test_large_type_and_help(show, differing):
    tab = show(differing)
    before = tab.evaluate("() => parseFloat(getComputedStyle(document.documentElement).fontSize)")
    tab.keyboard.press("l")
    after = tab.evaluate("() => parseFloat(getComputedStyle(document.documentElement).fontSize)")
    assert after > 1.15 * before and before >= 16
    tab.keyboard.press("?")
    assert tab.locator("#help").is_visible()
    keys = tab.evaluate("() => KEYS.length")
    assert tab.locator("#keys dt").count() == keys + 2
    tab.keyboard.press("n")  # means nothing while the help is open
    tab.keyboard.press("Escape")
    assert not tab.locator("#help").is_visible()


@pytest.mark.parametrize("width", [360, 768, 1024, 1920])
def test_no_width_scrolls_sideways(show, differing, width):
    tab = show(differing, viewport={"width": width, "height": 768})
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= width
    tab.keyboard.press("l")
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= width


def test_all_can_be_reached_by_keyboard(show, differing):
    tab = show(differing)
    reached = set()
    for _ in range(60):
        tab.keyboard.press("Tab")
        reached.add(
            tab.evaluate("() => document.activeElement.id || document.activeElement.className")
        )
    wanted = {"large", "theme", "left", "exchange", "right", "canvas", "split", "zoom-in", "marks",
              "entry", "previous", "next", "chip", "x", "y", "permalink"}  # fmt: skip
    assert wanted <= reached


def test_a_page_without_what_was_left_out(show, differing):
    tab = show(differing, held=content(differing, limit=0))
    tab.mouse.click(*place_of(tab, 40, 30))
    assert "not known" in tab.locator("#sides").inner_text()
    assert "too large" in tab.locator("#derivation").inner_text()
    assert "left out" in tab.locator("#tables").inner_text()


def test_a_card_is_one_record(show, differing):
    tab = show(differing)
    seeds = "{ title: 'Seeds', of: () => ['Sown', ' and grown'] }"
    cards = f"{seeds}, {{ title: 'None', of: () => [] }}"
    tab.evaluate(f"() => {{ CARDS.push({cards}); drawTables(); }}")
    assert tab.locator("#tables h2").all_inner_texts()[-1] == "Seeds"
    assert "Sown and grown" in tab.locator("#tables").inner_text()


def test_studies_are_shown_with_their_plots(show, differing):
    trade = result_of(tradeoff.measure(differing.scene, 24, 2, "a.blend"))
    rows = result_of(extremes.measure(SCENARIOS[:1], 40))
    held = json.loads(page.json_text(content(differing, Extras(trade, rows))))
    tab = show(differing, held=held)
    assert "where methods break" in tab.locator("#tables").inner_text()
    plots = tab.locator("#tables svg")
    assert plots.count() == 2 and trade.advice in plots.first.inner_html()
    assert all(box["width"] > 1000 for box in (p.bounding_box() for p in plots.all()))
    # No word is wider than is allowed for, without a font, where all are laid out.
    wide = plots.locator("text").evaluate_all(
        """all => all.map(t => t.getComputedTextLength() / parseFloat(t.getAttribute("font-size"))
          / [...t.textContent].length / (t.hasAttribute("font-weight") ? 0.72 : 0.64))"""
    )
    assert len(wide) > 40 and max(wide) <= 1


def test_a_camera_of_a_third_type_is_refused_in_words(show, differing):
    held = json.loads(page.json_text(content(differing)))
    held["camera"]["projection"] = "mirrored"
    notice = show(differing, held=held, ready="[role=alert]").locator("[role=alert]").inner_text()
    assert notice == "This page cannot be shown: it has no rays of a mirrored camera."


def test_the_causes_are_seen_without_scrolling(show, differing):
    tab = show(differing, viewport={"width": 1366, "height": 768})
    box = tab.locator("#legend").bounding_box()
    assert box["y"] + box["height"] <= 768
    assert tab.locator("#stage").bounding_box()["height"] > 300


def test_long_tables_are_cut_and_say_so(show, differing):
    entries = tuple(ObjectEntry(f"Leaf {k}", "MESH", True) for k in range(5000))
    manifest = replace(differing.manifest, objects=entries)
    many = replace(differing, case=replace(differing.case, manifest=manifest))
    tab = show(many, held=content(many))
    text = tab.locator("#tables").inner_text()
    assert "Leaf 199" in text and "Leaf 200" not in text and "4,800 more" in text


def test_a_picture_that_is_not_blenders(show, differing):
    picture = replace(differing.case.picture, source=Source(file="student.png"))
    tab = show(replace(differing, case=replace(differing.case, picture=picture)))
    text = tab.locator("body").inner_text()
    assert "student.png" in tab.locator("#subtitle").inner_text() and "null" not in text
    assert tab.locator("#right option").nth(1).inner_text() == "Picture"


def test_a_browser_that_is_too_old_is_told(show, differing):
    script = "delete window.DecompressionStream"
    tab = show(differing, script=script, ready="[role=alert]")
    assert "needs a browser of 2023" in tab.locator("[role=alert]").inner_text()
