"""Which frames a user names, and which of them are the worst."""

from __future__ import annotations

import pytest
from reference_tracer.cli.main import main
from reference_tracer.comparison.animation import FrameRow, frames_named, worst_first
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.wording import shown


@pytest.mark.parametrize(
    ("text", "frames"),
    [
        ("7", [7]),
        ("1-4", [1, 2, 3, 4]),
        ("1-250:100", [1, 101, 201]),
        ("-3--1", [-3, -2, -1]),
        ("-1-1", [-1, 0, 1]),
        ("1048574", [1048574]),
    ],
)
def test_frames_are_named(text, frames):
    assert list(frames_named(text)) == frames


def test_all_are_the_scenes_own():
    assert frames_named("all") is None


@pytest.mark.parametrize(
    "text", ["", "x", "1-", "1-5:0", "1-5:-1", "1:5", "1-5,7", "1.5", "1048575", "9" * 5000]
)
def test_what_names_no_frames_is_refused_in_a_line(text, tmp_path, capsys):
    with pytest.raises(ValueError, match="it must be"):
        frames_named(text)
    out = tmp_path / "out"
    assert main(["compare", "none.blend", "--out", str(out), f"--frames={text}"]) == 4
    said = f"--frames is {text}; it must be 1-250, 1-250:5 for every fifth, 7, or all, for example"
    assert capsys.readouterr().err.splitlines() == [shown(f"reftrace: {shown(said)}")]
    assert not out.exists()


@pytest.mark.parametrize(
    "options",
    [["--trade"], ["--extremes"], ["--judge", "all"], ["--against", "picture.png"]],
    ids=" ".join,
)
def test_what_is_for_one_frame_is_refused(options, tmp_path, capsys):
    argv = ["compare", "none.blend", "--out", str(tmp_path / "out"), "--frames", "1-4"]
    assert main([*argv, *options]) == 4
    said = capsys.readouterr().err
    assert options[0] in said and "--frames" in said and "one frame" in said


def test_the_worst_are_first():
    rows = [
        FrameRow(1, Verdict.AGREE, 90, 10),
        FrameRow(2, Verdict.DIFFERENCES, 80, 10, 10),
        FrameRow(3, Verdict.WARNINGS, 50, 50),
        FrameRow(4, Verdict.DIFFERENCES, 70, 0, 30),
        FrameRow(5, error="no camera"),
        FrameRow(6, Verdict.AGREE, 90, 10),
        FrameRow(7, Verdict.AGREE, 80, 20),
    ]
    found = worst_first(rows)
    assert [row.frame for row in found] == [5, 4, 2, 3, 7, 1, 6]
    assert found[0].verdict.exit_code == 4 and found[1].verdict.exit_code == 2


def test_frames_that_end_before_they_begin_are_told_in_order():
    with pytest.raises(ValueError, match=r"^is 5-1, which ends before it begins: 1-5 does not$"):
        frames_named("5-1")
