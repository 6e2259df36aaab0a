"""`reftrace extremes`."""

from __future__ import annotations

import json

import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE
from reference_tracer.study import extremes

pytestmark = pytest.mark.slow


@pytest.fixture
def one_scenario(monkeypatch):
    real, some = extremes.measure, extremes.SCENARIOS[:1]
    monkeypatch.setattr(extremes, "measure", lambda rays: real(some, rays, judged=1))


@pytest.mark.usefixtures("one_scenario")
def test_extremes(tmp_path, capsys):
    assert main(["extremes", "--out", str(tmp_path / "out"), "--rays", "40"]) == AGREE
    said = capsys.readouterr().out
    assert "certified" in said and "First scale" in said
    written = {p.name for p in (tmp_path / "out").iterdir()}
    assert {"extremes.json", "extremes.txt", "extremes.html"} <= written
    held = json.loads((tmp_path / "out" / "extremes.json").read_text(encoding="utf-8"))
    assert {r["method"] for r in held["rows"]} >= {"certified", "watertight", "textbook"}
