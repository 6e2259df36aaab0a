"""A browser for the tests of the page: headless Chromium, and nothing fetched."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from reference_tracer.comparison.extras import extras
from reference_tracer.files.images import to_display
from reference_tracer.report import page
from reference_tracer.report.page.content import content
from reference_tracer.tracer.progress import result_of

BROWSER = Path(__file__).resolve().parents[2] / "tools" / "browser.sh"
NAMES = "chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"
SIZE = {"width": 1280, "height": 1300}  # the stage is whole in it
NOT_BAD = ("data:", "blob:")  # addresses that are no network


@pytest.fixture(scope="session")  # for tests/conftest.py: Playwright can't start twice in a process
def chromium():
    from playwright.sync_api import sync_playwright

    check = subprocess.run([BROWSER, "check"], capture_output=True, text=True)
    if check.returncode:
        pytest.skip(check.stdout.strip())
    path = next(filter(None, map(shutil.which, NAMES)), None)
    assert path, "no Chromium: tools/browser.sh setup installs one"
    options = ["--no-sandbox"] if os.geteuid() == 0 else []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=options)
        yield browser
        browser.close()


@pytest.fixture
def open_page(chromium, tmp_path):
    """Open a page's text; afterwards nothing may have been fetched or gone wrong."""
    contexts, wrong = [], []

    def opened(text, hash_="", script="", ready="html[data-ready]", **options):
        path = tmp_path / "page.html"
        path.write_text(text, encoding="utf-8")
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

        context.add_init_script(script)
        context.route(lambda url: not url.startswith(NOT_BAD), guard)
        tab.goto(path.as_uri() + hash_)
        tab.wait_for_selector(ready)
        return tab

    yield opened
    for context in contexts:
        context.close()
    assert not wrong


@pytest.fixture
def show(open_page):
    """Open a comparison's page."""

    def opened(comparison, hash_="", held=None, **options):
        held = held or content(comparison, result_of(extras(comparison)))
        return open_page(page.html(held), hash_, **options)

    return opened


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


def color_at(tab, x, y, pane=0, u=0.5, v=0.2):
    """What a pane shows of a pixel, at a share of its width and height, (r, g, b)."""
    settled(tab)
    return tuple(
        tab.evaluate(
            """([x, y, pane, u, v]) => {
              const [px, py] = toPane(panes()[pane], x + u, y + v), ratio = devicePixelRatio;
              const one = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
              const from = [px * ratio, py * ratio];
              one.drawImage(document.getElementById("canvas"), ...from, 1, 1, 0, 0, 1, 1);
              return [...one.getImageData(0, 0, 1, 1).data];
            }""",
            [x, y, pane, u, v],
        )[:3]
    )


def shown(color):
    return tuple(int(v) for v in to_display(color[None, None])[0, 0, :3])


def choose(tab, mode):
    """Click one of the ways to show two pictures."""
    tab.locator(f"#mode label:has([value={mode}])").click()
    settled(tab)


def both(tab):
    """Show the two pictures, a half of the stage each and marked, whatever the page opened on."""
    shown = "left: 'traced', right: 'blender', mode: 'slider', split: 0.5, marks: true"
    tab.evaluate(f"() => change({{ {shown} }})")


def unmarked(tab):
    """Take the marks off the pictures."""
    tab.locator("#marks").uncheck()
