"""Work that yields its share."""

from __future__ import annotations

from reference_tracer.tracer.progress import called, doing, result_of, scaled


def work():
    yield 0.25
    yield 0.5
    return "done"


def test_progress_is_told_and_the_result_returned():
    shares = []
    assert result_of(work(), shares.append) == "done"
    assert shares == [0.25, 0.5]
    assert result_of(work()) == "done"


def test_a_part_of_a_larger_work():
    shares = []
    assert result_of(scaled(work(), 0.5, 0.2), shares.append) == "done"
    assert shares == [0.55, 0.6]


def test_what_is_being_done_goes_through_larger_work():
    shares = []
    assert result_of(scaled(called(work(), "tracing"), 0.5, 0.2), shares.append) == "done"
    assert shares == [0.55, 0.6] and [doing(s) for s in shares] == ["tracing"] * 2
    assert doing(0.5) == ""
    assert doing(next(called(scaled(called(work(), "part"), 0.5, 0.2), "whole"))) == "whole"
