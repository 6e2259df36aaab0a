"""The lessons' drawings: what the page of `reftrace explain` draws of some pixels, each a file."""

from __future__ import annotations

import re
from pathlib import Path

from reference_tracer.derivation.derivation import derive
from reference_tracer.report import page, pixel

from . import browser
from .figures import scene

# By the scene: which pixel, and which of its drawings.
DRAWN = {
    "orthographic": (200, 240, "side"),
    "perspective": (200, 240, "film"),
    "plane": (320, 60, "side"),
    "triangle": (154, 167, "plane"),
}
# Of the page's light version, on paper of their own: a file cannot follow a page's colours.
_COLORS = (
    "--ink: #1d1d1f; --paper: #ffffff; --muted: #77777d; --accent: #b4501e; "
    "--s1: #c23030; --s2: #1d8a3a; --s3: #2b5fd0"
)
_RULES = re.compile(r"^\.drawings (?!\{|svg)(.+?\})$", re.M | re.S)


def write(folder: Path) -> None:
    """Write them all: docs/images/lessons."""
    styles = (Path(page.__file__).parent / "lecture.css").read_text(encoding="utf-8")
    rules = "\n".join(_RULES.findall(styles))
    style = f"<style>svg {{ {_COLORS}; font: 13px sans-serif; background: #fff }}\n{rules}</style>"
    with browser.opened() as opened:
        for name, (x, y, which) in DRAWN.items():
            tab = opened.new_page()
            tab.set_content(pixel.html(derive(scene(name), x, y)))
            svg = tab.locator(f'svg[data-name="{which}"]')
            svg.evaluate("(e, style) => e.insertAdjacentHTML('afterbegin', style)", style)
            text = svg.evaluate("e => new XMLSerializer().serializeToString(e)")
            (folder / f"drawn_{name}.svg").write_text(f"{text}\n", encoding="utf-8")


def save_plot(page: Path, picture: Path) -> None:
    """Save the plot of a study's page as a file, as a reader does."""
    with browser.opened() as opened:
        tab = opened.new_page()
        tab.goto(page.resolve().as_uri())
        with tab.expect_download() as saved:
            tab.get_by_text("Save as SVG").click()
        saved.value.save_as(picture)
