"""The latest comparison and its images: ours are written again, the user's never."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
import pytest
from reference_tracer.blender.ui import blocks, results
from reference_tracer.blender.ui.differing import texts_of
from reference_tracer.blender.ui.results import Kind
from reference_tracer.causes.cause import AGREE, UNEXPLAINED
from reference_tracer.causes.checks.edges import EDGE
from reference_tracer.tracer.progress import result_of

from .scenes import save

PICTURE = np.ones((4, 6, 4), np.float32)


def named():
    return sorted(i.name for i in bpy.data.images)


def test_an_image_of_ours_is_written_again():
    first = blocks.show(blocks.TRACED, PICTURE)
    users = bpy.data.textures.new("Shows it", "IMAGE")
    users.image = first
    for _ in range(3):
        again = blocks.show(blocks.TRACED, 0.5 * np.ones((8, 3, 4), np.float32))
        assert tuple(again.size) == (3, 8) and again.pixels[0] == 0.5 and not again.is_dirty
        assert named() == [blocks.TRACED] and users.image == again


def test_an_image_has_what_it_was_given_to_the_bit():
    color = np.random.default_rng(0).normal(size=(5, 7, 4)).astype(np.float32)
    color[0, :3, 0] = np.nan, np.inf, -0.0
    shown = blocks.show(blocks.TRACED, color)
    found = np.empty_like(color)
    shown.pixels.foreach_get(found.ravel())
    assert np.array_equal(found.view(np.uint32), color.view(np.uint32))


def test_an_image_of_the_users_is_left_alone(tmp_path):
    own = bpy.data.images.new(blocks.TRACED, 2, 2, float_buffer=True)
    own.pixels.foreach_set(np.full(16, 0.25, np.float32))
    for _ in range(3):
        blocks.show(blocks.TRACED, PICTURE)
    assert len(named()) == 2 and own.pixels[0] == 0.25


def test_an_image_that_the_user_saved_is_the_users(tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    saved = blocks.show(blocks.TRACED, PICTURE)
    with bpy.context.temp_override(edit_image=saved):
        bpy.ops.image.save_as()  # where it proposes to: beside the .blend
    assert Path(bpy.path.abspath(saved.filepath)) == tmp_path / blocks.TRACED
    for _ in range(3):
        again = blocks.show(blocks.TRACED, 0 * PICTURE)
    assert named() == [blocks.TRACED, f"{blocks.TRACED}.001"] and again.pixels[0] == 0
    saved.reload()
    blocks.remove(blocks.TRACED)
    assert saved.pixels[0] == 1 and not saved.is_runtime_data and not saved.get(blocks.MARK)


def test_the_regions_that_differ_are_listed_and_select_what_is_seen(build, compare):
    build.room()
    own = compare()
    cause = own.causes.cause.copy()
    cause[:] = AGREE
    cause[2:6, 3:5] = cause[2, 40] = EDGE
    told = replace(own, causes=replace(own.causes, cause=cause))
    found = result_of(results.keep_comparison(told, bpy.context.scene.session_uid)).regions
    assert [r.pixels for r in found] == [8, 1]
    cause[20, 40:43] = UNEXPLAINED  # then these alone are
    found = result_of(results.keep_comparison(told, bpy.context.scene.session_uid)).regions
    assert [(r.left, r.bottom, r.pixels) for r in found] == [(40, 20, 3)]
    assert bpy.ops.reference_tracer.frame_region(number=0) == {"FINISHED"}
    assert not bpy.context.selected_objects  # it moves the picture alone
    assert bpy.ops.reference_tracer.select_object(name=found[0].objects[0]) == {"FINISHED"}
    assert [o.name for o in bpy.context.selected_objects] == [found[0].objects[0]]
    with pytest.raises(RuntimeError, match="has 1 regions"):
        bpy.ops.reference_tracer.frame_region(number=1)
    assert not bpy.ops.reference_tracer.show_image.poll()  # there is no editor
    assert texts_of(found[0])[0] == f"3 px unexplained (40, 20): {found[0].objects[0]}"
    cause[20, 40:43] = AGREE
    cause[-2:, :2] = EDGE  # where both sides see nothing
    found = result_of(results.keep_comparison(told, bpy.context.scene.session_uid)).regions
    height = len(cause)
    assert [texts_of(r)[0] for r in found][1:2] == [f"4 px at edges (0, {height - 2}): Background"]


def test_the_result_stays_when_the_file_is_saved_and_goes_with_another(build, compare, tmp_path):
    build.room()
    result_of(results.keep_comparison(compare(), bpy.context.scene.session_uid))
    for name in ("first", "second"):
        save(tmp_path / f"{name}.blend")
        assert results.content(Kind.COMPARISON, bpy.context.scene)
    with pytest.raises(RuntimeError, match="Cannot read"):
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "missing.blend"))
    assert results.content(Kind.COMPARISON, bpy.context.scene)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert results.content(Kind.COMPARISON, bpy.context.scene) is None


def test_the_result_follows_its_scene_and_not_a_name(build, monkeypatch):
    scene = build.room()
    name, keep = scene.name, results.keep_comparison

    def renamed_before(*args):
        scene.name = "Renamed"
        return keep(*args)

    monkeypatch.setattr(results, "keep_comparison", renamed_before)
    bpy.ops.reference_tracer.compare()
    other = bpy.data.scenes.new(name)
    assert results.content(Kind.COMPARISON, scene)
    assert results.content(Kind.COMPARISON, other) is None


def test_a_file_that_is_saved_has_none_of_it(tmp_path):
    """Nor grows, whatever uses them; a picture that an older add-on's user packed stays his."""
    path = tmp_path / "saved.blend"
    packed = bpy.data.images.new("Reference Tracer Difference", 2, 2)
    packed["reference_tracer"] = packed.name
    packed.pack()
    packed.use_fake_user = True
    save(path)
    before = path.stat().st_size
    for name in (blocks.DIFFERENCE, blocks.TRACED):
        blocks.show(name, np.ones((400, 400, 4), np.float32)).use_fake_user = True
    blocks.ours(blocks.TRACED).pack()
    blocks.show_text("Reference Tracer Pixel", 1000 * "line\n").use_fake_user = True
    save(path)
    assert path.stat().st_size <= before + 100  # 100: what is packed is not of the same bytes
    bpy.ops.wm.open_mainfile(filepath=str(path))
    assert named() == ["Reference Tracer Difference"] and not bpy.data.texts
    assert blocks.ours(blocks.DIFFERENCE) is None


def test_undo_is_the_users():
    """It leaves the latest of what is shown where it is, and takes no step of its own."""
    moved = bpy.data.objects.new("Moved", None)
    bpy.context.scene.collection.objects.link(moved)
    bpy.ops.ed.undo_push(message="Add")
    editor = bpy.context.window_manager.windows[0].screen.areas[0]
    editor.type = "IMAGE_EDITOR"
    for x in (1.0, 2.0):
        editor.spaces.active.image = blocks.show(blocks.TRACED, x * PICTURE)
        blocks.show_text("Reference Tracer Pixel", f"at {x}")
        bpy.data.objects["Moved"].location.x = x
        bpy.ops.ed.undo_push(message="Move")
    for step, x in (("undo", 1.0), ("undo", 0.0), ("redo", 1.0), ("redo", 2.0)):
        getattr(bpy.ops.ed, step)()
        assert bpy.data.objects["Moved"].location.x == x
        assert named() == [blocks.TRACED] and blocks.ours(blocks.TRACED).pixels[0] == 2
        assert editor.spaces.active.image == blocks.ours(blocks.TRACED)
        [text] = bpy.data.texts
        assert text == blocks.ours(text.name) and text.as_string().strip() == "at 2.0"


def test_a_comparison_that_is_ended_while_it_is_shown_leaves_no_mixture(build, compare):
    build.room()
    first, second = compare(), compare()
    work = results.keep_comparison(second, bpy.context.scene.session_uid)
    next(work)
    work.close()
    assert not named()
    for found, then in (
        (first, first),  # complete
        (replace(first, diagnosis=None), first),  # of the same pictures
        (second, None),
    ):
        work = results.keep_comparison(found, bpy.context.scene.session_uid)
        if found is first:
            result_of(work)
        next(work, None)
        work.close()
        assert results.content(Kind.COMPARISON, bpy.context.scene) is then
        assert bool(named()) == (then is not None)


def test_a_comparison_that_fails_leaves_no_other_one_on_the_screen(build):
    build.scene()
    build.solids()
    camera = build.corner_camera()
    bpy.ops.reference_tracer.compare()
    assert blocks.ours(blocks.TRACED)
    camera.data.type = "PANO"
    with pytest.raises(RuntimeError, match="fisheye"):
        bpy.ops.reference_tracer.compare()
    assert results.content(Kind.COMPARISON, bpy.context.scene) is None and not named()
