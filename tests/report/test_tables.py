"""The one formatter of text tables, and the numbers in its cells."""

from __future__ import annotations

from reference_tracer.report.tables import columns, percent


def test_columns_begin_and_end_below_one_another():
    assert columns(
        [("name", "n", "unit"), "a title", ("a", "1,000", "m"), ("long one", "2", "")]
    ) == [
        "name          n  unit",
        "a title",
        "a         1,000     m",
        "long one      2",
    ]


def test_sides_gap_and_least_widths():
    rows = [("a", "bb"), ("ccc", "d")]
    assert columns(rows, left=(0, 1), gap="|") == ["a  |bb", "ccc|d"]
    assert columns(rows, left=(), gap=" ", least=(4,)) == ["   a bb", " ccc  d"]
    assert columns(rows, left=(), gap=" ", least=(0, 4, 9)) == ["  a   bb", "ccc    d"]
    assert columns([]) == [] and columns(["only a title"]) == ["only a title"]


def test_percent_does_not_round_to_all_or_none():
    shares = 0, 1e-9, 0.5, 1 - 1e-9, 1
    assert [percent(v) for v in shares] == ["0", "0.1", "50.0", "99.9", "100"]
