"""`--against FILE --holds depth` and so on for a .blend: the passes of Cycles are right."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
from reference_tracer.files import exr

from .scenes import save


@pytest.fixture
def passes(build, tmp_path):
    """A .blend, and its render by Cycles with a sample in each pixel's centre."""
    scene = build.room(48, 27, lens=40)
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
    save(tmp_path / "scene.blend")
    return tmp_path


def test_the_passes_of_cycles_agree(passes, reftrace):
    blend, picture, traced = (passes / n for n in ("scene.blend", "passes.exr", "traced.exr"))
    for kind in ("depth", "positions", "normals", "ids", "distance"):
        out = passes / kind
        done = reftrace("compare", blend, "--against", picture, "--holds", kind, "--out", out)
        if kind == "distance":
            assert done.returncode == 2 and "not distances along the ray" in done.stdout
        else:
            found = json.loads((out / "comparison.json").read_text(encoding="utf-8"))
            assert done.returncode == 0 and found["pixels"]["differ"] == 0, done.stdout
    assert reftrace("trace", blend, "--out", traced).returncode == 0
    _same_cryptomatte(picture, traced)


def _same_cryptomatte(blenders, own):
    """Blender hashes names by Cryptomatte's own code: its ids are ours, bit by bit."""
    held = []
    for path, layer, letters in ((blenders, "ViewLayer.", "rg"), (own, "", "RG")):
        channels = exr.read_channels(path)
        ids, coverage = (channels[f"{layer}CryptoObject00.{letter}"] for letter in letters)
        held.append(np.where(coverage > 0.5, ids, 0).view(np.uint32))
    assert len(np.unique(held[1])) == 5 and np.array_equal(*held)
