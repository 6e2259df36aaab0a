"""The scenes that students are judged on: as the sample scenes export; right files score full."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.open_file import export_open_file
from reference_tracer.methods import Method
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.command import built_in
from reference_tracer_grading.extremes import plain
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.picture import look

from ..sampled import daily

PROJECT = Path(__file__).parents[2]
SCENES = sorted((PROJECT / "sample_scenes").glob("*.blend"))
BUILT_IN = {name: scene for name, scene, _ in built_in()}


@pytest.mark.parametrize("name", sorted(BUILT_IN))
def test_as_exported(name):
    path = PROJECT / "sample_scenes" / f"{name}.blend"
    bpy.ops.wm.open_mainfile(filepath=str(path), load_ui=False, use_scripts=False)
    fresh, _, _ = export_open_file(bpy.context)
    stored = BUILT_IN[name]
    assert stored.objects == fresh.objects and stored.triangle_count == fresh.triangle_count > 0
    camera, other = stored.camera, fresh.camera
    assert (camera.width, camera.height, camera.region) == (
        other.width,
        other.height,
        other.region,
    )
    assert camera.projection == other.projection
    np.testing.assert_allclose(camera.world_from_camera, other.world_from_camera, atol=1e-6)
    assert vars(camera.window) == pytest.approx(vars(other.window))
    for mine, theirs in zip(stored.meshes, fresh.meshes, strict=True):
        np.testing.assert_allclose(mine.vertices, theirs.vertices, atol=1e-6)
        assert (mine.triangles == theirs.triangles).all()
    for mine, theirs in zip(stored.instances, fresh.instances, strict=True):
        np.testing.assert_allclose(mine.world_from_object, theirs.world_from_object, atol=1e-6)
        np.testing.assert_allclose(mine.colors, theirs.colors, atol=1e-6)
    assert len(stored.planes) == len(fresh.planes) == (name == "exercise_plane")


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
