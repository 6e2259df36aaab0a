"""Which rows no other beats, and the advice, on rows made up for it."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.study.advice import advice, gain, mark
from reference_tracer.study.trade import COLUMNS, TradeRow
from reference_tracer.tracer.settings import Precision


def row(method="textbook", precision="float64", seconds=1.0, wrong=0, coverage=0.1, **options):
    """A row that took as long in each round."""
    rounds = options.pop("rounds", (seconds,) * 3)
    size = options.pop("width", 160), options.pop("height", 90)
    samples = options.pop("samples", 1)
    return TradeRow(method, precision, samples, *size, seconds, wrong, 0.0, 1000, coverage, rounds)


def beats(first, second):
    """As the definition says it: at least as good in both, better in one."""
    return all(a <= b for a, b in zip(first, second, strict=True)) and any(
        a < b for a, b in zip(first, second, strict=True)
    )


@pytest.mark.parametrize("seed", range(30))
def test_marks_are_those_of_the_definition(seed):
    """With few different values, so that there are ties of all kinds."""
    rng = np.random.default_rng(seed)
    rows = [
        row(
            seconds=float(rng.integers(1, 6)),
            wrong=int(rng.integers(0, 5)),
            coverage=float(rng.integers(0, 5)) / 8,
            width=int(rng.choice([160, 80])),
            samples=int(rng.choice([1, 2])),
        )
        for _ in range(rng.integers(1, 25))
    ]
    marked = mark(rows)
    assert [replace(m, best_pixels=False, best_coverage=False) for m in marked] == rows
    for m in marked:
        mine = m.seconds, m.wrong_pixels
        rivals = [(o.seconds, o.wrong_pixels) for o in rows if o.width == m.width]
        assert m.best_pixels == (not any(beats(o, mine) for o in rivals))
        mine = m.seconds, m.coverage_error
        assert m.best_coverage == (
            not any(beats((o.seconds, o.coverage_error), mine) for o in rows)
        )
        assert m.best == (m.best_pixels or m.best_coverage)
    assert any(m.best_coverage for m in marked)


def test_every_field_that_is_measured_has_a_column():
    chosen = {"method", "precision", "samples", "width", "height"}
    marks = {c.best for c in COLUMNS if c.best}
    assert {f.name for f in fields(TradeRow)} == chosen | {c.name for c in COLUMNS} | marks


def test_gain_is_that_of_the_rounds():
    """A slow moment falls on both rows of a round: only their ratio counts."""
    fast, slow = row(rounds=(0.9, 1.8, 0.9)), row(rounds=(1.0, 2.0, 1.0))
    assert gain(fast, slow) == pytest.approx(0.1)
    assert gain(slow, fast) == pytest.approx(1 - 1 / 0.9)
    assert gain(fast, row(rounds=(1.0, 1.7, 1.0))) == 0  # not in every round
    assert gain(fast, fast) == 0
    assert gain(slow, slow) == 0
    assert gain(row(rounds=()), slow) == 0
    assert gain(row(rounds=(0.5, 0.5)), row(rounds=(1.0, 1.0, 0.1))) == 0.5  # two in common


def test_no_row_is_best_by_noise():
    """Its median is smaller, but not measurably, and it gets more wrong."""
    right = row(seconds=1.0, rounds=(1.0, 0.9, 1.1), wrong=0, coverage=0.1)
    wrong = row(seconds=0.99, rounds=(0.99, 0.95, 0.98), wrong=5, coverage=0.2)
    assert [m.best for m in mark([right, wrong])] == [True, False]
    wrong = replace(wrong, rounds=(0.99, 0.89, 0.98))  # faster in every round
    assert all(m.best_pixels and m.best_coverage for m in mark([right, wrong]))
    equal = replace(right, seconds=1.01, rounds=(1.01, 0.8, 1.1))
    assert [m.best for m in mark([right, equal])] == [True, False]  # by its median


def ladder(**seconds_and_wrong):
    """A trade's rows; each option is `method_precision=(seconds, wrong pixels)`."""
    rows = [
        row(m.value, p.value, *seconds_and_wrong.get(f"{m.value}_{p.value}", (1.0, 0)))
        for m in Method
        if not m.is_proven
        for p in Precision
    ]
    certified = seconds_and_wrong.get("certified", (1.3, 0))
    return [*rows, row("certified", "float64", *certified)]


@pytest.mark.parametrize(
    "given, said",
    [
        ({"textbook_float32": (0.88, 41)}, "float32 buys 12 % here and costs 41 wrong pixels of"),
        ({"textbook_float32": (0.88, 1)}, "buys 12 % here and costs 1 wrong pixel of 14,400"),
        ({"textbook_float32": (0.5, 0)}, "buys 50 % here and costs no pixel of 14,400"),
        (
            {"textbook_float32": (1.0, 2)},
            "buys nothing that could be measured here and costs 2 wrong pixels of 14,400",
        ),
        ({"textbook_float32": (0.995, 2)}, "float32 buys less than 1 % here"),
        ({"textbook_float32": (1.1, 2)}, "takes 10 % longer than float64 here and costs 2 wrong"),
        ({"textbook_float32": (2.9, 2)}, "takes 2.9 times as long as float64 here"),
        (
            {"textbook_float32": (0.8, 2500), "textbook_float64": (1.0, 3)},
            "buys 20 % here and costs 2,497 more wrong pixels",
        ),
        (
            {"textbook_float32": (0.8, 3), "textbook_float64": (1.0, 3)},
            "buys 20 % here and costs no further pixel of 14,400",
        ),
        (
            {"textbook_float32": (0.8, 1), "textbook_float64": (1.0, 3)},
            "buys 20 % here and has 2 fewer wrong pixels of 14,400",
        ),
        (
            {"moller_trumbore_float32": (0.65, 7)},
            "certified, proven to have none, takes 2.0 times as long as Möller–Trumbore in float32 "
            "(7 wrong pixels), the fastest that loses no hits on purpose.",
        ),
        (
            {"watertight_float64": (0.8, 0), "certified": (1.0, 0)},
            "takes 25 % longer than watertight in float64 (no wrong pixels), the fastest that",
        ),
        (
            {"watertight_float64": (0.8, 0), "certified": (0.8, 0)},
            "takes no longer than watertight in float64 (no wrong pixels), the fastest that loses "
            "no hits on purpose, as far as could be measured.",
        ),
        (
            {"certified": (0.5, 0)},
            "is faster than textbook in float32 (no wrong pixels), the next that loses no hits",
        ),
        ({"watertight_float64": (0.8, 1)}, "as watertight in float64 (1 wrong pixel), the fastest"),
        ({"watertight_float64": (0.8, 2500)}, "as watertight in float64 (2,500 wrong pixels)"),
        # What is printed in the exercise is fast and wrong; it's no rival.
        ({"textbook_literal_float32": (0.1, 7000)}, "longer than textbook in float32"),
    ],
)
def test_advice(given, said):
    text = advice(ladder(**given))
    assert said in text
    assert text.endswith(".") and text.count(". ") == 0 and "\n" not in text  # one sentence


def test_advice_where_nothing_is_seen():
    rows = [replace(r, largest_t_error=None) for r in ladder()]
    assert advice(rows).startswith("Nothing is seen: ")
    assert advice([*rows[:-1], replace(rows[-1], largest_t_error=0.0)]).startswith("With the")


def test_advice_is_about_the_largest_picture():
    rows = ladder(textbook_float32=(0.88, 41))
    others = [replace(r, width=80, wrong_pixels=9999, rounds=(9.0,)) for r in rows]
    assert advice([*others, *rows, *(replace(r, samples=2) for r in rows)]) == advice(rows)
