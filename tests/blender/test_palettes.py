"""The colours of a comparison: they tell objects apart, and the user's scene keeps its own."""

from __future__ import annotations

import json

import bpy
import numpy as np
import pytest
from reference_tracer.blender.jobs.against import gather_against
from reference_tracer.blender.jobs.compare import gather_case
from reference_tracer.cli import in_blender
from reference_tracer.comparison.comparing import compared
from reference_tracer.files import images
from reference_tracer.pictures import colors_file
from reference_tracer.pictures.palette import By
from reference_tracer.pictures.picture import Picture
from reference_tracer.report.lines import describe
from reference_tracer.scene import GREY, SceneError
from reference_tracer.tracer.progress import result_of

from .scenes import save


def principled(build, name, *rgb):
    """Return a material as users make it: its colour is in the Principled BSDF alone."""
    material = build.material(name, *GREY[:3])
    material.use_nodes = True
    node = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    node.inputs["Base Color"].default_value = (*rgb, 1.0)
    return material


@pytest.fixture
def ordinary(build):
    """Three boxes, whose colours the viewport does not show."""
    scene = build.scene()
    for k, name in enumerate(("Left", "Middle", "Right")):
        material = principled(build, name, 0.2 + 0.3 * k, 0.1, 0.6)
        build.cube(name, 0.9, location=(k - 1, 0.1 * k, 0), material=material)
    build.camera(location=(0.3, -0.4, 4), rotation=(0.1, 0.05, 0))
    return scene


def colors_of(found):
    """Return the colours that are traced, by the objects' names."""
    scene = found.scene
    return {scene.objects[i.object]: tuple(i.colors[0, :3].tolist()) for i in scene.instances}


def commonest(picture):
    """Return the two commonest colours of objects; the same twice where there is one."""
    found, counts = np.unique(picture[picture[..., 3] > 0], axis=0, return_counts=True)
    ordered = found[np.argsort(-counts)]
    return ordered[0], ordered[min(1, len(ordered) - 1)]


def exchanged(picture):
    """Show the two commonest colours in one another's place."""
    first, second = commonest(picture)
    here, there = ((picture == c).all(axis=-1) for c in (first, second))
    picture[here], picture[there] = second, first
    return picture


@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_an_ordinary_scene_has_a_color_for_each_object(ordinary, compare, judge):
    found = compare(judge=judge)
    assert found.verdict == "agree"
    assert len(set(colors_of(found).values())) == 3
    [note] = found.manifest.notes
    assert "each object is shown in a clear colour of its own" in note and "tell 'Left'" in note
    assert f"  note: {note}" in found.manifest.lines()
    assert found.to_dict()["blender"]["settings"]["colors"] == "object"
    plain = compare(judge=judge, colors=By.VIEWPORT)
    assert set(colors_of(plain).values()) == {tuple(np.float32(GREY[:3]).tolist())}
    assert plain.manifest.notes == () and plain.verdict == "agree"


@pytest.mark.parametrize("identity", [True, False])
def test_objects_that_are_exchanged_are_found(ordinary, compare, shown_otherwise, identity):
    """In one grey they were not."""
    shown_otherwise(exchanged)
    assert compare(colors=By.VIEWPORT, identity=identity).verdict == "agree"
    found = compare(identity=identity)
    assert found.verdict == "differences" and found.counts.unexplained > 100


def test_what_is_drawn_as_it_is_keeps_its_colors(ordinary, compare):
    found = compare(as_is=True)
    assert found.to_dict()["blender"]["settings"]["colors"] == "viewport"
    assert set(colors_of(found).values()) == {tuple(np.float32(GREY[:3]).tolist())}


def test_base_colors_of_materials(ordinary, build, compare):
    tree = bpy.data.materials["Middle"].node_tree
    node = next(n for n in tree.nodes if n.type == "BSDF_PRINCIPLED")
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs[0], node.inputs["Base Color"])
    build.material("Of Nothing", 1, 0, 0)
    found = compare(colors=By.MATERIAL)
    assert found.verdict == "agree"
    shown = colors_of(found)
    assert shown["Left"] == pytest.approx((0.2, 0.1, 0.6))
    assert shown["Right"] == pytest.approx((0.8, 0.1, 0.6))
    assert shown["Middle"] == pytest.approx(GREY[:3])
    [note] = found.manifest.notes
    assert note == "materials without one base colour show that of the viewport: 'Middle'"
    assert compare(colors=By.MATERIAL, judge="CYCLES").verdict == "agree"


def test_colors_that_an_animation_sets_stay(ordinary, compare):
    obj = bpy.data.objects["Left"]
    obj.color = (0.3, 0.9, 0.1, 1)
    obj.keyframe_insert("color", frame=1)
    found = compare()
    assert found.counts.unexplained == 0
    assert colors_of(found)["Left"] == pytest.approx((0.3, 0.9, 0.1))
    assert tuple(obj.color) == pytest.approx((0.3, 0.9, 0.1, 1))


def written(path, found):
    path.write_text(colors_file.text(found.scene, found.manifest.owners), encoding="utf-8")
    return colors_file.read(path)


def test_another_picture_in_colors_of_a_file(ordinary, compare, tmp_path):
    """Drawn in the palette that was written, and compared with it; in the viewport's it differs."""
    found = compare()
    given = written(tmp_path / "colors.json", found)
    shown = Picture(found.picture)
    for colors in (given, By.OBJECT, By.AUTOMATIC):
        case = gather_against(bpy.context, shown, found.case.settings, colors=colors)
        assert result_of(compared(case)).verdict == "agree"
    grey = gather_against(bpy.context, shown, found.case.settings)
    assert result_of(compared(grey)).verdict != "agree"
    hidden = bpy.data.objects["Right"]
    hidden.hide_render = True  # the picture is of before
    case = gather_against(bpy.context, shown, found.case.settings, colors=given)
    again = result_of(compared(case))
    assert any("'Right'" in line for line in describe(again)) and not again.counts.unexplained


def test_colors_of_a_file_by_material(ordinary, build, compare, tmp_path):
    left = bpy.data.objects["Left"]
    left.data.materials.append(principled(build, "Second", 0.9, 0.9, 0.1))
    left.data.polygons[5].material_index = 1
    found = compare(colors=By.MATERIAL)
    path = tmp_path / "colors.json"
    given = written(path, found)
    assert len(given.slots["Left", "Left"]) == 2
    again = compare(colors=given)
    assert again.verdict == "agree"
    np.testing.assert_array_equal(again.picture, found.picture)
    left.data.materials[1] = None
    with pytest.raises(SceneError, match="slot 1 of 'Left' has no material: give all slots"):
        compare(colors=given)
    left.data.materials[1] = bpy.data.materials["Right"]
    with pytest.raises(SceneError, match="gives material 'Right' a second colour"):
        compare(colors=given)


def test_what_the_file_lacks_or_has_too_much_is_named(ordinary, compare, tmp_path):
    path = tmp_path / "colors.json"
    written(path, compare())
    content = json.loads(path.read_text(encoding="utf-8"))
    left = content["objects"].pop(0)
    path.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(SceneError, match="no colour for 'Left' which is in the view"):
        compare(colors=colors_file.read(path))
    content["objects"].append(left | {"name": "Lft"})
    path.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(SceneError, match="'Lft', and the scene has no such object"):
        compare(colors=colors_file.read(path))


def test_the_command_line_writes_and_takes_them(ordinary, tmp_path, capsys):
    save(tmp_path / "scene.blend")
    palette, out = tmp_path / "colors.json", str(tmp_path / "out")
    assert in_blender.run(["compare", "--colors-out", str(palette)]) == 0
    alone, told = palette.read_bytes(), capsys.readouterr().out
    assert "clear colour of its own" in told and "verdict" not in told
    assert in_blender.run(["compare", "--colors-out", str(palette), "--out", out]) == 0
    assert palette.read_bytes() == alone
    case = gather_case(bpy.context, colors=By.OBJECT)
    images.save_png(tmp_path / "other.png", images.to_display(case.picture.color))
    against = "compare", "--against", str(tmp_path / "other.png"), "--out", out
    assert in_blender.run([*against, "--colors", str(palette)]) == 0
    assert in_blender.run([*against, "--colors", "viewport", "--no-diagnosis"]) != 0
    assert in_blender.run(["compare", "--frames", "1", "--out", out]) == 0
    of_frame = json.loads(next((tmp_path / "out").glob("*/comparison.json")).read_text("utf-8"))
    assert of_frame["blender"]["settings"]["colors"] == "object"
