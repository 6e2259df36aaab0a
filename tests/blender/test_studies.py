"""The operators of the two studies, as a script calls them: files, pictures, the user's scene."""

from __future__ import annotations

import json
from pathlib import Path
from urllib.parse import urlparse
from urllib.request import url2pathname

import bpy
import pytest
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.cli import in_blender
from reference_tracer.study import extremes
from reference_tracer.tracer.settings import UNPROVEN_SETTINGS

from .scenes import save
from .test_unchanged import differences, state

TRADE_FILES = {"tradeoff.txt", "tradeoff.json", "tradeoff.html"}
ADDON = Path(results.__file__).parents[1]
SMALL = {"width": 16, "samples": 1}
FEW = {"scenario": "closed_fan", "rays": 12}


@pytest.fixture
def solids(build, tmp_path):
    scene = build.room(64, 36, lens=40)
    save(tmp_path / "scene.blend")
    bpy.context.preferences.is_dirty = False
    return scene


def page_of(kind, scene):
    """What the panel's button opens."""
    address = urlparse(results.latest(kind, scene).page)
    assert address.scheme == "file"
    path = Path(url2pathname(address.path))
    assert ADDON not in path.parents
    return path.read_text(encoding="utf-8")


def test_trade_shows_its_plot_and_changes_nothing(solids, tmp_path):
    """And its files are those of `reftrace`."""
    before = state()
    out = tmp_path / "out"
    assert bpy.ops.reference_tracer.trade(directory=str(out), **SMALL) == {"FINISHED"}
    found = results.latest(Kind.TRADE, solids)
    assert len(found.content.whole) == len(UNPROVEN_SETTINGS) + 1  # and certified
    assert found.content.whole[0].width == 16
    assert found.lines == (found.content.advice,)
    assert differences(before, state()) == []
    assert {p.name for p in out.iterdir()} == TRADE_FILES
    plot = (out / "tradeoff.html").read_text(encoding="utf-8")
    assert plot == page_of(Kind.TRADE, solids) and found.content.scene in plot
    written = json.loads((out / "tradeoff.json").read_text(encoding="utf-8"))
    assert written["scene"] == solids.name
    assert written["advice"] == found.content.advice
    assert {row["width"] for row in written["rows"]} == {4, 8, 16}


def test_extremes_shows_its_pictures_and_changes_nothing(solids):
    before = state()
    assert bpy.ops.reference_tracer.extremes(**FEW) == {"FINISHED"}
    points = extremes.breaking_points(results.latest(Kind.EXTREMES, solids).content)
    assert {p.scenario for p in points} == {"closed_fan"}
    held = [p for p in points if p.method == "certified"]
    assert [(p.lost, p.doubled) for p in held] == [(None, None)]
    assert "Closed fan" in page_of(Kind.EXTREMES, solids)
    assert differences(before, state()) == []


@pytest.mark.parametrize(("run", "options"), [("trade", SMALL), ("extremes", FEW)])
def test_a_folder_that_cannot_be_written_is_known_before_the_work(run, options, solids, tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(RuntimeError, match="is a file"):
        getattr(bpy.ops.reference_tracer, run)(directory=str(tmp_path / "file"), **options)


def test_the_commands(solids, tmp_path, capsys):
    out = tmp_path / "out"
    trade = ["trade", "--out", str(out), "--set", "width=16", "--samples", "1"]
    assert in_blender.run(trade) == 0
    assert {p.name for p in out.iterdir()} == TRADE_FILES
    assert "float32" in capsys.readouterr().out
