"""The kit's .blend files hold what its .npz hold: exported, they are seen the same."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.open_file import export_open_file
from reference_tracer.rendering import render
from reference_tracer_conformance.kit import write_kit
from reference_tracer_conformance.scenes import kit_scenes

SAMPLE = "shift-portrait", "tall-pixels", "orthographic-shift", "sheared", "parented", "materials"


def check(scenes, folder):
    write_kit(folder, scenes)
    for kit in scenes:
        bpy.ops.wm.open_mainfile(filepath=str(folder / kit.name / "scene.blend"))
        scene, manifest, _ = export_open_file(bpy.context)
        assert not manifest.unmodelled
        names = np.array([*kit.scene.objects, ""]), np.array([*scene.objects, ""])
        own, other = render(kit.scene), render(scene)
        assert (names[0][own.object_index] == names[1][other.object_index]).all(), kit.name
        assert np.allclose(own.color, other.color, atol=1e-6), kit.name
        window, stored = vars(kit.camera.window), vars(scene.camera.window)
        assert all(np.isclose(window[k], stored[k], rtol=1e-5, atol=1e-6) for k in window)


def test_they_are_the_same_scenes(tmp_path):
    check([k for k in kit_scenes() if k.name.split("-", 1)[1] in SAMPLE], tmp_path)


@pytest.mark.torture
def test_all_of_them_are(tmp_path):
    check(kit_scenes(), tmp_path)


def test_the_whole_is_also_what_the_camera_does_not_see(tmp_path):
    """As `reftrace rays` takes it."""
    write_kit(tmp_path, [kit_scenes()[0]])
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "camera-plain" / "scene.blend"))
    bpy.data.objects["Post"].location.x += 1000
    seen, _, _ = export_open_file(bpy.context)
    whole, _, _ = export_open_file(bpy.context, whole=True)
    assert len(seen.instances) == 2 and len(whole.instances) == 3
