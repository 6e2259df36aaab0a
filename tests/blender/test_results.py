"""The latest comparison and its three images: ours are written again, the user's never."""

from __future__ import annotations

import bpy
import numpy as np
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.results import Kind

PICTURE = np.ones((4, 6, 4), np.float32)


def named():
    return sorted(i.name for i in bpy.data.images)


def test_an_image_of_ours_is_written_again():
    first = results.show(results.TRACED, PICTURE)
    again = results.show(results.TRACED, 0.5 * np.ones((8, 3, 4), np.float32))
    assert again == first and tuple(again.size) == (3, 8) and named() == [results.TRACED]
    assert again.pixels[0] == 0.5


def test_an_image_of_the_users_is_left_alone(tmp_path):
    own = bpy.data.images.new(results.TRACED, 2, 2, float_buffer=True)
    own.pixels.foreach_set(np.full(16, 0.25, np.float32))
    for _ in range(3):
        results.show(results.TRACED, PICTURE)
    assert len(named()) == 2 and own.pixels[0] == 0.25


def test_an_image_that_the_user_saved_is_the_users(tmp_path):
    saved = results.show(results.TRACED, PICTURE)
    saved.filepath_raw, saved.file_format = str(tmp_path / "kept.exr"), "OPEN_EXR"
    saved.save()
    saved.source = "FILE"
    for _ in range(3):
        assert results.show(results.TRACED, 0 * PICTURE) != saved
    assert len(named()) == 2 and saved.pixels[0] > 0.99


def test_another_file_has_no_result(build, compare):
    build.scene()
    build.solids()
    build.corner_camera()
    results.keep_comparison(bpy.context, compare())
    assert results.latest(Kind.COMPARISON, bpy.context.scene)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert results.latest(Kind.COMPARISON, bpy.context.scene) is None
