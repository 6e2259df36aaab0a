"""The self-check on Blender's own pictures, and what a table of every engine cannot have."""

from __future__ import annotations

import json

import bpy
import pytest
from reference_tracer.cli import in_blender

from .scenes import save

LONG = (pytest.param(n, marks=pytest.mark.torture) for n in ("geometry_nodes", "shifted_room"))


@pytest.mark.parametrize("name", ["exercise_perspective", *LONG])
def test_sample_scenes_miss_no_fault(name, opened, compare):
    opened(name, 64)
    found = compare(self_check=True)
    results = {row.name: row.result for row in found.self_check}
    assert found.verdict == "agree" and "missed" not in results.values()
    assert sum(result == "caught" for result in results.values()) >= 12
    assert results["flipped_winding"] == "cannot be seen here"


@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_the_frame_after(judge, build, compare):
    scene = build.room(48, 27, lens=40)
    cube = bpy.data.objects["Red"]
    for frame, x in ((1, -1.1), (2, -0.7)):
        cube.location.x = x
        cube.keyframe_insert("location", frame=frame)
    scene.frame_set(1)
    found = compare(self_check=True, judge=judge)
    [row] = [row for row in found.self_check if row.name == "wrong_frame"]
    assert row.result == "caught" and found.verdict == "agree"
    assert scene.frame_current == 1 and cube.location.x == pytest.approx(-1.1)


@pytest.fixture
def saved(build, tmp_path):
    scene = build.room(64, 36, lens=40)
    save(tmp_path / "scene.blend")
    return scene


def test_on_request_of_the_command_and_the_panel(saved, tmp_path, capsys):
    assert in_blender.run(["compare", "--self-check", "--out", str(tmp_path / "out")]) == 0
    assert "faults that can be seen here are caught" in capsys.readouterr().out
    found = json.loads((tmp_path / "out/comparison.json").read_text(encoding="utf-8"))
    assert len(found["self_check"]) > 15
    saved.reference_tracer.self_check = True
    bpy.ops.reference_tracer.compare(directory=str(tmp_path / "button"))
    found = json.loads((tmp_path / "button/comparison.json").read_text(encoding="utf-8"))
    assert len(found["self_check"]) > 15


def test_no_engine_at_all_is_an_error(saved, tmp_path, capsys):
    saved.camera = None
    assert in_blender.run(["compare", "--judge", "all", "--out", str(tmp_path / "out")]) == 4
    assert "has no camera" in capsys.readouterr().err
