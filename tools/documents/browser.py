"""The page's pictures, taken in a headless Chromium, which `tools/browser.sh` installs."""

from __future__ import annotations

import io
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser, sync_playwright

NAMES = "chromium", "chromium-browser", "google-chrome", "chromium-headless-shell"
READY = "html[data-ready]"  # what the page's script says when it is there
_DRAWN = "() => new Promise(r => requestAnimationFrame(() => requestAnimationFrame(r)))"


def chromium() -> str:
    """Return the path of this machine's Chromium.

    Raises
    ------
    RuntimeError
        If there is none.
    """
    path = next(filter(None, map(shutil.which, NAMES)), None)
    if path is None:
        raise RuntimeError("no Chromium here: tools/browser.sh setup installs one")
    return path


@contextmanager
def opened() -> Iterator[Browser]:
    """Open a headless Chromium."""
    with sync_playwright() as playwright:
        options = ["--no-sandbox"] if os.geteuid() == 0 else []
        browser = playwright.chromium.launch(executable_path=chromium(), args=options)
        try:
            yield browser
        finally:
            browser.close()


def save(
    page: Path, picture: Path, width: int, height: int, hash_: str = "", mode: str = ""
) -> None:
    """Write what a window of a size shows of a page, as a small PNG.

    Parameters
    ----------
    page, picture : Path
    width, height : int
        In pixels.
    hash_ : str
        Which pixel, "#x=1&y=2"; "" for the one that the page begins with.
    mode : str
        How the pictures are shown, as the page names it; "" for as it begins.

    Raises
    ------
    RuntimeError
        If there is no Chromium here, or the page's script fails.
    """
    wrong: list[str] = []
    with opened() as browser:
        size = {"width": width, "height": height}
        tab = browser.new_page(viewport=size, color_scheme="light")
        tab.on("pageerror", lambda error: wrong.append(str(error)))
        tab.goto(page.resolve().as_uri() + hash_)
        tab.wait_for_selector(READY)
        if mode:
            tab.locator(f"#mode label:has([value={mode}])").click()
            tab.mouse.move(0, 0)
        tab.evaluate(_DRAWN)
        shot = tab.screenshot()
    if wrong:
        raise RuntimeError(f"{page}: {'; '.join(wrong)}")
    colors = Image.open(io.BytesIO(shot)).convert("RGB").quantize(256, dither=Image.Dither.NONE)
    colors.save(picture, optimize=True)
