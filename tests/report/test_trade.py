"""What a trade leaves in a folder: a table, strict JSON, and a plot if there is Matplotlib."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image
from reference_tracer import images
from reference_tracer.methods import Method
from reference_tracer.report import plots
from reference_tracer.report import trade as trade_report
from reference_tracer.report.trade import JSON, PLOT, SCHEMA, TABLE, plot_picture, table, write
from reference_tracer.study.trade import Trade, TradeRow, mark
from reference_tracer.tracer.settings import Precision

pytestmark = pytest.mark.slow

KEYS = {
    *("method", "precision", "samples", "width", "height", "seconds", "wrong_pixels"),
    *("largest_t_error", "peak_bytes", "coverage_error", "fastest", "slowest"),
    *("best", "best_pixels", "best_coverage"),
}


def made(wrong=(3742, 3052, 41, 0, 2, 0, 0, 0, 0), coverage=0.03, samples=(1, 2, 4)):
    ladder = [(m.value, p.value) for m in Method if m.is_plain for p in Precision]
    ladder.append(("certified", "float64"))
    rows = []
    for k in samples:
        for number, ((method, precision), count) in enumerate(zip(ladder, wrong, strict=True)):
            seconds = 0.04 * k * k * (1 + number / 30)
            rounds = 0.9 * seconds, seconds, 1.2 * seconds
            error = coverage / k * (1 + 4 * (method == "textbook_literal"))
            rows.append(
                TradeRow(
                    *(method, precision, k, 160, 90, seconds, count, 1e-5, 11 << 20),
                    *(error, rounds),
                )
            )
            if k == 1:
                rows.append(replace(rows[-1], width=80, height=45, coverage_error=2 * error))
    return Trade("a scene.blend", mark(rows), "float32 buys 12 %; certified has none.", 16)


@pytest.fixture(scope="module")
def trade():
    return made()


@pytest.fixture(scope="module")
def plot(trade):
    return plot_picture(trade)


def test_table(trade):
    text = table(trade)
    lines = text.splitlines()
    assert max(map(len, lines)) <= 100 and all(line == line.rstrip() for line in lines)
    for title in ("160 x 90 pixels, one ray each", "80 x 45 pixels, one ray each"):
        assert lines.count(title) == 1
    assert "160 x 90 pixels, 4 x 4 rays each" in lines
    head, first = lines[0], lines[lines.index("160 x 90 pixels, one ray each") + 1]
    assert first.split()[:3] == ["textbook_literal", "float32", "0.0400"]
    assert "(0.0360 - 0.0480)" in first and "3,742  (25.99%) *" in first and "11.0" in first
    assert head.index("precision") == first.index("float32")
    assert head.index("(min") == first.index("(0.0360")
    assert "16 x 16 rays a pixel" in text and lines[-1] == trade.advice
    rows = [line for line in lines if line.startswith(tuple(m.value for m in Method))]
    assert len(rows) == len(trade.rows)
    stars = sum(r.best_pixels + r.best_coverage for r in trade.rows)
    assert sum(line.count("*") for line in rows) == stars


def test_table_keeps_its_columns_apart(trade):
    """Whatever the numbers are, the columns begin and end below one another."""
    large = [
        replace(r, seconds=1234.5, rounds=(1200.0, 1234.5, 1300.25), wrong_pixels=w, width=3840)
        for r, w in zip(trade.rows, (133_064, 8_294_400, 7, *(0,) * 99), strict=False)
    ]
    large = [replace(r, height=2160, peak_bytes=123 << 30) for r in large]
    for rows in (large, [large[0], *trade.rows[1:]], [replace(large[0], largest_t_error=None)]):
        lines = table(replace(trade, rows=rows)).splitlines()
        found = [line for line in lines if line.startswith(tuple(m.value for m in Method))]
        assert len({line.index("(") for line in found}) == 1
        assert len({line.index("%") for line in found}) == 1
        for line in found:
            assert all(line[k + 1 : k + 2] in (" ", "") for k, c in enumerate(line) if c == ")")
            assert len(line.replace(" *", "").split()) == 11


@pytest.fixture
def folder(trade, tmp_path):
    write(tmp_path / "new" / "out", trade)
    return tmp_path / "new" / "out"


def strict(text):
    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    return json.loads(text, parse_constant=refuse)


def test_everything_is_there(folder, trade):
    assert sorted(p.name for p in folder.iterdir()) == sorted([TABLE, JSON, PLOT])
    assert (folder / TABLE).read_text(encoding="utf-8") == table(trade) + "\n"


def test_json(folder, trade):
    found = strict((folder / JSON).read_text(encoding="utf-8"))
    assert found["schema"] == SCHEMA == "reference_tracer.tradeoff/1"
    assert (found["scene"], found["advice"]) == (trade.scene, trade.advice)
    assert found["converged_samples"] == 16 and "metres" in found["units"]["largest_t_error"]
    assert len(found["rows"]) == len(trade.rows)
    for held, r in zip(found["rows"], trade.rows, strict=True):
        assert set(held) == KEYS
        assert all(held[name] == getattr(r, name) for name in KEYS)


def test_json_is_strict_whatever_was_measured(tmp_path, trade):
    odd = replace(trade.rows[0], largest_t_error=float("inf"), coverage_error=float("nan"))
    write(tmp_path, replace(trade, rows=[odd, *trade.rows[1:]]))
    held = strict((tmp_path / JSON).read_text(encoding="utf-8"))["rows"][0]
    assert held["largest_t_error"] is None and held["coverage_error"] is None


def test_plot_is_a_picture_with_its_letters_upright(folder, plot):
    assert plot.shape == (plots.HEIGHT, plots.WIDTH, 4) and plot.dtype == np.uint8
    assert (plot[..., 3] == 255).all()
    assert np.array_equal(np.asarray(Image.open(folder / PLOT))[::-1], plot)
    # The band of rows without a wrong pixel, pale green, lies at the lower left.
    y, x = np.nonzero((plot[..., :3] == (0xE6, 0xF2, 0xE6)).all(axis=-1))
    assert y.mean() < plots.HEIGHT / 2 and x.max() < 0.55 * plots.WIDTH


def shows(plot, color):
    """How many pixels have about this colour."""
    rgb = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)])
    return np.count_nonzero((np.abs(plot[..., :3].astype(int) - rgb) <= 2).all(axis=-1))


def test_plot_shows_the_line_of_the_best(plot, trade):
    none = [replace(r, best_pixels=False, best_coverage=False) for r in trade.rows]
    assert shows(plot, plots.INK) > shows(plot_picture(replace(trade, rows=none)), plots.INK) + 2000


@pytest.mark.parametrize(
    "case",
    [
        {"wrong": (0,) * 9},
        {"wrong": (14400,) * 8 + (0,)},
        {"coverage": 0.0},
        {"samples": (1,)},
    ],
)
def test_plot_of_odd_trades(case):
    """Nothing wrong, all wrong, a coverage without error, one sample."""
    assert len(np.unique(plot_picture(made(**case)).view(np.uint32))) > 50


def test_plots_keep_off_matplotlibs_global_state():
    """Which a host may use for plots of its own."""
    code = (
        "import sys\n"
        "from reference_tracer.report import plots\n"
        "plots.pixels(plots.new_figure(64, 64))\n"
        "assert 'matplotlib' in sys.modules\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_figure_has_the_size_that_was_asked_for():
    assert plots.pixels(plots.new_figure(320, 240)).shape == (240, 320, 4)


def test_without_matplotlib_all_else_is_written(trade, tmp_path, monkeypatch):
    """And a plot that an earlier run left is gone."""
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    (tmp_path / PLOT).touch()
    with pytest.raises(images.MissingLibraryError, match=r"pip install 'reference_tracer\[plots\]"):
        write(tmp_path, trade)
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([TABLE, JSON])


def test_names_in_a_plot_are_apart_or_left_out():
    """Also where all that is named is at one point."""
    axes = plots.new_figure().subplots()
    axes.plot([0.0, 1.0], [0.0, 1.0])
    trade_report._label(axes, [(0.5, 0.5, f"a name, number {k}") for k in range(20)])
    boxes = [t.get_window_extent() for t in axes.texts]
    assert 5 <= len(boxes) < 20
    assert not any(a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])


def test_the_headline_has_the_scenes_name(trade, monkeypatch):
    said = []
    monkeypatch.setattr(plots, "headline", lambda figure, text: said.append(text))
    plot_picture(replace(trade, advice="word " * 60))
    lines = said[0].splitlines()
    assert lines[0].startswith("a scene.blend: word") and max(map(len, lines)) <= 132


@pytest.mark.parametrize("low, high", [(1.0, 1.01), (0.03, 0.1), (1e-3, 1.0), (1e-6, 1e4)])
def test_ticks_are_few_but_some(low, high):
    axes = plots.new_figure().subplots()
    plots.log_ticks(axes.xaxis, low, high)
    assert 2 <= sum(low <= t <= high for t in axes.get_xticks()) <= 11
