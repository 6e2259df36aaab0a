"""The scenes that students are judged on: as the sample scenes export; right files score full."""

from __future__ import annotations

from pathlib import Path

import bpy
import pytest
from reference_tracer.blender.jobs.open_file import export_open_file
from reference_tracer.methods import Method
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.command import built_in
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.picture import look

from ..grading.conftest import plain
from ..sampled import daily
from .scenes import assert_same_scene

PROJECT = Path(__file__).parents[2]
SCENES = sorted((PROJECT / "sample_scenes").glob("*.blend"))
BUILT_IN = {name: scene for name, scene, _ in built_in()}


@pytest.mark.parametrize("name", sorted(BUILT_IN))
def test_as_exported(name):
    path = PROJECT / "sample_scenes" / f"{name}.blend"
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=False)
    fresh, _, _ = export_open_file(bpy.context)
    assert_same_scene(BUILT_IN[name], fresh)
    assert len(fresh.planes) == (name == "exercise_plane")


@pytest.mark.parametrize("path", daily(SCENES), ids=lambda p: p.stem)
def test_right_files_score_full_on_every_sample_scene(path):
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=False)
    scene, _, _ = export_open_file(bpy.context)
    subject = result_of(prepare(path.stem, scene, pixels=5000))
    for method in (Method.TEXTBOOK, Method.MOLLER_TRUMBORE):
        tally = result_of(look(subject, plain(method))).tally
        assert tally.score == 100 and tally.total > 1000
        assert tally.boundary < 0.1 * tally.total
    literal = result_of(look(subject, plain(Method.TEXTBOOK_LITERAL))).tally
    assert literal.score < 95
