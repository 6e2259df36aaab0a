"""`--against FILE --holds depth` and so on for a .blend: the passes of Cycles are right."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
from reference_tracer.blender import registration
from reference_tracer.cli.main import main
from reference_tracer.files import exr


@pytest.fixture
def passes(build, tmp_path):
    """A .blend, and its render by Cycles with a sample in each pixel's centre."""
    scene = build.scene(48, 27)
    build.solids()
    build.corner_camera(lens=40)
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_position = True
    layer.use_pass_object_index = layer.use_pass_cryptomatte_object = True
    for number, object_ in enumerate(scene.objects):
        object_.pass_index = number + 1
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.filter_width = 0.01
    image = scene.render.image_settings
    if hasattr(image, "media_type"):
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format, image.color_depth = "OPEN_EXR_MULTILAYER", "32"
    scene.render.filepath = str(tmp_path / "passes.exr")
    bpy.ops.render.render(write_still=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    return tmp_path


def test_the_passes_of_cycles_agree(passes, addon, capsys):
    registration.unregister()  # the command registers by itself, in a process of its own
    try:
        compare = ["compare", str(passes / "scene.blend"), "--against", str(passes / "passes.exr")]
        for kind in ("depth", "positions", "normals", "ids"):
            code = main([*compare, "--holds", kind, "--out", str(passes / kind)])
            found = json.loads((passes / kind / "comparison.json").read_text(encoding="utf-8"))
            assert code == 0 and found["pixels"]["differ"] == 0, (kind, capsys.readouterr().out)
        traced = str(passes / "traced.exr")
        assert main(["trace", str(passes / "scene.blend"), "--out", traced]) == 0
        _same_cryptomatte(passes / "passes.exr", passes / "traced.exr")
        assert main([*compare, "--holds", "distance", "--out", str(passes / "distance")]) == 2
        assert "not distances along the ray" in capsys.readouterr().out
    finally:
        registration.register()


def _same_cryptomatte(blenders, own):
    """Blender hashes names by Cryptomatte's own code: its ids are ours, bit by bit."""
    held = []
    for path, layer, letters in ((blenders, "ViewLayer.", "rg"), (own, "", "RG")):
        channels = exr.read_channels(path)
        ids, coverage = (channels[f"{layer}CryptoObject00.{letter}"] for letter in letters)
        held.append(np.where(coverage > 0.5, ids, 0).view(np.uint32))
    assert len(np.unique(held[1])) == 5 and np.array_equal(*held)
