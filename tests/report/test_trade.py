"""What a trade leaves in a folder: a table, strict JSON, and a plot."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from reference_tracer.methods import MEASURED, Method
from reference_tracer.report.plots import INK
from reference_tracer.report.trade import (
    JSON,
    SCHEMA,
    page,
    plot,
    table,
    write,
)
from reference_tracer.study.advice import mark
from reference_tracer.study.trade import COLUMNS, Trade, TradeRow
from reference_tracer.tracer.settings import Precision

pytestmark = pytest.mark.slow

KEYS = {
    "method",
    "precision",
    "samples",
    "width",
    "height",
    "seconds",
    "wrong_pixels",
    "largest_t_error",
    "peak_bytes",
    "coverage_error",
    "fastest",
    "slowest",
    "best",
    "best_pixels",
    "best_coverage",
}


def made(wrong=(3742, 3052, 41, 0, 2, 0, 0, 0, 0), coverage=0.03, samples=(1, 2, 4)):
    ladder = [(m.value, p.value) for m in Method if not m.is_proven for p in Precision]
    ladder.append(("certified", "float64"))
    wrong = (*wrong, *[0] * len(ladder))[: len(ladder)]  # a newer method has none
    rows = []
    for k in samples:
        for number, ((method, precision), count) in enumerate(zip(ladder, wrong, strict=True)):
            seconds = 0.04 * k * k * (1 + number / 30)
            rounds = 0.9 * seconds, seconds, 1.2 * seconds
            error = coverage / k * (1 + 4 * (method == "textbook_literal"))
            rows.append(
                TradeRow(
                    method,
                    precision,
                    k,
                    160,
                    90,
                    seconds,
                    count,
                    1e-5,
                    11 << 20,
                    error,
                    rounds,
                )
            )
            if k == 1:
                rows.append(replace(rows[-1], width=80, height=45, coverage_error=2 * error))
    return Trade("a scene.blend", mark(rows), "float32 buys 12 %; certified has none.", 16)


@pytest.fixture(scope="module")
def trade():
    return made()


def test_table(trade):
    text = table(trade)
    lines = text.splitlines()
    assert max(map(len, lines)) <= 120 and all(line == line.rstrip() for line in lines)
    head, first = lines[:2]
    literal = Method.TEXTBOOK_LITERAL.record.words
    assert first.startswith(f"{literal}  float32") and "0.0400" in first
    assert "(0.0360 - 0.0480)" in first and "3,742 *" in first and "11.0" in first
    assert head.index("precision") == first.index("float32")
    assert "16 x 16 rays a pixel" in text and lines[-1] == trade.advice
    rows = lines[1 : 1 + len(trade.rows)]
    assert all(
        r.precision in line and r.size in line for r, line in zip(trade.rows, rows, strict=True)
    )
    stars = sum(r.best_pixels + r.best_coverage for r in trade.rows)
    assert sum(line.count("*") for line in rows) == stars


@pytest.fixture
def folder(trade, tmp_path):
    write(tmp_path / "new" / "out", trade)
    return tmp_path / "new" / "out"


def strict(text):
    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    return json.loads(text, parse_constant=refuse)


def test_json(folder, trade):
    found = strict((folder / JSON).read_text(encoding="utf-8"))
    assert found["schema"] == SCHEMA == "reference_tracer.tradeoff/1"
    assert (found["scene"], found["advice"]) == (trade.scene, trade.advice)
    assert found["converged_samples"] == 16 and "metres" in found["units"]["largest_t_error"]
    assert len(found["rows"]) == len(trade.rows)
    for held, r in zip(found["rows"], trade.rows, strict=True):
        assert set(held) == KEYS
        assert all(held[name] == getattr(r, name) for name in KEYS)


def test_every_row_is_a_mark_at_its_numbers(trade):
    """And none else; hollow is float32, large is what no other beats; no error is at "none"."""
    sides = (
        (trade.whole, "wrong_pixels", "best_pixels"),
        (trade.rows, "coverage_error", "best_coverage"),
    )
    for panel, (rows, error, best) in zip(plot(trade).panels, sides, strict=True):
        marks = [s for s in panel.series if any(words for *_, words in s.points)]
        least = min(getattr(r, error) for r in rows if getattr(r, error))
        for r, mark_of in zip(rows, marks, strict=True):
            [(x, y, words)] = mark_of.points
            assert words.startswith(f"{Method(r.method).record.words}, {r.precision}, {r.size}: ")
            assert all(f"{c.head} {c.show(r)}" in words for c in COLUMNS)
            assert x == r.seconds and y == (getattr(r, error) or panel.y.named[0][0])
            assert getattr(r, error) or (y < least and panel.y.named[0][1] == "none")
            assert mark_of.color == Method(r.method).record.color
            assert mark_of.hollow == (r.precision == "float32")
            assert (mark_of.radius > 10) == getattr(r, best)
        line = panel.series[-1]
        assert line.color == INK and len(line.points) == sum(getattr(r, best) for r in rows)


@pytest.mark.browser
def test_the_plot_says_what_it_shows(trade, plotted):
    said = plotted(page(trade)).said()
    for words in (trade.advice, "a scene.blend: ", "16 × 16 rays", "160 × 90 pixels, one ray each"):
        assert words in said
    assert all(m.record.words in said for m in MEASURED)
