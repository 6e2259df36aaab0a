"""The table of an animation's frames, and its page."""

from __future__ import annotations

import json
import re

import pytest
from reference_tracer.compare.animation import FrameRow
from reference_tracer.report import animation as report

FRAMES = range(1, 31)
HOSTILE = "shot <1> $most \"&'\udc80.blend"
ROWS = [
    *(FrameRow(f, "agree", 1000 - f, f) for f in FRAMES if f not in (4, 9)),
    FrameRow(4, error="Camera '<b>$title' has scale 0"),
    FrameRow(9, "differences", 900, 60, 40),
]


def test_the_page_and_the_table_have_the_worst_first(tmp_path):
    report.write(tmp_path, HOSTILE, FRAMES, ROWS)
    held = json.loads((tmp_path / report.JSON).read_text(encoding="utf-8"))
    assert [row["frame"] for row in held["frames"]][:4] == [4, 9, 30, 29]
    assert held["verdict"] == "failed" and len(held["frames"]) == 30
    page = (tmp_path / report.PAGE).read_text(encoding="utf-8")
    linked = re.findall(r'<td><a href="frame_(\d+)/(\S+)">', page)
    assert [int(n) for n, _ in linked] == [row["frame"] for row in held["frames"]]
    assert linked[0][1] == "comparison.json" and {name for _, name in linked[1:]} == {"page.html"}
    assert "<b>" not in page and "shot &lt;1&gt; $most" in page and "<script" not in page
    lines = report.lines(FRAMES, ROWS)
    assert lines[1].split()[:4] == ["4", "-", "-", "-"] and "has scale 0" in lines[1]
    assert lines[2].split() == ["9", "900", "60", "40", "differences"]
    assert lines[-3:] == [
        "and 20 more, in animation.html",
        "30 of 30 frames are done",
        "verdict: failed",
    ]


@pytest.mark.parametrize("rows", [[], ROWS[:1], [ROWS[-2]]], ids=["none", "one", "failed"])
def test_few_frames_make_a_page_too(rows, tmp_path):
    report.write(tmp_path, "shot.blend", FRAMES, rows)
    page = (tmp_path / report.PAGE).read_text(encoding="utf-8")
    assert f"{len(rows)} of 30 frames are done" in page
    assert "nan" not in page
