"""Rows that workers send: they must be rows, and the same in all that is not timed."""

from __future__ import annotations

from dataclasses import asdict, replace

import pytest

pytest.importorskip("distributed")

from reference_tracer.study.extremes import ExtremesRow
from reference_tracer.study.trade import TIMED, TradeRow
from reference_tracer_cluster.studies import _facts, _row

ROW = TradeRow("textbook", "float32", 1, 8, 6, 0.5, 3, None, 1 << 20, 0.25, (0.5, 0.6, 0.7))
OTHER = ExtremesRow("needles", 4, "textbook", "float32", 9, 1, 2, 3, 4, exact=0.5)


@pytest.mark.parametrize("row", [ROW, OTHER])
def test_a_row_is_read_as_it_was_written(row):
    told = asdict(row) | ({"rounds": list(ROW.rounds)} if row is ROW else {})
    assert _row(type(row), told) == row


@pytest.mark.parametrize(
    "wrong", [{"seconds": "0.5"}, {"wrong_pixels": 0.5}, {"rounds": 3.0}, {"largest_t_error": "x"}]
)
def test_what_is_no_row_is_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        _row(TradeRow, asdict(ROW) | wrong)


@pytest.mark.parametrize("name", sorted(TIMED))
def test_two_honest_workers_may_differ_in_what_is_timed(name):
    """Of any column that says so, a new one too, and in no other."""
    other = replace(ROW, **{name: (9.0,) if name == "rounds" else 9})
    assert _facts([ROW]) == _facts([other])
    assert _facts([ROW]) != _facts([replace(ROW, wrong_pixels=4)])
    assert _facts([OTHER]) != _facts([replace(OTHER, doubled=0)])
