"""`reftrace trade` on files that need no Blender."""

from __future__ import annotations

import json

import pytest
from reference_tracer.cli.main import main
from reference_tracer.cli.parser import AGREE
from reference_tracer.files.scenes import save_scene

pytestmark = pytest.mark.slow

TRADE = ["--set", "width=12", "--samples", "2"]


def test_trade(small_ball, tmp_path, capsys):
    assert main(["trade", small_ball, *TRADE, "--out", str(tmp_path / "new" / "out")]) == AGREE
    said = capsys.readouterr().out
    lines = said.splitlines()
    assert "wrong pixels" in lines[0] and "12 × 7, 2 × 2 rays" in said
    assert "certified, proven to have none" in said and lines[-1].startswith("written to")
    written = sorted(p.name for p in (tmp_path / "new" / "out").iterdir())
    assert written == ["tradeoff.html", "tradeoff.json", "tradeoff.txt"]
    held = json.loads((tmp_path / "new" / "out" / "tradeoff.json").read_text(encoding="utf-8"))
    assert held["scene"] == "small.ply" and max(r["samples"] for r in held["rows"]) == 2
    assert held["advice"] in said


def test_trade_takes_the_width_of_a_scene(make, tmp_path, capsys):
    """A scene has its own camera, but how wide its picture is can be chosen."""
    save_scene(tmp_path / "s.npz", make.scene(make.camera(10, 6), make.quad(-9, 0, -9, 9, -2)))
    assert main(["trade", str(tmp_path / "s.npz"), "--samples", "1"]) == AGREE
    assert "10 × 6 " in capsys.readouterr().out
    assert main(["trade", str(tmp_path / "s.npz"), "--samples", "1", "--set", "width=20"]) == AGREE
    assert "20 × 12 " in capsys.readouterr().out
