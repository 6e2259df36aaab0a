"""What the study of numerical stability leaves in a folder."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.report.extremes import breaking_table, page, plot, to_dict, write
from reference_tracer.study.extremes import ExtremesRow, written
from reference_tracer.study.scenarios.sweeps import SCENARIOS

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


def test_every_row_of_a_sweep_is_a_mark_at_its_numbers(rows):
    marks = 0
    for s, panel in zip(SCENARIOS, plot(rows).panels, strict=True):
        assert panel.title == s.title
        steps = {words: at for at, words in panel.x.named}
        found = {words: (x, y, m.hollow) for m in panel.series for x, y, words in m.points}
        marks += len(found)
        for r in (r for r in rows if r.scenario == s.name):
            name = f"{Method(r.method).record.words}, {r.precision}, {written(r.scale)}: "
            [at] = [at for words, at in found.items() if words.startswith(name)]
            assert at == (steps[written(r.scale)], 100 * r.share, r.precision == "float32")
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
