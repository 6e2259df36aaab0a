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


def shown(folder):
    """What the page holds, as it stands in its file."""
    text = (folder / report.PAGE).read_text(encoding="utf-8")
    [held] = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text)
    return json.loads(held)


def test_the_page_and_the_table_have_the_worst_first(tmp_path):
    report.write(tmp_path, HOSTILE, FRAMES, ROWS)
    held = json.loads((tmp_path / report.JSON).read_text(encoding="utf-8"))
    assert [row["frame"] for row in held["frames"]][:4] == [4, 9, 30, 29]
    assert held["verdict"] == "failed" and len(held["frames"]) == 30
    page = shown(tmp_path)
    links = [f"frame_{row['frame']:04}/page.html" for row in held["frames"][1:]]
    assert [row["link"] for row in page["frames"]] == ["", *links]  # what failed has no page
    assert page["title"] == HOSTILE.replace("\udc80", "?")
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
    found = shown(tmp_path)["worst"]
    worst = [row["frame"] for row in json.loads((tmp_path / report.JSON).read_text())["frames"]]
    folders = [report.folder_of(tmp_path, frame) for frame in worst[1:7]]  # the first failed
    assert [one["link"] for one in found] == [f"{folder.name}/page.html" for folder in folders]
    assert [one["bad"] for one in found] == [True, *[False] * 5]
    assert found[0]["words"] == "frame 9: 40 unexplained, 60 explained"
    for folder, one in zip(folders, found, strict=True):
        stored = [(folder / name).read_bytes() for name in ("blender.png", "difference.png")]
        assert [base64.b64decode(picture["png"]) for picture in one["pictures"]] == stored


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
    links = tab.locator("table a").evaluate_all("all => all.map((a) => a.getAttribute('href'))")
    held = shown(tmp_path)["frames"]
    assert links == [row["link"] for row in held if row["link"]] and len(links) == 29
    marks = tab.locator("svg circle:has(title)").evaluate_all(
        "all => all.map((e) => [e.textContent, e.getBoundingClientRect().top])"
    )
    tops = {f: min(top for t, top in marks if t.startswith(f"frame {f}: ")) for f in (1, 9)}
    assert tops[1] - tops[9] > 50  # higher up in the window, as more pixels differ
    tab.close()
