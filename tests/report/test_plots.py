"""What all plots are drawn with: round numbers along axes, words that any name may hold."""

from __future__ import annotations

import random

import pytest
from reference_tracer.report.plots import INK, Entry, Panel, Plot, Scale, Series
from reference_tracer.report.shown import data
from reference_tracer.report.templates import alone

from ..drawn import Plot as Plotted
from ..drawn import scale

pytestmark = pytest.mark.browser

HOSTILE = "<&\"'>]]></svg><script>x</script> é 猫 {0}%s$x \ud800"


UNIT = Scale(0, 1, "integers")


def page(x=UNIT, y=UNIT, words="along", legend=(), small=False):
    panel = Panel(words, words, words, x, y, [Series(INK, [(x.low, y.low, words)])])
    entries = [Entry(name, Series(INK)) for name in legend]
    return alone(words, plots=[Plot(words, words, [panel], entries, words, words, small)])


def test_ticks_are_few_and_where_they_say(open_page):
    """Whatever the ends are."""
    rng = random.Random(5)
    ends = [(1.0, 1.01), (0.03, 0.1), (1e-3, 1.0), (1e-6, 1e4), (1e-100, 1e100)]
    ends += [(low, low * 10 ** rng.uniform(0.01, 20)) for low in (10.0**k for k in range(-9, 9))]
    tab = open_page(page(), ready="svg")
    scales = [data(Scale(low, high, "log")) for low, high in ends]
    tested = "s => ticksOf(s).map(([v, words]) => [v, words, share(s, v)])"
    for (low, high), ticks in zip(
        ends, tab.evaluate(f"all => all.map({tested})", scales), strict=True
    ):
        assert 2 <= len({words for _, words, _ in ticks}) == len(ticks) <= 11, (low, high)
        for value, words, share in ticks:
            assert low <= value <= high * (1 + 1e-12)
            assert float(words.replace("−", "-")) == pytest.approx(value, rel=1e-5)
            assert 0 <= share <= 1 + 1e-12
    at_ends = tab.evaluate("all => all.flatMap(s => [share(s, s.low), share(s, s.high)])", scales)
    assert at_ends == [0, 1] * len(scales)


@pytest.mark.parametrize("small", [False, True])
def test_marks_are_drawn_where_the_numbers_of_the_axes_are(small, plotted):
    plot = plotted(page(Scale(1e-3, 20, "log"), Scale(-3, 40, "integers"), small=small))
    plot.assert_legible()
    [mark] = plot.titled("circle")
    along = [t for t in plot.texts if t.y > mark.y and t.words[0].isdigit()]
    x = scale([(t.x, float(t.words)) for t in along], log=True)
    up = [t for t in plot.texts if t.x < mark.x and t.y < mark.y and t.words[0].isdigit()]
    size = float(up[0].attributes["font-size"])
    y = scale([(t.y - 0.35 * size, float(t.words)) for t in up], log=False)
    assert (x(mark.x), y(mark.y)) == (pytest.approx(1e-3), pytest.approx(-3))


def test_words_are_words_whatever_they_hold(plotted):
    plot = plotted(page(words=HOSTILE, legend=[HOSTILE]))
    shown = HOSTILE.replace("\ud800", "?")
    assert plot.about == shown and [m.words for m in plot.titled("circle")] == [shown]
    assert plot.said().count(shown) == 6


def test_a_legend_is_as_small_as_it_must_be(plotted):
    for count in (1, 5, 20):
        plot = plotted(page(legend=[f"entry number {k}" for k in range(count)]))
        plot.assert_legible()
        assert sum(t.words.startswith("entry") for t in plot.texts) == count


def test_a_plot_is_saved_as_a_file_of_its_own(open_page, tmp_path):
    tab = open_page(page(words="<b>"), ready=".plot svg")
    with tab.expect_download() as saved:
        tab.get_by_text("Save as SVG").click()
    saved.value.save_as(tmp_path / "plot.svg")
    assert Plotted((tmp_path / "plot.svg").read_text("utf-8")).about == "<b>"
