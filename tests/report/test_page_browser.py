"""The page in a real browser, headless Chromium: clicked, pressed and dragged; and no network.

The numbers of its derivations have the bits of the tracer's own formulas.
"""

from __future__ import annotations

import base64
import json
import os
import shutil
import struct

import numpy as np
import pytest
from reference_tracer.images import to_display
from reference_tracer.report import page
from reference_tracer.report.page import document, surfaces
from reference_tracer.report.page.content import content
from reference_tracer.tracer import plane
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions_of
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Method
from reference_tracer.tracer.triangle import METHODS
from reference_tracer.tracer.world import world_corners

pytestmark = pytest.mark.browser

NAMES = "chromium", "chromium-browser", "google-chrome"
SIZE = {"width": 1280, "height": 1300}  # the stage is whole in it
NOT_BAD = ("data:", "blob:")  # addresses that are no network

# All pixels with the surface that each sees: t, s1, s2, s3, whether literal and repaired accept it.
DERIVE_ALL = """precision => {
  const [width, height] = referenceTracer.page.size, out = [];
  for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) {
    const r = referenceTracer.derive(x, y, precision);
    const accepted = [r.literal, r.textbook].map(Number);
    out.push(r.t ?? NaN, ...(r.s ?? [NaN, NaN, NaN]), ...accepted.map(a => a || 0));
  }
  const bytes = new Uint8Array(new Float64Array(out).buffer);
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}"""


@pytest.fixture(scope="module")
def chromium():
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, NAMES)), None)
    assert path, "no Chromium: tools/browser.sh setup installs one"
    options = ["--no-sandbox"] if os.geteuid() == 0 else []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=options)
        yield browser
        browser.close()


@pytest.fixture
def show(chromium, tmp_path):
    """Open a comparison's page; afterwards nothing may have been fetched or gone wrong."""
    contexts, wrong = [], []

    def opened(comparison, hash_="", held=None, **options):
        path = tmp_path / "page.html"
        held = held or content(comparison, **vars(result_of(page.extras(comparison))))
        path.write_text(document.html(held), encoding="utf-8")
        options = {"viewport": SIZE, "color_scheme": "light"} | options
        context = chromium.new_context(**options)
        contexts.append(context)
        tab = context.new_page()
        tab.on("console", lambda m: wrong.append(f"{m.type}: {m.text}"))
        tab.on("pageerror", lambda error: wrong.append(str(error)))
        tab.on("dialog", lambda dialog: wrong.append(dialog.message))

        def guard(route):
            if route.request.url.split("#")[0] != path.as_uri():
                wrong.append(route.request.url)
            route.continue_()

        context.route(lambda url: not url.startswith(NOT_BAD), guard)
        tab.goto(path.as_uri() + hash_)
        tab.wait_for_selector("html[data-ready]")
        return tab

    yield opened
    for context in contexts:
        context.close()
    assert not wrong


def settled(tab):
    """Wait until what was asked for is drawn."""
    tab.evaluate("() => new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))")


def state(tab, name):
    return tab.evaluate("name => referenceTracer.state[name]", name)


def place_of(tab, x, y):
    """Where the middle of a pixel is in the window, in the first pane."""
    settled(tab)
    px, py = tab.evaluate("([x, y]) => toPane(panes()[0], x + 0.5, y + 0.5)", [x, y])
    box = tab.locator("#canvas").bounding_box()
    return box["x"] + px, box["y"] + py


def color_at(tab, x, y):
    """What the stage shows near the middle of a pixel, (r, g, b)."""
    settled(tab)
    return tuple(
        tab.evaluate(
            """([x, y]) => {
              const [px, py] = toPane(panes()[0], x + 0.5, y + 0.5), ratio = devicePixelRatio;
              const one = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
              const from = [px * ratio, (py + 0.3 * scaleNow()) * ratio];
              one.drawImage(document.getElementById("canvas"), ...from, 1, 1, 0, 0, 1, 1);
              return [...one.getImageData(0, 0, 1, 1).data];
            }""",
            [x, y],
        )[:3]
    )


def shown(color):
    return tuple(int(v) for v in to_display(color[None, None])[0, 0, :3])


def choose(tab, mode):
    """Click one of the ways to show two pictures."""
    tab.locator(f"#mode label:has([value={mode}])").click()
    settled(tab)


def unmarked(tab):
    """Take the marks off the pictures."""
    tab.locator("#marks").uncheck()


def test_it_opens_and_says_the_verdict_at_a_glance(show, differing):
    tab = show(differing)
    assert "Differences" in tab.locator("#verdict").inner_text()
    assert "1,720 of 1,728" in tab.locator("#headline").inner_text()
    assert tab.locator(".tile.bad dd").inner_text() == "2"
    assert tab.title() == "Scene – Reference Tracer"
    assert "a.blend" in tab.locator("#subtitle").inner_text()


def test_the_slider_shows_one_picture_on_each_side(show, differing):
    tab = show(differing)
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
    assert tab.locator("#split").get_attribute("aria-valuenow") == "2"


def test_hovering_swaps_and_so_does_a_key(show, differing):
    tab = show(differing)
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


def test_every_picture_can_be_shown_on_either_side(show, differing):
    tab = show(differing)
    ids = tab.locator("#left option").evaluate_all("all => all.map(o => o.value)")
    assert ids[:4] == ["traced", "blender", "literal", "causes"]
    for name in ids:
        tab.locator("#right").select_option(name)
        assert state(tab, "right") == name
    tab.locator("#exchange").click()
    assert state(tab, "left") == ids[-1] and state(tab, "right") == "traced"
    for mode, expected in (("pair", 2), ("all", len(ids))):
        choose(tab, mode)
        assert tab.evaluate("() => panes().length") == expected


def test_the_legend_filters_the_map(show, differing):
    tab = show(differing)
    colors = {c["name"]: c["color"] for c in content(differing)["causes"]}
    where = "([x, y]) => [...shownColor('causes', x, y)].slice(0, 3)"

    def is_marked(x, y, name):
        rgb = [int(colors[name][i : i + 2], 16) for i in (1, 3, 5)]
        return tab.evaluate(where, [x, y]) == rgb

    assert is_marked(8, 4, "not_modelled") and is_marked(40, 30, "unexplained")
    tab.locator('[data-cause="unexplained"]').click()
    assert is_marked(40, 30, "unexplained") and not is_marked(8, 4, "not_modelled")
    assert tab.locator('[data-cause="unexplained"]').get_attribute("aria-pressed") == "true"
    assert tab.locator("#examples button").count() == 2
    tab.keyboard.press("Shift+Tab")  # by keyboard: the one before it
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


def expected_bits(comparison, dtype):
    """The same numbers by the tracer's own formulas, (h * w, 6) float64."""
    scene, frame = comparison.scene, comparison.frame
    camera, count = scene.camera, len(scene.instances)
    pixel = np.arange(frame.t.size)
    rays = camera_rays(camera, *film_positions_of(camera.region, pixel), dtype)
    rays = Rays(*(np.broadcast_to(v, (3, len(pixel))) for v in (rays.origins, rays.directions)))
    out = np.zeros((len(pixel), 6))
    out[:, :4] = np.nan
    instance, triangle = frame.instance_index.ravel(), frame.triangle_index.ravel()
    mesh = np.flatnonzero((instance >= 0) & (instance < count))
    corners = world_corners(scene, instance[mesh], triangle[mesh]).astype(dtype)
    for column, method in ((4, Method.TEXTBOOK_LITERAL), (5, Method.TEXTBOOK)):
        hit, t, s = METHODS[method](rays.take(mesh), *corners)
        out[mesh, 0], out[mesh, 1:4], out[mesh, column] = t, s.T, hit
    for k, infinite in enumerate(scene.planes):
        flat = np.flatnonzero(instance == count + k)
        point, normal = (v[:, None].astype(dtype) for v in (infinite.point, infinite.normal))
        out[flat, 0] = plane.intersect(rays.take(flat), point, normal)
    return out


@pytest.mark.parametrize("precision", ["float64", "float32"])
@pytest.mark.parametrize("orthographic", [False, True])
@pytest.mark.parametrize("stored", ["float64", "float32"])
def test_derivations_have_the_tracers_bits(show, room, compared, precision, orthographic, stored):
    comparison = compared(room(orthographic=orthographic, float32=stored == "float32"))
    tab = show(comparison)
    found = np.frombuffer(base64.b64decode(tab.evaluate(DERIVE_ALL, precision)))
    expected = expected_bits(comparison, np.dtype(precision))
    assert np.isfinite(expected[:, 1]).sum() > 400 and np.isfinite(expected[:, 0]).sum() > 700
    literal, textbook = expected[:, 4].sum(), expected[:, 5].sum()
    assert 0 < literal < 0.8 * textbook  # the erratum is seen
    assert np.array_equal(found.reshape(-1, 6).view(np.int64), expected.view(np.int64)) or (
        np.array_equal(found.reshape(-1, 6), expected, equal_nan=True)
    )


@pytest.mark.parametrize("orthographic", [False, True])
def test_the_traced_t_is_there_to_the_last_bit(show, room, compared, orthographic):
    comparison = compared(room(orthographic=orthographic))
    tab = show(comparison)
    height, width = comparison.frame.t.shape
    found = tab.evaluate(
        """([w, h]) => Array.from({ length: w * h }, (_, i) => {
          const b = new DataView(new ArrayBuffer(8));
          b.setFloat64(0, referenceTracer.tracedT(i % w, Math.floor(i / w)));
          return b.getBigUint64(0).toString(16).padStart(16, "0");
        })""",
        [width, height],
    )
    expected = [struct.pack(">d", t).hex() for t in comparison.frame.t.ravel()]
    assert found == expected
    assert (
        surfaces.t_offsets(comparison.scene, comparison.frame, surfaces.seen(comparison.frame))
    ).any()


def test_the_derivation_shows_its_numbers(show, differing):
    tab = show(differing, "#x=40&y=30")  # an example: derived exactly, too
    assert tab.locator("#fragment details").count() == 1
    assert "exact" in tab.locator("#fragment").inner_html()
    y, x = np.argwhere(differing.frame.triangle_index > 9)[0].tolist()
    tab.evaluate("([x, y]) => select(x, y)", [x, y])
    assert tab.locator("#fragment details").count() == 0
    text = tab.locator("#derivation").inner_text()
    result = tab.evaluate("([x, y]) => referenceTracer.derive(x, y)", [x, y])
    for value in (*result["ray"]["direction"], *result["n"], result["t"]):
        assert repr(value).replace("-", "−") in text
    assert "float32" in text and "hit" in text and "errata" in text
    rows = tab.locator("#derivation table").first.locator("tbody tr")
    assert rows.count() > 1 and "it is what is seen" in rows.first.inner_text()
    rows.nth(1).locator("button").click()
    assert tab.locator("#derivation .pick").nth(1).get_attribute("aria-pressed") == "true"


def test_a_ray_that_meets_nothing(show, room, compared):
    comparison = compared(room(planes=False))
    y, x = np.argwhere(comparison.frame.instance_index < 0)[0].tolist()
    tab = show(comparison, f"#x={x}&y={y}")
    assert "nothing" in tab.locator("#sides").inner_text()
    assert tab.evaluate("([x, y]) => referenceTracer.tracedT(x, y)", [x, y]) == float("inf")
    assert tab.locator("#derivation").inner_text()


def test_numbers_are_written_as_python_does(show, differing, rng):
    tab = show(differing)
    values = [0.0, 1.0, 9.9999, 0.1, 1e22, 123456.7, 0.00012345, *(10 ** rng.uniform(-30, 30, 200))]
    for digits in (1, 3, 6):
        found = tab.evaluate("([v, d]) => v.map(x => general(x, d))", [values, digits])
        expected = [f"{v:.{digits}g}".replace("-", "−") for v in values]
        assert found == expected
    filled = tab.evaluate(
        "s => filled(s, { figure: 0.00192, allowed: 64 })",
        "{figure:.3g} of {allowed:.0f}, {allowed}",
    )
    assert filled == f"{0.00192:.3g} of {64:.0f}, {64}"
    small = rng.integers(0x00800000, 0x7F000000, 500).astype(np.uint32).view(np.float32)
    written = tab.evaluate("v => v.map(x => shortest(x, 'float32'))", small.astype(float).tolist())
    read = [np.float32(text.replace("−", "-")) for text in written]
    assert read == list(small)
    assert all(len(w.split("e")[0].replace(".", "").strip("0")) <= 9 for w in written)


def test_names_are_text_and_nothing_more(show, differing, hostile):
    tab = show(differing)
    assert tab.evaluate("() => window.hacked") is None
    text = tab.locator("#tables").inner_text()
    for name in hostile[:2]:
        assert name in text
    assert "猫" in text and "&amp;" in text
    assert tab.locator("#tables img, #pixel img, script[src]").count() == 0


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


def test_studies_are_shown_with_their_plots(show, differing):
    from reference_tracer.study import extremes, tradeoff
    from reference_tracer.study.scenarios.sweeps import SCENARIOS

    trade = result_of(tradeoff.measure(differing.scene, 24, 2, "a.blend"))
    rows = result_of(extremes.measure(SCENARIOS[:1], 40))
    held = json.loads(document.json_text(content(differing, trade, rows)))
    tab = show(differing, held=held)
    text = tab.locator("#tables").inner_text()
    assert trade.advice in text and "where methods break" in text
    images = tab.locator("#tables img")
    assert images.count() >= 3
    sizes = images.evaluate_all("all => all.map(i => i.complete && i.naturalWidth)")
    assert min(sizes) > 1000
