"""What the study of numerical stability leaves in a folder."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.report import extreme_plots
from reference_tracer.report.extremes import (
    breaking_table,
    picture_names,
    pictures,
    table,
    to_dict,
    write,
)
from reference_tracer.study.extremes import ExtremesRow, breaking_points, written
from reference_tracer.study.scenarios.sweeps import BY_NAME, MAPS, SCENARIOS

from ..drawn import Plot, scale
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
    assert names == {"extremes.txt", "extremes.json", *(f"{n}.svg" for n in picture_names())}
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


@pytest.fixture(scope="module")
def drawn(rows):
    found = {name: Plot(svg) for name, svg in pictures(rows).items()}
    assert sorted(found) == sorted(picture_names())
    return found


def test_pictures_are_legible(rows, drawn):
    """Those with all scales, too, whose numbers stand closest."""
    full = [
        replace(r, scale=x)
        for s in SCENARIOS
        for r in rows
        if r.scenario == s.name
        for x in s.scales
    ]
    full += [
        replace(r, scale=x, across=row.across)
        for some in MAPS
        for r in rows
        if r.scenario == some.name
        for row in some.rows
        for x in row.scales
    ]
    for plot in (*drawn.values(), *map(Plot, pictures(full).values())):
        plot.assert_legible()
        assert plot.width == 1920 and plot.height >= 1000


def test_the_table_has_every_breaking_point_in_its_row_and_column(rows, drawn):
    plot = drawn["breaking_points"]
    cells = [e for e in plot.elements if e.tag == "rect" and e.x > 600]
    points = breaking_points(rows)
    assert len(cells) == len(points)
    for p in points:
        row = plot.text(BY_NAME[p.scenario].title).y
        over = [t.x for t in plot.texts if t.words == Method(p.method).record.words]
        [column] = [t.x for t in plot.texts if t.words == p.precision and t.x in over]
        [cell] = [t for t in plot.texts if abs(t.x - column) < 1 and abs(t.y - row) < 1]
        said = "never" if p.lost is None else written(p.lost)
        assert cell.words == said + " +" * (p.doubled is not None)


def test_every_row_of_a_sweep_is_a_mark_where_its_axes_say(rows, drawn):
    swept = [r for r in rows if r.across is None]
    marks = 0
    for plot in (drawn["sweeps_1"], drawn["sweeps_2"]):
        shown = [s for s in SCENARIOS if s.title in plot.said()]
        for s in shown:
            title = plot.text(s.title)
            near = [
                e
                for e in plot.elements
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
            for r in (r for r in swept if r.scenario == s.name):
                name = f"{Method(r.method).record.words}, {r.precision}, {written(r.scale)}: "
                [m] = [m for m in found if m.words.startswith(name)]
                assert m.x == pytest.approx(along[written(r.scale)], abs=0.1)
                assert y(m.y) == pytest.approx(100 * r.share, abs=0.1)
                assert (m.attributes["fill"] == "white") == (r.precision == "float32")
    assert marks == len(swept)


def test_every_row_of_a_map_is_a_cell(rows, drawn):
    for some in MAPS:
        of_map = [r for r in rows if r.scenario == some.name]
        cells = drawn[f"map_{some.name}"].titled("rect")
        assert len(cells) == len(of_map)
        names = [f"{written(r.scale)}, {written(r.across)}: {100 * r.share:.0f}" for r in of_map]
        assert all(any(c.words.startswith(name) for c in cells) for name in names)
        colors = {c.attributes["fill"] for c in cells}
        assert {extreme_plots.NEVER, extreme_plots.UNSEEN} < colors


def test_pictures_of_some_scenarios_only(rows):
    sweep = [r for r in rows if r.scenario == "needles"]
    assert list(pictures(sweep)) == ["breaking_points", "sweeps_1"]
    of_map = [r for r in rows if r.scenario == MAPS[0].name]
    assert list(pictures(of_map)) == [f"map_{MAPS[0].name}"]


def test_a_scenario_of_ones_own(rows):
    """What is not among the scenarios has no title, and is shown by its name."""
    own = [replace(r, scenario="my <own>") for r in rows if r.scenario == "needles"]
    assert list(pictures(own)) == ["breaking_points", "sweeps_1"]
    assert to_dict(own)["rows"][0]["scenario"] == "my <own>"
    assert Plot(pictures(own)["sweeps_1"]).text("my <own>")


def test_what_crosses_too_many_triangles_is_not_shown_as_what_holds(rows):
    """A method that loses no ray but doubles some has a colour of its own."""
    some = [replace(r, missed=0) for r in rows if r.scenario == "needles"]
    holds = [replace(r, doubled=0) for r in some]

    def shown(rows, color):
        found = Plot(pictures(rows)["breaking_points"]).elements
        return sum(e.attributes.get("fill") == color for e in found) - 1  # in the key

    assert shown(some, extreme_plots.DOUBLED) == 3 == shown(holds, extreme_plots.NEVER)
    assert shown(holds, extreme_plots.DOUBLED) == 0 == shown(some, extreme_plots.NEVER)


@pytest.mark.parametrize("seen", [0, 100])
def test_grey_is_explained_only_where_there_is_grey(seen, rows):
    some = [replace(r, seen=seen, missed=0, doubled=0) for r in rows if r.scenario == MAPS[0].name]
    held = extreme_plots.map_picture(MAPS[0], [*some[:-1], replace(some[-1], seen=100)])
    assert ("nothing to see" in Plot(held).said()) == (seen == 0)


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
