"""The camera certificate against Blender's own matrix, over the matrix of camera settings."""

from __future__ import annotations

from dataclasses import replace

import bpy
import pytest
from reference_tracer.blender.jobs import compare as compare_module
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.pictures.certificate import CameraMismatchError


def test_another_camera_is_refused_before_any_picture(build, monkeypatch):
    build.scene()
    build.corner_camera()
    real = compare_module.export

    def shifted(depsgraph, known=None):
        scene, manifest = real(depsgraph, known)
        window = replace(scene.camera.window, left=scene.camera.window.left * 1.1)
        return replace(scene, camera=replace(scene.camera, window=window)), manifest

    monkeypatch.setattr(compare_module, "export", shifted)
    with pytest.raises(CameraMismatchError, match="not Blender's"):
        gather_case(bpy.context)
    with pytest.raises(RuntimeError, match="not Blender's"):
        bpy.ops.reference_tracer.compare()
    assert not bpy.data.images
