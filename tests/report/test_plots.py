"""What all plots are drawn with: round numbers along axes, words that any name may hold."""

from __future__ import annotations

import random
from xml.etree import ElementTree

import pytest
from reference_tracer.report import plots

from ..drawn import Plot, scale

HOSTILE = "<&\"'>]]></svg><script>x</script>\x00\x1b\ud800 é 猫\ufffe", "", " ", "{0}%s$x"


def drawn(x, y, small=False):
    axes = plots.Axes(200, 200, 500, 300, x, y)
    inside = axes.drawn("", "along", "" if small else "up", small)
    return Plot(plots.picture(900, 700, "title", "about", inside)), axes


@pytest.mark.parametrize("kind", [plots.linear, plots.logarithmic])
def test_ticks_are_few_and_where_they_say(kind):
    """Whatever the ends are."""
    rng = random.Random(5)
    ends = [(1.0, 1.01), (0.03, 0.1), (1e-3, 1.0), (1e-6, 1e4), (1e-100, 1e100)]
    ends += [(low, low * 10 ** rng.uniform(0.01, 20)) for low in (10.0**k for k in range(-9, 9))]
    for low, high in ends:
        found = kind(low, high)
        assert 2 <= len(set(found.ticks.values())) == len(found.ticks) <= 11, (low, high)
        for value, words in found.ticks.items():
            assert low <= value <= high * (1 + 1e-12)
            assert float(words) == pytest.approx(value, rel=1e-5)
            assert 0 <= found.share(value) <= 1 + 1e-12
        assert (found.share(low), found.share(high)) == (0, 1)


@pytest.mark.parametrize("small", [False, True])
def test_axes_are_drawn_where_their_numbers_are(small):
    plot, axes = drawn(plots.logarithmic(1e-3, 20), plots.linear(-3, 40), small)
    plot.assert_legible()
    along = [t for t in plot.texts if t.y > 500 and t.words[0].isdigit()]
    x = scale([(t.x, float(t.words)) for t in along], log=True)
    up = [t for t in plot.texts if t.x < 195 and t.words[0].isdigit()]
    size = float(up[0].attributes["font-size"])
    y = scale([(t.y - 0.35 * size, float(t.words)) for t in up], log=False)
    for at in ((0.001, -3), (0.5, 0), (20, 40)):
        place = axes.at(*at)
        assert (x(place[0]), y(place[1])) == (pytest.approx(at[0]), pytest.approx(at[1], abs=1e-4))


@pytest.mark.parametrize("words", HOSTILE)
def test_words_are_words_whatever_they_hold(words):
    marks = plots.text((9, 9), words, 20) + plots.mark((1, 1), 3, plots.INK, title=words)
    root = ElementTree.fromstring(plots.picture(99, 99, f"a{words}", f"b{words}", marks))
    assert not [e for e in root.iter() if e.tag.endswith("script")]
    kept = "".join(c for c in words if c.isprintable() and not 0xD800 <= ord(c) < 0xE000)
    assert kept.strip("\ufffe") in root[0].text.replace("\ufffd", "")


def test_a_page_of_a_plot_is_read_by_a_browser():
    one = plots.picture(99, 99, "t", "a", "")
    held = plots.page("<b>", one)
    assert held.count("<svg") == 1 and "<title>&lt;b&gt;</title>" in held


def test_a_legend_is_as_small_as_it_must_be():
    for count in (1, 5, 20):
        entries = {f"entry number {k}": plots.mark((0, 0), 9, plots.INK) for k in range(count)}
        plot = Plot(plots.picture(plots.WIDTH, 200, "t", "a", plots.legend(entries, 100)))
        plot.assert_legible()
        assert len(plot.texts) == count == sum(e.tag == "circle" for e in plot.elements)
