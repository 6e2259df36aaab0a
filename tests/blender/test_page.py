"""The button that writes the latest comparison as a page; and that every comparison leaves one."""

from __future__ import annotations

import json
import re

import bpy
import pytest
from reference_tracer.blender.ui import results, studies
from reference_tracer.blender.ui.long_work import LongWork
from reference_tracer.comparison import extras
from reference_tracer.study import extremes, tradeoff
from reference_tracer.study.scenarios.sweeps import SCENARIOS
from reference_tracer.tracer.progress import result_of

from ..scenarios import quick


def held(folder):
    """Return the JSON in a folder's page."""
    text = (folder / "page.html").read_text(encoding="utf-8")
    [data] = re.findall(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)
    return json.loads(data)


@pytest.fixture
def solids(build):
    build.room()


def open_page(folder):
    return bpy.ops.reference_tracer.open_page(directory=str(folder), open_browser=False)


def test_there_is_no_page_without_a_comparison(solids, tmp_path):
    assert not bpy.ops.reference_tracer.open_page.poll()
    with pytest.raises(RuntimeError):
        open_page(tmp_path)


def test_the_page_is_of_the_latest_comparison(solids, compare, tmp_path):
    comparison = compare()
    result_of(results.keep_comparison(comparison, bpy.context.scene.session_uid))
    before = {name: len(getattr(bpy.data, name)) for name in ("images", "scenes", "objects")}
    assert open_page(tmp_path / "new") == {"FINISHED"}
    assert [p.name for p in (tmp_path / "new").iterdir()] == ["page.html"]
    found = held(tmp_path / "new")
    assert found["comparison"] == json.loads(json.dumps(comparison.to_dict()))
    assert [p["id"] for p in found["pictures"]] == ["traced", "blender", "literal"]
    assert found["trade"] is found["extremes"] is None
    assert before == {name: len(getattr(bpy.data, name)) for name in before}


def test_the_page_has_what_was_measured_besides(solids, compare, tmp_path):
    comparison = compare()
    result_of(results.keep_comparison(comparison, bpy.context.scene.session_uid))
    name = bpy.context.scene.name
    trade = result_of(tradeoff.measure(comparison.scene, 12, 2, name))
    studies.keep_trade(trade, bpy.context.scene.session_uid)
    studies.keep_extremes(result_of(extremes.measure(quick(SCENARIOS[:1]), 40)))
    assert open_page(tmp_path) == {"FINISHED"}
    found = held(tmp_path)
    assert found["trade"]["advice"] == trade.advice and len(found["trade"]["plot"]["panels"]) == 2
    assert found["extremes"]["breaking_points"] and len(found["extremes"]["plot"]["panels"]) == 1


def test_the_page_has_the_studies_of_its_own_scene(solids, compare, tmp_path, monkeypatch):
    """Also if the window shows another one by the time that it is written."""
    own = bpy.context.scene.session_uid
    comparison = compare()
    result_of(results.keep_comparison(comparison, own))
    trade = result_of(tradeoff.measure(comparison.scene, 12, 2, "Scene"))
    studies.keep_trade(trade, own)
    find = extras.extras

    def elsewhere(*args):
        bpy.context.window.scene = bpy.data.scenes.new("Other")
        return (yield from find(*args))

    monkeypatch.setattr(extras, "extras", elsewhere)
    assert open_page(tmp_path) == {"FINISHED"}
    assert held(tmp_path)["trade"]["advice"] == trade.advice


def test_it_waits_for_other_work(solids, compare, monkeypatch):
    result_of(results.keep_comparison(compare(), bpy.context.scene.session_uid))
    assert bpy.ops.reference_tracer.open_page.poll()
    monkeypatch.setattr(LongWork, "running", "Trace and Compare")
    assert not bpy.ops.reference_tracer.open_page.poll()
