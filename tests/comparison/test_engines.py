"""Several engines in one table: which shows the wrong object, where, and why."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from reference_tracer.comparison import engines
from reference_tracer.comparison.comparing import compare, trace_and_compare
from reference_tracer.comparison.engines import EngineRow
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.diagnosis.faults import EXAMPLES
from reference_tracer.manifest import Effect, Unmodelled
from reference_tracer.pictures.drawn_over import DrawnOver
from reference_tracer.pictures.identity import Owners
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.source import Source
from reference_tracer.rendering import render
from reference_tracer.report.engines import lines, write
from reference_tracer.tracer.progress import result_of

from ..cases import case_of, owners_of


@pytest.fixture
def rows(room):
    """Return those of an engine that agrees, of one that lacks the box, and of one that fails."""
    names = ("Ball", "Box", "Wall")
    room = replace(room, objects=names)
    frame = render(room)
    lacking = render(replace(room, instances=[i for i in room.instances if i.object != 1]))
    of_lacking = np.array([0, 2, -1], np.int32)[lacking.instance_index]

    def row(source, color, owner):
        shown = Picture(color, Source(source, "5.2.3"), Owners.of(names, owner, names))
        work = compare(case_of(room, shown), frame)
        return EngineRow.of(result_of(work))

    return [
        row("workbench", frame.color, owners_of(names, frame).pixels),
        row("cycles", lacking.color, of_lacking),
        EngineRow("eevee", Verdict.FAILED, error="it cannot"),
    ]


def test_the_wrong_object_is_named_with_its_place(rows, room):
    good, bad, failed = rows
    assert good.verdict == "agree" and good.wrong == () and good.wrong_objects == 0
    assert bad.verdict == "differences" and bad.wrong_objects > 50
    assert len(bad.wrong) == 10
    first = bad.wrong[0]
    assert first["traced"] == "Box"
    assert first["cause"] == "unexplained" and first["why"] and first["triangle"] >= 0
    assert failed.counts is None
    without = render(replace(room, instances=[i for i in room.instances if i.object != 1]))
    for wrong in bad.wrong:
        x, y = wrong["pixel"]
        behind = int(without.instance_index[y, x])
        assert wrong["shown"] == {0: "Ball", 1: "Wall", -1: "nothing"}[behind]


@pytest.mark.slow
def test_what_is_over_a_surface_is_named_and_what_cannot_be_judged_is_said(room):
    """Hair over the wall: the name, not its number; and what both show is what lies beneath."""
    names = ("Ball", "Box", "Wall")
    room = replace(room, objects=names)
    frame = render(room)
    owners, color = owners_of(names, frame), frame.color.copy()
    hair = owners.pixels == names.index("Wall")
    color[hair] = (0.1, 0.05, 0.0, 1)
    drawn, beneath = np.where(hair, np.int32(1), np.int32(-1)), frame.color.copy()
    beneath[~hair] = np.nan
    shown = Picture(color, Source("workbench", "5.2.3"), owners)
    shown = replace(shown, drawn=DrawnOver(drawn, beneath))
    glass = Unmodelled("Pane", "transparency", effect=Effect.NONE)
    case = case_of(room, shown, [glass, Unmodelled("Head", "hair")], self_check=True)
    row = EngineRow.of(result_of(trace_and_compare(case)))
    assert len(row.wrong) == 10
    for w in row.wrong:
        assert (w["why"], w["beneath"]) == ("hair of 'Head' changes the pixel", "hair of 'Head'")
        assert w["shown"] == w["traced"] == "Wall"
    assert row.counts.not_judged.by_feature == {"hair of 'Head'": int(hair.sum())}
    text = "\n".join(lines([row]))
    told = "hair of 'Head': not modelled: hair of 'Head' changes the pixel"
    assert f"(triangle {row.wrong[0]['triangle']}) beneath {told}" in text
    assert "in other colours" not in text and "from 0" not in text
    assert "% of this picture cannot be judged: hair of 'Head'" in text
    assert "workbench: self-check: " in text and "caught" in text
    held: Any = row.to_dict()
    assert held["not_judged"] == list(row.not_judged)
    assert [f["name"] for f in held["self_check"]] == [example.name for _, example in EXAMPLES]


def test_the_table_and_the_json(rows, tmp_path):
    text = "\n".join(lines(rows))
    assert "the tracer sees 'Box'" in text and "eevee      no picture: it cannot" in text
    assert engines.worst(rows) == "differences"
    assert engines.worst(rows[:1]) == "agree"
    assert engines.worst([rows[0], rows[2]]) == "warnings"
    write(tmp_path, rows)
    held = json.loads((tmp_path / "engines.json").read_text(encoding="utf-8"))
    assert held["schema"] == engines.SCHEMA and held["verdict"] == "differences"
    assert [row["engine"] for row in held["engines"]] == ["workbench", "cycles", "eevee"]
    assert held["engines"][1]["wrong"][0]["traced"] == "Box"
