"""Several engines in one table: which shows the wrong object, where, and why."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.compare import engines
from reference_tracer.compare.comparison import compare
from reference_tracer.compare.engines import EngineRow
from reference_tracer.compare.picture import Picture, Source, numbered
from reference_tracer.report.engines import lines, write
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.render import render

from .cases import case_of


@pytest.fixture
def rows(room):
    """Return those of an engine that agrees, of one that lacks the box, and of one that fails."""
    names = ("Ball", "Box", "Wall")
    room = replace(room, objects=names)
    frame, owners = render(room), numbered(names, names)
    lacking = render(replace(room, instances=[i for i in room.instances if i.object != 1]))
    of_lacking = np.array([0, 2, -1], np.int32)[lacking.instance_index]

    def row(source, color, owner):
        shown = Picture(color, Source(source, "5.2.3"), owner, owners, names)
        work = compare(case_of(room, shown), frame)
        return EngineRow.of(result_of(work))

    return [
        row("workbench", frame.color, owners[frame.instance_index]),
        row("cycles", lacking.color, of_lacking),
        EngineRow("eevee", "failed", error="it cannot"),
    ]


def test_the_wrong_object_is_named_with_its_place(rows, room):
    good, bad, failed = rows
    assert good.verdict == "agree" and good.wrong == () and good.wrong_objects == 0
    assert bad.verdict == "differences" and bad.wrong_objects > 50
    assert len(bad.wrong) == 10
    first = bad.wrong[0]
    assert first["traced"] == "Box"
    assert first["cause"] == "unexplained" and first["why"] and first["triangle"] >= 0
    assert failed.pixels is None
    without = render(replace(room, instances=[i for i in room.instances if i.object != 1]))
    for wrong in bad.wrong:
        x, y = wrong["pixel"]
        behind = int(without.instance_index[y, x])
        assert wrong["shown"] == {0: "Ball", 1: "Wall", -1: "nothing"}[behind]


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
