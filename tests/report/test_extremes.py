"""What the study of numerical stability leaves in a folder."""

from __future__ import annotations

import json
import sys
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.images import MissingLibraryError
from reference_tracer.report import extreme_plots, plots
from reference_tracer.report.extremes import (
    breaking_table,
    picture_names,
    pictures,
    table,
    to_dict,
    write,
)
from reference_tracer.study.extremes import ExtremesRow
from reference_tracer.study.scenarios.sweeps import MAPS, SCENARIOS

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
            seen=0 if k == 2 else 100,
            across=s.across,
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
    assert names == {"extremes.txt", "extremes.json", *(f"{n}.png" for n in picture_names())}
    text = (tmp_path / "new" / "extremes.txt").read_text(encoding="utf-8")
    assert "far_from_origin" in text and SCENARIOS[-1].explanation in text
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
    assert [m["name"] for m in held["maps"]] == [m.name for m in MAPS]


SCENARIOS_BY_NAME = {s.name: s for s in quick(SCENARIOS)}


def test_pictures_are_as_wide_as_a_projector_and_show_something(rows):
    for name, picture in pictures(rows):
        assert name in picture_names()
        assert picture.dtype == np.uint8 and picture.shape[1:] == (1920, 4)
        assert (picture[..., 3] == 255).all()
        colors = np.unique(picture[::3, ::3, :3].reshape(-1, 3), axis=0)
        assert len(colors) > 50


def test_pictures_of_some_scenarios_only(rows):
    sweep = [r for r in rows if r.scenario == "needles"]
    assert [name for name, _ in pictures(sweep)] == ["breaking_points", "sweeps_1"]
    of_map = [r for r in rows if r.scenario == MAPS[0].name]
    assert [name for name, _ in pictures(of_map)] == [f"map_{MAPS[0].name}"]


def test_a_scenario_of_ones_own(rows):
    """What is not among the scenarios has no title, and is shown by its name."""
    own = [replace(r, scenario="own") for r in rows if r.scenario == "needles"]
    assert [name for name, _ in pictures(own)] == ["breaking_points", "sweeps_1"]
    assert to_dict(own)["rows"][0]["scenario"] == "own"


def test_without_matplotlib_all_else_is_written(rows, tmp_path, monkeypatch):
    (tmp_path / "breaking_points.png").write_text("of an earlier run")
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(MissingLibraryError, match="Matplotlib"):
        write(tmp_path, rows)
    assert {path.name for path in tmp_path.iterdir()} == {"extremes.txt", "extremes.json"}


def test_what_crosses_too_many_triangles_is_not_shown_as_what_holds(rows):
    """A method that loses no ray but doubles some has a colour of its own."""
    some = [replace(r, missed=0) for r in rows if r.scenario == "needles"]
    holds = [replace(r, doubled=0) for r in some]

    def shown(rows, color):
        rgb = [int(color[k : k + 2], 16) for k in (1, 3, 5)]
        return (extreme_plots.breaking_picture(rows)[..., :3] == rgb).all(axis=-1).sum()

    assert shown(some, extreme_plots.DOUBLED) > 2 * shown(holds, extreme_plots.DOUBLED)
    assert shown(holds, extreme_plots.NEVER) > 2 * shown(some, extreme_plots.NEVER)


@pytest.mark.parametrize("seen", [0, 100])
def test_grey_is_explained_only_where_there_is_grey(seen, rows, monkeypatch):
    said = []
    monkeypatch.setattr(plots, "headline", lambda figure, text: said.append(text))
    some = [replace(r, seen=seen, missed=0, doubled=0) for r in rows if r.scenario == MAPS[0].name]
    extreme_plots.map_picture(MAPS[0], [*some[:-1], replace(some[-1], seen=100)])
    assert ("Grey" in said[0]) == (seen == 0)


def row(scale, missed=0, wrong=0, doubled=0, method="watertight"):
    return ExtremesRow("tiny", scale, method, "float64", 200, missed, doubled, wrong, 0)


def test_tables():
    rows = [row(1.0), row(1e-9, doubled=1, wrong=3), row(1e-20, missed=200)]
    rows += [row(s, method="certified") for s in (1.0, 1e-9, 1e-20)]
    lines = breaking_table(rows).splitlines()
    assert lines[-1].split() == ["tiny", "scale", "1e-9", "+1e-9", "."]
    lines = table(rows).splitlines()
    assert [line.split() for line in lines[-3:]] == [
        ["1", ".", "."],
        ["1e-9", "1.5", "+0.5", "."],
        ["1e-20", "100", "."],
    ]
    assert "Tiny (scale): A sphere" in table(rows)
    assert len({len(line) for line in (*lines[-3:], lines[4])}) == 1


def test_tables_of_all(rows):
    text = table(rows)
    assert all(s.explanation in text for s in SCENARIOS)
    assert not any(m.title in text for m in MAPS)
    lines = breaking_table([replace(r, doubled=0) for r in rows]).splitlines()
    assert [line.split()[0] for line in lines[-len(SCENARIOS) :]] == [s.name for s in SCENARIOS]
    assert all(line.endswith(" .") for line in lines[-len(SCENARIOS) :])
