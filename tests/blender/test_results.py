"""The latest comparison and its images: ours are written again, the user's never."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.ui import results
from reference_tracer.blender.ui.differing import texts_of
from reference_tracer.blender.ui.operators import REFERENCE_TRACER_OT_compare
from reference_tracer.blender.ui.results import Kind
from reference_tracer.causes.cause import AGREE, UNEXPLAINED
from reference_tracer.causes.checks.edges import EDGE
from reference_tracer.tracer.progress import result_of

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


def test_the_regions_that_differ_are_listed_and_select_what_is_seen(build, compare):
    build.scene()
    build.solids()
    build.corner_camera()
    own = compare()
    cause = own.causes.cause.copy()
    cause[:] = AGREE
    cause[2:6, 3:5] = cause[2, 40] = EDGE
    told = replace(own, causes=replace(own.causes, cause=cause))
    found = result_of(results.keep_comparison(told)).regions
    assert [r.pixels for r in found] == [8, 1]
    cause[20, 40:43] = UNEXPLAINED  # then these alone are
    found = result_of(results.keep_comparison(told)).regions
    assert [(r.left, r.bottom, r.pixels) for r in found] == [(40, 20, 3)]
    assert bpy.ops.reference_tracer.frame_region(number=0) == {"FINISHED"}
    assert not bpy.context.selected_objects  # it moves the picture alone
    assert bpy.ops.reference_tracer.view_region(number=0) == {"FINISHED"}
    assert [o.name for o in bpy.context.selected_objects] == [found[0].objects[0]]
    with pytest.raises(RuntimeError, match="has 1 regions"):
        bpy.ops.reference_tracer.frame_region(number=1)
    assert not bpy.ops.reference_tracer.show_image.poll()  # there is no editor
    assert texts_of(found[0])[0] == f"3 px unexplained (40, 20): {found[0].objects[0]}"
    cause[20, 40:43] = AGREE
    cause[-2:, :2] = EDGE  # where both sides see nothing
    found = result_of(results.keep_comparison(told)).regions
    height = len(cause)
    assert [texts_of(r)[0] for r in found][1:2] == [f"4 px at edges (0, {height - 2}): Background"]


def test_another_file_has_no_result(build, compare):
    build.scene()
    build.solids()
    build.corner_camera()
    result_of(results.keep_comparison(compare()))
    assert results.latest(Kind.COMPARISON, bpy.context.scene)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert results.latest(Kind.COMPARISON, bpy.context.scene) is None


def test_a_file_that_was_saved_while_an_image_was_shown_has_none_when_it_is_opened(tmp_path):
    """Blender stores that there was an image, and not what was in it; what was saved stays."""
    shown = results.show(results.DIFFERENCE, PICTURE)
    own = results.show(results.TRACED, PICTURE)
    own.pack()  # as by "Save 1 modified image"
    shown.use_fake_user = own.use_fake_user = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    assert named() == [results.TRACED]
    assert bpy.data.images[results.TRACED].pixels[0] == 1.0


def test_a_comparison_is_told_in_another_scene_too(build, compare, capsys):
    """The user may have gone there, or renamed the scene, while it was at work."""
    build.scene()
    build.solids()
    build.corner_camera()
    found = compare(identity=False)
    result_of(results.keep_comparison(found))
    context = SimpleNamespace(scene=bpy.data.scenes.new("Other"))
    told = REFERENCE_TRACER_OT_compare.finish(None, context, found)
    assert told == ("INFO", found.lines()[0])
    assert found.lines()[0] in capsys.readouterr().out
