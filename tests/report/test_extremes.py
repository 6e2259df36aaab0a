"""What the study of numerical stability leaves in a folder."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.report.extremes import breaking_table, page, to_dict, write
from reference_tracer.study.extremes import ExtremesRow, written
from reference_tracer.study.scenarios.sweeps import SCENARIOS

from ..drawn import scale
from ..scenarios import quick

pytestmark = pytest.mark.slow

KEYS = {"scenario", "scale", "method", "precision", "rays", "missed", "doubled", "wrong", "refused"}
CHOICES = [("textbook", "float32"), ("textbook", "float64"), ("certified", "float64")]


@pytest.fixture(scope="module")
def rows():
    """Made up: methods break in the middle of each sweep; certified doesn't."""
    return [
        ExtremesRow(
            s.name,
            scale,
            *choice,
            rays=100,
            missed=10 * k * (choice[0] != "certified"),
            doubled=k,
            wrong=0,
            refused=0,
            largest_t_error=np.inf if k else 1.5,
        )
        for s in quick()
        for k, scale in enumerate(s.scales)
        for choice in CHOICES
    ]


def strict(text):
    def refuse(name):
        raise AssertionError(f"{name} is not JSON")

    return json.loads(text, parse_constant=refuse)


def test_the_folder(rows, tmp_path):
    write(tmp_path / "new", rows)
    names = {path.name for path in (tmp_path / "new").iterdir()}
    assert names == {"extremes.txt", "extremes.json", "extremes.html"}
    text = (tmp_path / "new" / "extremes.txt").read_text(encoding="utf-8")
    assert "far_from_origin" in text and SCENARIOS[-1].name in text
    held = strict((tmp_path / "new" / "extremes.json").read_text(encoding="utf-8"))
    assert held["schema"] == "reference_tracer.extremes/1"
    assert len(held["rows"]) == len(rows) and all(r.keys() >= KEYS for r in held["rows"])
    assert {r["largest_t_error"] for r in held["rows"]} == {1.5, None}
    assert set(held["units"]) <= held["rows"][0].keys()
    points = {(p["scenario"], p["method"], p["precision"]): p for p in held["breaking_points"]}
    assert len(points) == len(SCENARIOS) * len(CHOICES)
    assert (
        points["needles", "textbook", "float64"]["lost"] == SCENARIOS_BY_NAME["needles"].scales[1]
    )
    assert points["needles", "certified", "float64"]["lost"] is None
    assert [s["name"] for s in held["scenarios"]] == [s.name for s in SCENARIOS]


SCENARIOS_BY_NAME = {s.name: s for s in quick(SCENARIOS)}


@pytest.fixture
def drawn(rows, plotted):
    return plotted(page(rows))


@pytest.mark.browser
def test_the_picture_is_legible(rows, drawn, plotted):
    """That with all scales, too, whose numbers stand closest."""
    full = [
        replace(r, scale=x)
        for s in SCENARIOS
        for r in rows
        if r.scenario == s.name
        for x in s.scales
    ]
    for plot in (drawn, plotted(page(full))):
        plot.assert_legible()
        assert plot.width == 1920 and plot.height >= 1000


@pytest.mark.browser
def test_every_row_of_a_sweep_is_a_mark_where_its_axes_say(rows, drawn):
    marks = 0
    for s in SCENARIOS:
        title = drawn.text(s.title)
        near = [
            e
            for e in drawn.elements
            if -5 < e.x - title.x < 440 and 0 < e.y - title.y < 300 and "g" != e.tag
        ]
        up = [t for t in near if t.tag == "text" and t.words.endswith(" %")]
        y = scale([(t.y - 0.35 * 17, float(t.words[:-2])) for t in up], log=False)
        along = {
            t.words: float(t.attributes["transform"].split()[1])
            for t in near
            if "transform" in t.attributes
        }
        found = [e for e in near if e.tag == "circle" and e.words]
        marks += len(found)
        for r in (r for r in rows if r.scenario == s.name):
            name = f"{Method(r.method).record.words}, {r.precision}, {written(r.scale)}: "
            [m] = [m for m in found if m.words.startswith(name)]
            assert m.x == pytest.approx(along[written(r.scale)], abs=0.1)
            assert y(m.y) == pytest.approx(100 * r.share, abs=0.1)
            assert (m.attributes["fill"] == "white") == (r.precision == "float32")
    assert marks == len(rows)


@pytest.mark.browser
def test_a_scenario_of_ones_own(rows, plotted):
    """What is not among the scenarios has no title, and is shown by its name."""
    own = [replace(r, scenario="my <own>") for r in rows if r.scenario == "needles"]
    assert to_dict(own)["rows"][0]["scenario"] == "my <own>"
    assert plotted(page(own)).text("my <own>")


def row(scale, missed=0, wrong=0, doubled=0, method="watertight"):
    return ExtremesRow("tiny", scale, method, "float64", 200, missed, doubled, wrong, 0)


def test_tables():
    rows = [row(1.0), row(1e-9, doubled=1, wrong=3), row(1e-20, missed=200)]
    rows += [row(s, method="certified") for s in (1.0, 1e-9, 1e-20)]
    lines = breaking_table(rows).splitlines()
    assert lines[-1].split() == ["tiny", "scale", "1e-9", "+1e-9", "."]


def test_tables_of_all(rows):
    lines = breaking_table([replace(r, doubled=0) for r in rows]).splitlines()
    assert [line.split()[0] for line in lines[-len(SCENARIOS) :]] == [s.name for s in SCENARIOS]
    assert all(line.endswith(" .") for line in lines[-len(SCENARIOS) :])
