"""The table of an animation's frames, and its page."""

from __future__ import annotations

import base64
import json
import re

import numpy as np
import pytest
from reference_tracer.comparison.animation import FrameRow
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.files.images import save_png
from reference_tracer.report import animation as report

FRAMES = range(1, 31)
HOSTILE = "shot <1> $most \"&'\udc80.blend"
ROWS = [
    *(FrameRow(f, Verdict.AGREE, 1000 - f, f) for f in FRAMES if f not in (4, 9)),
    FrameRow(4, error="Camera '<b>$title' has scale 0"),
    FrameRow(9, Verdict.DIFFERENCES, 900, 60, 40),
]


def test_the_page_and_the_table_have_the_worst_first(tmp_path):
    report.write(tmp_path, HOSTILE, FRAMES, ROWS)
    held = json.loads((tmp_path / report.JSON).read_text(encoding="utf-8"))
    assert [row["frame"] for row in held["frames"]][:4] == [4, 9, 30, 29]
    assert held["verdict"] == "failed" and len(held["frames"]) == 30
    page = (tmp_path / report.PAGE).read_text(encoding="utf-8")
    linked = re.findall(r'<td><a href="frame_(\d+)/page.html">', page)
    assert [int(n) for n in linked] == [row["frame"] for row in held["frames"][1:]]
    assert "<td>4</td>" in page  # it failed, so its folder has nothing of this run
    assert "<b>" not in page and "shot &lt;1&gt; $most" in page and HOSTILE not in page
    lines = report.lines(FRAMES, ROWS)
    assert lines[1].split()[:4] == ["4", "-", "-", "-"] and "has scale 0" in lines[1]
    assert lines[2].split() == ["9", "900", "60", "40", "differences"]
    assert lines[-3:] == [
        "and 20 more, in animation.html",
        "30 of 30 frames are done",
        "verdict: failed",
    ]


@pytest.mark.browser
@pytest.mark.parametrize("rows", [[], ROWS[:1], [ROWS[-2]]], ids=["none", "one", "failed"])
def test_few_frames_make_a_page_too(rows, tmp_path, plotted):
    report.write(tmp_path, "shot.blend", FRAMES, rows)
    page = (tmp_path / report.PAGE).read_text(encoding="utf-8")
    assert f"{len(rows)} of 30 frames are done" in page
    plot = plotted(page)
    assert len([t for t in plot.texts if t.words == "Pixels that differ, by frame"]) == 1
    assert len(plot.titled("circle")) == 2 * sum(not r.error for r in rows)
    assert not [e for e in plot.elements if "NaN" in str(e)]


def test_the_worst_frames_have_their_pictures_in_the_page(tmp_path):
    """Those of the frames that differ, from their folders: a frame that agrees has none."""
    rows = [
        *(FrameRow(f, Verdict.AGREE, 1000) for f in range(1, 4)),
        *(r for r in ROWS if r.frame > 3),
    ]
    for row in rows:
        folder = report.folder_of(tmp_path, row.frame)
        folder.mkdir()
        for name in ("blender.png", "difference.png"):
            picture = np.full((4, 6, 4), row.frame % 256, np.uint8)
            picture[..., 3] = 255 - (name == "difference.png")
            save_png(folder / name, picture)
    report.write(tmp_path, "shot.blend", FRAMES, rows)
    page = (tmp_path / report.PAGE).read_text(encoding="utf-8")
    found = re.findall(
        r'<figure><a href="frame_(\d+)/page.html">((?:<img [^>]*>)+)</a>'
        r"<figcaption([^>]*)>([^<]*)</figcaption></figure>",
        page,
    )
    worst = [row["frame"] for row in json.loads((tmp_path / report.JSON).read_text())["frames"]]
    assert [int(n) for n, *_ in found] == worst[1:7]  # the first has an error, and no pictures
    assert found[0][2] == ' class="bad"' and found[0][3] == (
        "frame 9: 40 unexplained, 60 explained"
    )
    for frame, images, *_ in found:
        for name, data in zip(
            ("blender.png", "difference.png"), re.findall(r"base64,([^\"]*)", images), strict=True
        ):
            stored = (report.folder_of(tmp_path, int(frame)) / name).read_bytes()
            assert base64.b64decode(data) == stored


@pytest.mark.browser
@pytest.mark.parametrize(
    ("frames", "most"), [(range(1, 3), 1), (range(7, 8), 0), (range(1, 251), 2_000_000)]
)
def test_the_axes_have_whole_numbers(tmp_path, frames, most, plotted):
    rows = [FrameRow(f, Verdict.DIFFERENCES, 10, 0, most) for f in frames]
    report.write(tmp_path, "shot.blend", frames, rows)
    page = (tmp_path / report.PAGE).read_text(encoding="utf-8")
    texts = plotted(page).texts
    for side in ("middle", "end"):
        on_side = (t.words for t in texts if t.attributes["text-anchor"] == side)
        numbers = [words.replace(",", "") for words in on_side if words[0].isdigit()]
        assert 2 <= len(numbers) <= 10 and all(n.isdigit() for n in numbers)
        assert len(set(numbers)) == len(numbers)
    assert "2,000,000" in [t.words for t in texts] or most < 2_000_000


@pytest.mark.browser
@pytest.mark.parametrize("width", [390, 1280])
def test_the_numbers_at_the_axes_are_legible(chromium, tmp_path, width):
    report.write(tmp_path, "shot.blend", FRAMES, ROWS)
    tab = chromium.new_page(viewport={"width": width, "height": 800})
    tab.goto((tmp_path / report.PAGE).as_uri())
    sizes = tab.locator("svg text").evaluate_all(
        "all => all.map((t) => t.getAttribute('font-size') * t.ownerSVGElement.getScreenCTM().a)"
    )
    assert len(sizes) > 15 and min(sizes) >= 11
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= width
    assert tab.locator(".scrolls").first.is_visible() == (width < 1000)
    tab.close()
