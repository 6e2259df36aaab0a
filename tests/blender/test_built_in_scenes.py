"""The scenes that students are judged on are what the sample scenes export to."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
from reference_tracer.blender.compare import export_open_file
from reference_tracer.commands.judge import built_in

PROJECT = Path(__file__).parents[2]
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
    assert camera.orthographic == other.orthographic
    np.testing.assert_allclose(camera.world_from_camera, other.world_from_camera, atol=1e-6)
    assert vars(camera.window) == pytest.approx(vars(other.window))
    for mine, theirs in zip(stored.meshes, fresh.meshes, strict=True):
        np.testing.assert_allclose(mine.vertices, theirs.vertices, atol=1e-6)
        assert (mine.triangles == theirs.triangles).all()
    for mine, theirs in zip(stored.instances, fresh.instances, strict=True):
        np.testing.assert_allclose(mine.world_from_object, theirs.world_from_object, atol=1e-6)
        np.testing.assert_allclose(mine.colors, theirs.colors, atol=1e-6)
    assert len(stored.planes) == len(fresh.planes) == (name == "exercise_plane")
