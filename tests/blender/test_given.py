"""Images of the open file are judged, and what is wrong is put right on a copy."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.ui import blocks, properties, results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.blender.versions import set_format
from reference_tracer.tracer.progress import result_of

from .given import rendered_png, solids, told, toy

__all__ = ["rendered_png", "solids", "toy"]  # fixtures
OPS = bpy.ops.reference_tracer


def compared_with(image):
    bpy.context.scene.reference_tracer.image = image
    OPS.compare()
    return results.content(Kind.COMPARISON, bpy.context.scene)


@pytest.mark.parametrize("kind", ["of a file", "packed", "painted", "float"])
def test_an_image(kind, rendered_png, solids):
    if kind == "float":
        set_format(solids.render, "OPEN_EXR", "RGBA", "32")
    path = next(rendered_png().parent.glob("rendered.*"))
    loaded = bpy.data.images.load(str(path))
    pixels = np.empty(96 * 54 * 4, np.float32)
    loaded.pixels.foreach_get(pixels)
    own = loaded
    if kind == "packed":
        own.pack()
    elif kind != "of a file":
        own = bpy.data.images.new("Painted", 96, 54, alpha=True, float_buffer=kind == "float")
        own.pixels.foreach_set(pixels)
    found = compared_with(own)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    storage = found.case.picture.storage
    assert (storage.levels, storage.opaque) == (0 if kind == "float" else 255, False)
    assert found.case.picture.source.file == own.name


def test_a_wrong_image_is_put_right_on_a_copy(rendered_png, solids):
    camera = solids.camera
    camera.data.lens = 44.0
    path = rendered_png()
    camera.data.lens = 40.0
    found = compared_with(bpy.data.images.load(str(path)))
    assert found.verdict == "differences" and told() == ["focal_length"]
    assert OPS.show_put_right(number=0) == {"FINISHED"}
    right = found.diagnosis.told[0].frame.color
    shown = np.array(blocks.ours(blocks.PUT_RIGHT).pixels[:]).reshape(right.shape)
    assert np.array_equal(shown, right) and not np.array_equal(shown, found.frame.color)
    explained_as_shown(found, found.diagnosis.told[0].frame)
    assert OPS.copy_camera(number=0) == {"FINISHED"}
    assert OPS.activate_copy() == {"FINISHED"}
    assert solids.camera != camera and camera.data.lens == 40
    assert compared_with(solids.reference_tracer.image).verdict == "agree"
    assert blocks.ours(blocks.PUT_RIGHT) is None and not OPS.show_put_right.poll()
    with pytest.raises(RuntimeError, match="No picture of this scene's latest comparison is shown"):
        OPS.explain(x=1, y=1, source="PUT_RIGHT")


def explained_as_shown(found, right):
    """Hold that a pixel of what is put right is explained as that shows it, not as it was traced.

    Where it sees another object; and the text and the panel say which picture is meant.
    """
    y, x = np.argwhere(right.instance_index != found.frame.instance_index)[0]
    said = []
    for source, frame in ("PUT_RIGHT", right), ("COMPARISON", found.frame):
        assert OPS.explain(x=x, y=y, source=source) == {"FINISHED"}
        kept = results.latest(Kind.PIXEL, bpy.context.scene)
        assert kept.content.certified.t == frame.t[y, x]
        text = bpy.data.texts["Reference Tracer Pixel"].as_string()
        said += [kept.lines[0], text.splitlines()[0]]
    assert ["put right: the focal length is" in line for line in said] == [True, True, False, False]


def test_what_changes_no_picture_is_not_shown_put_right(rendered_png, solids):
    """Such as a tolerance."""
    solids.camera.data.lens = 44.0
    path = rendered_png()
    solids.camera.data.lens = 40.0
    found = compared_with(bpy.data.images.load(str(path)))
    same = replace(found.diagnosis.told[0], frame=found.frame)
    found = replace(found, diagnosis=replace(found.diagnosis, told=(same,)))
    assert result_of(results.keep_comparison(found, bpy.context.scene.session_uid)).put_right == {}
    with pytest.raises(RuntimeError, match="No picture shows it put right: the focal length is"):
        OPS.show_put_right(number=0)


def non_color(path):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    image.pack()
    return image


def gone(path):
    image = bpy.data.images.load(str(path))
    path.unlink()
    return image


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda path: None, "no image to compare with"),
        (
            lambda path: bpy.data.images.new("Small", 48, 27),
            "48 x 27 pixels, the traced one 96 x 54",
        ),
        (non_color, "colour space 'Non-Color'"),
        (gone, "has no file"),
    ],
    ids=["none", "size", "color space", "gone"],
)
def test_an_image_that_cannot_be_compared(make, said, rendered_png):
    with pytest.raises(RuntimeError, match=said):
        compared_with(make(rendered_png()))


def test_images_of_the_comparison_are_not_offered(solids):
    offered = solids.reference_tracer.bl_rna.properties["image"]
    assert offered.fixed_type.identifier == "Image"
    own = blocks.show("Reference Tracer Traced", np.zeros((4, 4, 4), np.float32))
    assert not properties._is_a_picture(solids.reference_tracer, own)
    assert properties._is_a_picture(solids.reference_tracer, bpy.data.images.new("Mine", 4, 4))
