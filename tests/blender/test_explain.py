"""Explaining a pixel of the open scene, the ray as objects, and what stays as it was."""

from __future__ import annotations

import json
from pathlib import Path

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.open_file import export_open_file
from reference_tracer.blender.ui import ray_objects, results
from reference_tracer.blender.ui.blocks import MARK
from reference_tracer.blender.ui.results import Kind
from reference_tracer.derivation import document, reproducer
from reference_tracer.derivation.candidates import gather_pixel
from reference_tracer.derivation.derivation import derive

ops = bpy.ops.reference_tracer
DOCS = Path(__file__).resolve().parents[2] / "docs"
PIXEL = {"x": 60, "y": 33}


@pytest.fixture
def suzanne(opened):
    return opened("suzanne", 120)


def latest():
    return results.latest(Kind.PIXEL, bpy.context.scene).content


def text():
    [found] = [t for t in bpy.data.texts if t.get(MARK)]
    return found.as_string()


def blocks():
    kinds = "objects", "meshes", "materials", "collections", "texts", "images", "scenes"
    return {kind: sorted(b.name_full for b in getattr(bpy.data, kind)) for kind in kinds}


def test_explain_shows_the_derivation_of_the_export(suzanne, export):
    assert ops.explain(**PIXEL) == {"FINISHED"}
    found = latest()
    scene, _ = export.render()  # what a comparison takes in background
    again = derive(scene, 60, 33, source="suzanne.blend")
    assert document.document_markdown(found) == document.document_markdown(again)
    assert found.seen.object == "Suzanne"
    assert text() == document.document_markdown(found)


def test_a_saved_text_is_the_users(suzanne, tmp_path):
    ops.explain(**PIXEL)
    own = next(t for t in bpy.data.texts if t.get(MARK))
    own.filepath, before = str(tmp_path / "mine.md"), own.as_string()
    ops.explain(x=0, y=0)
    assert own.as_string() == before and "pixel (0, 0)" in text()


def test_of_the_comparison(suzanne):
    """The picture's own scene, though something has moved since."""
    ops.compare()
    compared = results.latest(Kind.COMPARISON, bpy.context.scene).content
    for obj in bpy.data.objects:
        obj.location.x += 100 if obj.type == "MESH" else 0
    ops.explain(**PIXEL, source="COMPARISON")
    assert latest().certified.seen[0] == compared.frame.instance_index[33, 60]
    assert latest().certified.t == compared.frame.t[33, 60]
    ops.explain(**PIXEL)
    assert latest().seen is None  # now the ray meets nothing


def test_save_pixel_is_a_reproducer(suzanne, tmp_path):
    ops.explain(**PIXEL)
    path = tmp_path / "pixel.json"
    assert ops.save_pixel(filepath=str(path)) == {"FINISHED"}
    assert json.loads(path.read_text())["schema"] == reproducer.SCHEMA
    assert reproducer.text(reproducer.read(path)) == reproducer.text(latest().pixel)
    for name in ("pixel.html", "pixel.MD"):
        assert ops.save_pixel(filepath=str(tmp_path / name)) == {"FINISHED"}
        assert "pixel (60, 33)" in (tmp_path / name).read_text(encoding="utf-8")
    with pytest.raises(RuntimeError, match="must end in"):
        ops.save_pixel(filepath=str(tmp_path / "pixel.pdf"))


def test_what_cannot_be_explained_is_said(suzanne):
    with pytest.raises(RuntimeError, match="There is no pixel \\(120, 0\\)"):
        ops.explain(x=120, y=0)
    bpy.context.scene.camera = None
    with pytest.raises(RuntimeError, match="camera"):
        ops.explain(**PIXEL)
    assert results.content(Kind.PIXEL, bpy.context.scene) is None
    assert not any(t.get(MARK) for t in bpy.data.texts)


def test_draw_and_remove_leave_nothing(suzanne):
    ops.explain(**PIXEL)
    before, selected = blocks(), bpy.context.selected_objects
    for _ in range(2):  # in place of the first
        assert ops.draw_ray() == {"FINISHED"}
    drawing = bpy.data.collections[ray_objects.NAME]
    assert drawing.name in bpy.context.scene.collection.children
    names = [o.name for o in drawing.objects]
    assert {"Ray", "Hit"} <= set(names) and sum(n.startswith("s") for n in names) == 3
    assert all(o.hide_render for o in drawing.objects)
    assert bpy.context.selected_objects == selected
    assert ops.remove_ray() == {"FINISHED"}
    assert blocks() == before
    assert not ops.remove_ray.poll()


def test_what_the_user_puts_there_stays(suzanne):
    ops.explain(**PIXEL, draw_ray=True)
    drawing = bpy.data.collections[ray_objects.NAME]
    mine = bpy.data.objects.new("Mine", None)
    drawing.objects.link(mine)
    drawing.children.link(bpy.data.collections.new("My Collection"))
    mesh = drawing.objects["Hit"].data
    bpy.data.objects.new("Other", mesh)
    ops.remove_ray()
    assert drawing.objects[:] == [mine] and len(mesh.vertices) == 6
    assert drawing.children.keys() == ["My Collection"]
    assert drawing.name in bpy.context.scene.collection.children
    assert not ops.remove_ray.poll()
    ops.draw_ray()
    ops.remove_ray()
    assert drawing.objects[:] == [mine]


def test_what_is_left_of_a_deleted_collection_goes_too(suzanne):
    """Deleting a collection in the outliner moves its objects to the parent."""
    ops.explain(**PIXEL)
    before = blocks()
    ops.draw_ray()
    drawing = bpy.data.collections[ray_objects.NAME]
    for obj in list(drawing.objects):
        bpy.context.scene.collection.objects.link(obj)
    bpy.data.collections.remove(drawing)
    assert ops.remove_ray.poll() and ops.remove_ray() == {"FINISHED"}
    assert blocks() == before


def test_no_picture_has_a_ray_that_was_put_elsewhere(suzanne, compare):
    """Also where the user has put its collection into another one."""
    clean = compare()
    ops.explain(**PIXEL, draw_ray=True)
    drawing, outer = bpy.data.collections[ray_objects.NAME], bpy.data.collections.new("Outer")
    bpy.context.scene.collection.children.link(outer)
    outer.children.link(drawing)
    bpy.context.scene.collection.children.unlink(drawing)
    for obj in drawing.objects:
        obj.hide_render = False
    drawn = compare()
    np.testing.assert_array_equal(drawn.frame.color, clean.frame.color)
    np.testing.assert_array_equal(drawn.picture, clean.picture)


def test_undo_takes_the_ray_and_leaves_the_text(suzanne):
    bpy.ops.ed.undo_push(message="before")
    ops.explain("EXEC_DEFAULT", True, **PIXEL, draw_ray=True)
    assert ray_objects.NAME in bpy.data.collections
    bpy.ops.ed.undo()
    assert ray_objects.NAME not in bpy.data.collections
    assert "pixel" in text()


def test_far_away_a_drawing_keeps_its_shape(build, opened):
    """A thousand kilometres from the origin, an object's vertices are about its own origin."""
    opened("far_away", 120)
    ops.explain(x=60, y=33, draw_ray=True)
    for obj in bpy.data.collections[ray_objects.NAME].objects:
        sizes = np.abs([v.co[:] for v in obj.data.vertices])
        assert np.isfinite(sizes).all() and sizes.max() < 1e4


def test_the_inspector_needs_a_mouse(suzanne):
    with pytest.raises(RuntimeError, match="no mouse to click with"):
        ops.inspect()


def test_the_pixel_of_the_docs_is_the_sample_scenes(opened):
    """docs/pixel.json, which float32 gets wrong, is what the command there writes."""
    opened("exercise_perspective")
    scene, _, _ = export_open_file(bpy.context)
    now, stored = gather_pixel(scene, 207, 192, limit=3), reproducer.read(DOCS / "pixel.json")
    np.testing.assert_array_equal(now.direction, stored.direction)
    assert [c.object for c in now.candidates] == [c.object for c in stored.candidates]
    for own, kept in zip(now.candidates, stored.candidates, strict=True):
        np.testing.assert_allclose(own.points, kept.points, atol=1e-6)
