"""The page's pictures in a real browser: clicked, dragged and moved by keys."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from reference_tracer.files.images import to_display
from reference_tracer.report.page.content import content

from .browser import both, choose, color_at, place_of, settled, shown, state, unmarked

pytestmark = pytest.mark.browser


def test_it_opens_and_says_the_verdict_at_a_glance(show, differing):
    tab = show(differing)
    said = differing.verdict.in_words(differing.counts)  # as everywhere else
    assert tab.locator("#verdict").inner_text().split("\n")[-1].endswith(said)
    assert "1,720 of 1,728" in tab.locator("#headline").inner_text()
    assert tab.locator(".tile.bad dd").inner_text() == "2"
    assert "of 8 that differ" in tab.locator(".tile").nth(1).inner_text()
    assert tab.title() == "a.blend – Reference Tracer"
    assert tab.locator("#title").inner_text() == "a.blend"
    assert "scene Scene" in tab.locator("#subtitle").inner_text()


def test_the_slider_shows_one_picture_on_each_side(show, differing):
    tab = show(differing)
    both(tab)
    unmarked(tab)
    x, y = 8, 4
    mine, theirs = shown(differing.frame.color[y, x]), shown(differing.picture[y, x])
    assert mine != theirs
    assert color_at(tab, x, y) == mine  # left of the middle
    box, handle = tab.locator("#canvas").bounding_box(), tab.locator("#split").bounding_box()
    tab.mouse.move(handle["x"] + 1, handle["y"] + 40)
    tab.mouse.down()
    tab.mouse.move(box["x"] + 5, handle["y"] + 40, steps=4)
    tab.mouse.up()
    assert state(tab, "split") < 0.05 and color_at(tab, x, y) == theirs
    tab.locator("#split").focus()
    for _ in range(3):
        tab.keyboard.press("End")
    assert state(tab, "split") == 1 and color_at(tab, x, y) == mine
    tab.keyboard.press("Home")
    tab.keyboard.press("ArrowRight")
    assert state(tab, "split") == pytest.approx(0.02)
    settled(tab)
    assert tab.locator("#split").get_attribute("aria-valuenow") == "2"


def test_hovering_swaps_and_so_does_a_key(show, differing):
    tab = show(differing)
    both(tab)
    unmarked(tab)
    choose(tab, "swap")
    x, y = 8, 4
    mine, theirs = shown(differing.frame.color[y, x]), shown(differing.picture[y, x])
    assert color_at(tab, x, y) == mine
    tab.locator("#canvas").hover()
    assert color_at(tab, x, y) == theirs
    tab.locator("#title").hover()
    assert color_at(tab, x, y) == mine
    tab.keyboard.press("s")
    assert color_at(tab, x, y) == theirs


def test_the_legend_filters_the_map(show, differing):
    tab = show(differing)
    causes: Any = content(differing)["causes"]
    colors = {c["name"]: c["color"] for c in causes}
    where = "([x, y]) => [...shownColor('causes', x, y)].slice(0, 3)"

    def is_marked(x, y, name):
        rgb = [int(colors[name][i : i + 2], 16) for i in (1, 3, 5)]
        return tab.evaluate(where, [x, y]) == rgb

    assert is_marked(8, 4, "not_modelled") and is_marked(40, 30, "unexplained")
    tab.locator('[data-cause="unexplained"]').click()
    assert is_marked(40, 30, "unexplained") and not is_marked(8, 4, "not_modelled")
    assert tab.locator('[data-cause="unexplained"]').get_attribute("aria-pressed") == "true"
    assert tab.locator("#examples button").count() == 2
    tab.keyboard.press("Tab")  # by keyboard: the one after it
    assert tab.evaluate("() => document.activeElement.dataset.cause") == "not_modelled"
    tab.keyboard.press("Enter")
    assert is_marked(8, 4, "not_modelled") and not is_marked(40, 30, "unexplained")
    tab.keyboard.press("Enter")  # again: all of them
    assert is_marked(8, 4, "not_modelled") and is_marked(40, 30, "unexplained")
    assert "6" in tab.locator('[data-cause="not_modelled"]').inner_text()


def test_a_click_shows_what_is_known_of_a_pixel(show, differing, hostile):
    tab = show(differing)
    x, y = 40, 30
    tab.mouse.click(*place_of(tab, x, y))
    assert (state(tab, "x"), state(tab, "y")) == (x, y)
    assert tab.locator("#x").input_value() == "40" and tab.locator("#y").input_value() == "30"
    assert "Unexplained" in tab.locator("#cause").inner_text()
    sides = tab.locator("#sides").inner_text()
    for color in (differing.frame.color[y, x], differing.picture[y, x]):
        assert " ".join(str(v) for v in to_display(color[None, None])[0, 0]) in sides
        for value in color:
            assert np.format_float_positional(value, trim="-") in sides
    name = differing.scene.objects[differing.frame.object_index[y, x]]
    assert name in sides
    assert "infinite plane" in sides
    by, bx = np.argwhere(differing.frame.triangle_index > 9)[0].tolist()
    tab.mouse.click(*place_of(tab, bx, by))
    sides = tab.locator("#sides").inner_text()
    assert str(differing.frame.triangle_index[by, bx]) in sides
    assert differing.scene.objects[differing.frame.object_index[by, bx]] in sides
    tab.mouse.click(*place_of(tab, 8, 4))
    said = tab.locator("#cause").inner_text()
    assert "Not modelled" in said and hostile[0] in said and "hair (long)" in said
    tab.mouse.click(*place_of(tab, 20, 34))
    assert "Agrees" in tab.locator("#cause").inner_text()


def test_keys_move_the_pixel_and_jump_to_examples(show, differing):
    tab = show(differing)
    tab.locator("#canvas").focus()
    tab.evaluate("() => select(10, 10)")
    for key, pixel in (
        ("ArrowRight", (11, 10)),
        ("ArrowUp", (11, 11)),
        ("Shift+ArrowLeft", (1, 11)),
        ("ArrowDown", (1, 10)),
        ("Shift+ArrowLeft", (0, 10)),
    ):
        tab.keyboard.press(key)
        assert (state(tab, "x"), state(tab, "y")) == pixel
    seen = []
    for _ in range(9):
        tab.keyboard.press("n")
        seen.append((state(tab, "x"), state(tab, "y")))
    assert seen[8] == seen[0] and set(seen) == {*((x, 4) for x in range(5, 11)), (40, 30), (41, 30)}
    tab.keyboard.press("p")
    assert (state(tab, "x"), state(tab, "y")) == seen[7]
    tab.locator("#next").click()
    assert (state(tab, "x"), state(tab, "y")) == seen[0]
    tab.locator("#examples button").nth(3).click()
    assert (state(tab, "x"), state(tab, "y")) == seen[3]
    assert state(tab, "view")["scale"] >= 20


def test_zoom_by_wheel_keys_and_buttons(show, differing):
    tab = show(differing)
    x, y = 30, 20
    spot = place_of(tab, x, y)
    tab.mouse.move(*spot)
    tab.mouse.wheel(0, -600)
    settled(tab)
    assert state(tab, "view")["scale"] > 20
    assert place_of(tab, x, y) == pytest.approx(spot, abs=3)  # stays below the pointer
    before = state(tab, "view")
    tab.mouse.down()
    tab.mouse.move(spot[0] + 60, spot[1] + 30, steps=3)
    tab.mouse.up()
    after = state(tab, "view")
    assert after["x"] < before["x"] and after["y"] > before["y"]
    tab.keyboard.press("0")
    assert state(tab, "view")["scale"] == 0
    tab.locator("#zoom-in").click()
    near = state(tab, "view")["scale"]
    tab.keyboard.press("+")
    assert state(tab, "view")["scale"] > near
    tab.locator("#fit").click()
    assert state(tab, "view")["scale"] == 0


def test_crisp_pixels(show, differing):
    tab = show(differing)
    unmarked(tab)
    tab.evaluate("() => { select(0, 0); change({ split: 1 }); setView(24, 18, 40); }")
    for x, y in ((22, 17), (23, 17), (24, 18), (25, 19)):
        assert color_at(tab, x, y) == shown(differing.frame.color[y, x])


def test_a_permalink_opens_at_its_pixel(show, differing):
    tab = show(differing, "#x=40&y=30")
    assert (state(tab, "x"), state(tab, "y")) == (40, 30) and state(tab, "view")["scale"] >= 20
    assert tab.locator("#permalink").get_attribute("href") == "#x=40&y=30"
    tab.evaluate("() => { location.hash = '#x=3&y=5'; }")
    tab.wait_for_function("() => referenceTracer.state.x === 3")
    assert tab.locator("#y").input_value() == "5"
    tab = show(differing, "#x=9999&y=-5")
    assert (state(tab, "x"), state(tab, "y")) == (47, 0)
    said = tab.locator("#status").inner_text()
    assert "(9999, −5)" in said and "(47, 0)" in said
    tab.evaluate("() => select(3, 3)")
    assert not tab.locator("#status").is_visible()
    tab.locator("#x").fill("99")
    tab.locator("#x").press("Enter")
    assert "(99, 3)" in tab.locator("#status").inner_text()


def test_a_visited_pixel_shows_both_pictures_free_of_slider_and_mark(show, differing):
    tab = show(differing, "#x=40&y=30")
    x, y = 40, 30
    mine, theirs = shown(differing.frame.color[y, x]), shown(differing.picture[y, x])
    assert state(tab, "mode") == "pair" and not tab.locator("#split").is_visible()
    assert mine != theirs
    for pane, expected in enumerate((mine, theirs)):
        for u in (0.2, 0.5, 0.8):
            for v in (0.2, 0.5, 0.8):
                assert color_at(tab, x, y, pane, u, v) == expected
    choose(tab, "slider")  # back, at the same place: the line keeps clear of the pixel
    line = tab.locator("#split").bounding_box()["x"]
    scale = tab.evaluate("() => scaleNow()")
    assert abs(line - place_of(tab, x, y)[0]) > scale / 2
    choose(tab, "swap")
    tab.keyboard.press("n")
    assert state(tab, "mode") == "swap"  # what shows both is left as it is
