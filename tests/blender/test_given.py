"""Pictures that no judge of ours drew: of an engine that is registered, rendered, or an image."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np
import pytest
from reference_tracer.blender.drawing.engines import others
from reference_tracer.blender.drawing.judges import judge_named
from reference_tracer.blender.jobs import engines
from reference_tracer.blender.reading import rendered
from reference_tracer.blender.ui import properties, results
from reference_tracer.blender.ui.results import Kind
from reference_tracer.blender.versions import set_format
from reference_tracer.cli import in_blender
from reference_tracer.comparison.engines import EngineRow
from reference_tracer.pictures.palette import By
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import result_of

from .toy_engine import ToyEngine

OPS = bpy.ops.reference_tracer


@pytest.fixture
def toy(monkeypatch):
    """Register the engine; its faults are put back."""
    for name in ("offset", "left_out", "is_opaque"):
        monkeypatch.setattr(ToyEngine, name, getattr(ToyEngine, name))
    bpy.utils.register_class(ToyEngine)
    yield ToyEngine
    bpy.utils.unregister_class(ToyEngine)


@pytest.fixture
def solids(build):
    scene = build.scene(96, 54, "OBJECT")
    build.solids()
    for obj, rgb in zip(
        ("Floor", "Red", "Green", "Blue"),
        ((0.3, 0.3, 0.3), (0.8, 0.1, 0.1), (0.1, 0.7, 0.2), (0.1, 0.2, 0.9)),
        strict=True,
    ):
        bpy.data.objects[obj].color = (*rgb, 1)
    build.corner_camera(lens=40)
    return scene


def told():
    """Return the names of the faults that the latest comparison tells."""
    diagnosis = results.content(Kind.COMPARISON, bpy.context.scene).diagnosis
    return [t.fault.name for t in diagnosis.told] if diagnosis else []


def test_an_engine_that_is_right_agrees(toy, solids):
    solids.reference_tracer.judge = "ENGINE"
    solids.reference_tracer.engine = "TOY_TRACER"
    engine, names = solids.render.engine, set(bpy.data.objects.keys())
    OPS.compare()
    found = results.content(Kind.COMPARISON, solids)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    assert (found.frame.instance_index >= 0).mean() > 0.3
    assert found.case.picture.source.name == "toy_tracer"
    assert "'Toy Tracer's render'" in found.lines()[0]
    assert found.case.picture.sampling.renderer.name == "rays"
    assert (solids.render.engine, set(bpy.data.objects.keys())) == (engine, names)


def test_a_half_pixel_fault_of_an_engine_is_named(toy, solids):
    toy.offset = (0.5, 0.0)
    solids.reference_tracer.judge = "ENGINE"
    solids.reference_tracer.engine = "toy_tracer"
    OPS.compare()
    found = results.content(Kind.COMPARISON, solids)
    assert found.verdict == "differences" and found.counts.unexplained > 20
    assert told() == ["pixel_offset"]
    assert found.diagnosis.told[0].guess.values == pytest.approx((0.5, 0), abs=0.02)


def test_another_fault_has_another_name(toy, solids):
    toy.left_out = "Green"
    solids.reference_tracer.judge = "ENGINE"
    solids.reference_tracer.engine = "TOY_TRACER"
    OPS.compare()
    [found] = results.content(Kind.COMPARISON, solids).diagnosis.told
    assert found.guess.object == "Green" and found.fault.name != "pixel_offset"
    assert OPS.select_finding(number=0) == {"FINISHED"}
    assert bpy.context.selected_objects == [bpy.data.objects["Green"]]


def test_only_what_is_registered_is_a_judge(toy, solids, compare):
    assert others()["toy_tracer"].label == "Toy Tracer" and "cycles" not in others()
    assert judge_named("Toy_Tracer", background=True).engine == "TOY_TRACER"
    with pytest.raises(SceneError, match=r"no judge 'TOY'.*workbench, cycles, eevee, toy_tracer"):
        compare(judge="TOY")
    bpy.utils.unregister_class(toy)
    try:
        assert others() == {}
        with pytest.raises(SceneError, match="no judge 'TOY_TRACER'"):
            compare(judge="TOY_TRACER")
    finally:
        bpy.utils.register_class(toy)


def test_all_engines_are_those_of_add_ons_too(toy, solids, monkeypatch):
    monkeypatch.setattr(engines, "JUDGES", {"workbench": engines.JUDGES["workbench"]})
    for render, said in (
        (toy.render, ""),
        (begins, "Toy Tracer made no picture: see the console."),
    ):
        monkeypatch.setattr(toy, "render", render)
        OPS.compare_all()
        found = results.content(Kind.ENGINES, solids)
        assert [row.engine for row in found] == ["workbench", "toy_tracer"]
        assert [row.error for row in found] == ["", said]
        assert [row.verdict for row in found] == ["agree", "failed" if said else "agree"]


@pytest.mark.parametrize("own", [False, True])
def test_an_engine_that_does_not_show_the_colors_is_told(own, toy, solids, monkeypatch, compare):
    """It has a light of its own, or only one wrong colour: that is a fault, not another palette."""
    real = toy.triangles

    def lit(self, depsgraph):
        for number, (corners, rgb) in enumerate(real(self, depsgraph)):
            wrong = own or number == 0
            yield corners, 0.5 * np.array(rgb) + 0.01 * (number % 7) if wrong else rgb

    monkeypatch.setattr(toy, "triangles", lit)
    found = compare(judge="TOY_TRACER", diagnose=False)
    assert found.verdict == "differences"
    told = [note for note in found.manifest.notes if "none of the colours" in note]
    assert len(told) == own
    assert [line for line in EngineRow.of(found).not_judged if "none of" in line] == told


def test_random_colors_of_instances_are_refused(toy, build, compare):
    """An engine would give them the colour of the object that instances them."""
    build.scene(color_type="RANDOM")
    build.camera()
    build.square(size=1)
    alone = {"judge": "TOY_TRACER", "colors": By.VIEWPORT, "diagnose": False}
    assert compare(**alone).verdict == "agree"
    kit = build.collection("Kit", build.square("Part", 1, link=False))
    instancer = build.empty("Instancer", location=(1.5, 0, 0))
    instancer.instance_type, instancer.instance_collection = "COLLECTION", kit
    with pytest.raises(SceneError, match="Toy Tracer cannot draw the viewport's random colours"):
        compare(**alone)
    assert compare(judge="TOY_TRACER", colors=By.OBJECT, diagnose=False).verdict == "agree"


def raises(self, depsgraph):
    raise ValueError("a fault of the engine")


def begins(self, depsgraph):
    self.begin_result(0, 0, 96, 54)


def begins_and_raises(self, depsgraph):
    begins(self, depsgraph)
    raises(self, depsgraph)


@pytest.mark.parametrize(
    "render", [raises, begins, begins_and_raises, lambda self, depsgraph: None]
)
def test_an_engine_that_fails_is_told(render, toy, solids, monkeypatch, compare):
    """Blender itself would crash if it were to write such a render to a file."""
    assert compare(judge="TOY_TRACER", diagnose=False).verdict == "agree"
    monkeypatch.setattr(toy, "render", render)
    for as_is in (False, True):
        with pytest.raises(SceneError, match="Toy Tracer made no picture: see the console"):
            compare(judge="TOY_TRACER", as_is=as_is)
    monkeypatch.undo()
    assert compare(judge="TOY_TRACER", diagnose=False).verdict == "agree"


def test_the_command_takes_an_engine_by_its_name(toy, solids, tmp_path, capsys):
    toy.is_opaque = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    compare = "compare", "--out", str(tmp_path / "out"), "--judge"
    code = in_blender.run([*compare, "Toy_Tracer", "--renderer", "raster"])
    said = capsys.readouterr().out
    assert code == 1 and "Toy Tracer's render" in said
    assert "the picture's background is" in said and "as was asked for" in said
    assert in_blender.run([*compare, "cycles", "--filter", "1"]) == 4
    assert in_blender.run([*compare, "storm"]) == 4


@pytest.mark.parametrize(
    ("stored", "options", "said"),
    [
        ("ENGINE", [], ""),
        ("AUTO", ["--judge", "Toy_tracer", "--filter", "1.5"], ""),
        ("ENGINE", ["--judge", "Cycles", "--renderer", "raster"], "--renderer is for a picture of"),
        ("AUTO", ["--judge", "image"], "--judge image names no engine"),
        ("AUTO", ["--judge", "Render_Result"], "--judge Render_Result names no engine"),
        ("AUTO", ["--judge", "engine"], "--judge engine names no engine"),
    ],
)
def test_options_for_an_engine_that_the_file_stores(
    stored, options, said, toy, solids, tmp_path, capsys
):
    solids.reference_tracer.judge, solids.reference_tracer.engine = stored, "TOY_TRACER"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    code = in_blender.run(["compare", "--out", str(tmp_path / "out"), *options])
    assert code == (4 if said else 0)
    assert said in capsys.readouterr().err


@pytest.fixture
def rendered_png(solids, tmp_path):
    """Render by Workbench, flat, and save a PNG; returns its path."""
    solids.display.shading.light = "FLAT"
    solids.display.shading.show_specular_highlight = False
    solids.display.render_aa = "OFF"
    solids.render.film_transparent = True
    solids.render.engine = "BLENDER_WORKBENCH"
    solids.view_settings.view_transform = "Standard"
    set_format(solids.render, "PNG", "RGBA", "8")
    path = tmp_path / "rendered.png"
    solids.render.filepath = str(path)
    solids.reference_tracer.judge = "IMAGE"

    def run():
        bpy.ops.render.render(write_still=True)
        return path

    return run


def compared_with(image):
    bpy.context.scene.reference_tracer.image = image
    OPS.compare()
    return results.content(Kind.COMPARISON, bpy.context.scene)


def test_an_image_of_a_file(rendered_png):
    found = compared_with(bpy.data.images.load(str(rendered_png())))
    assert found.verdict == "agree" and found.counts.unexplained == 0
    assert found.case.picture.storage.levels == 255 and not found.case.picture.storage.opaque
    assert found.case.picture.source.file == "rendered.png"


@pytest.mark.parametrize("kind", ["packed", "painted", "float"])
def test_an_image_that_blender_alone_holds(kind, rendered_png, solids):
    if kind == "float":
        set_format(solids.render, "OPEN_EXR", "RGBA", "32")
    path = next(rendered_png().parent.glob("rendered.*"))
    loaded = bpy.data.images.load(str(path))
    pixels = np.empty(96 * 54 * 4, np.float32)
    loaded.pixels.foreach_get(pixels)
    own = loaded
    if kind == "packed":
        own.pack()
    else:
        own = bpy.data.images.new("Painted", 96, 54, alpha=True, float_buffer=kind == "float")
        own.pixels.foreach_set(pixels)
    found = compared_with(own)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    assert found.case.picture.storage.levels == (0 if kind == "float" else 255)
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
    shown = np.array(results.ours(results.PUT_RIGHT).pixels[:]).reshape(right.shape)
    assert np.array_equal(shown, right) and not np.array_equal(shown, found.frame.color)
    assert OPS.copy_camera(number=0) == {"FINISHED"}
    assert OPS.activate_copy() == {"FINISHED"}
    assert solids.camera != camera and camera.data.lens == 40
    assert compared_with(solids.reference_tracer.image).verdict == "agree"
    assert results.ours(results.PUT_RIGHT) is None and not OPS.show_put_right.poll()


def test_what_changes_no_picture_is_not_shown_put_right(rendered_png, solids):
    """Such as a tolerance."""
    solids.camera.data.lens = 44.0
    path = rendered_png()
    solids.camera.data.lens = 40.0
    found = compared_with(bpy.data.images.load(str(path)))
    same = replace(found.diagnosis.told[0], frame=found.frame)
    found = replace(found, diagnosis=replace(found.diagnosis, told=(same,)))
    assert result_of(results.keep_comparison(found)).put_right == {}
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


def test_the_render_result(rendered_png, solids):
    rendered_png()
    solids.reference_tracer.judge = "RENDER_RESULT"
    solids.render.engine = "CYCLES"  # since
    settings = solids.render.image_settings
    before = settings.file_format, settings.color_mode, settings.color_depth
    OPS.compare()
    found = results.content(Kind.COMPARISON, solids)
    assert found.verdict == "agree" and found.counts.unexplained == 0
    assert found.case.picture.storage.levels == 0  # its own floats, not what a view transform makes
    assert (settings.file_format, settings.color_mode, settings.color_depth) == before
    assert found.case.picture.source.file == "Render Result"
    assert found.case.picture.sampling.renderer.name == "raster"  # as Workbench made it
    bpy.data.objects["Green"].location.x += 0.2
    OPS.compare()
    found = results.content(Kind.COMPARISON, solids)
    assert found.verdict == "differences" and found.counts.unexplained > 20


def test_a_result_of_rays_has_no_excuse_of_a_rasteriser(build):
    """Cycles' render shows the wall behind, and then the scene is set to a rasteriser."""
    scene = build.scene(96, 54)
    for name, y, rgba in ("Near", 1000.0, (1, 0, 0, 1)), ("Far", 1000.1, (0, 1, 0, 1)):
        corners = [(-500, y, -500), (500, y, -500), (500, y, 500), (-500, y, 500)]
        material = build.material(name, *rgba)
        material.use_nodes = True
        emission = material.node_tree.nodes.new("ShaderNodeEmission")
        emission.inputs["Color"].default_value = rgba
        surface = material.node_tree.nodes["Material Output"].inputs["Surface"]
        material.node_tree.links.new(emission.outputs[0], surface)
        build.mesh(name, corners, [(0, 1, 2, 3)]).data.materials.append(material)
    build.camera((0, 0, 0), (np.pi / 2, 0, 0), clip_end=10_000)
    scene.render.engine, scene.render.film_transparent = "CYCLES", True
    scene.cycles.samples, scene.cycles.filter_width = 1, 0.01
    near = bpy.data.objects["Near"]
    near.location.y = 0.2
    bpy.ops.render.render()
    near.location.y = 0
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.reference_tracer.judge = "RENDER_RESULT"
    scene.reference_tracer.diagnose = False
    OPS.compare()
    found = results.content(Kind.COMPARISON, scene)
    assert found.case.picture.sampling.renderer.name == "rays"
    assert found.verdict == "differences" and found.counts.unexplained > 1000


def test_a_result_has_no_excuse_of_a_rasteriser_that_did_not_render_it(
    toy, rendered_png, solids, compare
):
    """An add-on's engine, or one that is not known, as it was rendered before the add-on heard."""

    def renderer(says_what_to_do=False):
        found = compare(judge="RENDER_RESULT", diagnose=False)
        assert found.verdict == "agree"
        assert ("render again with F12" in str(found.manifest.notes)) == says_what_to_do
        return found.case.picture.sampling.renderer.name, found.case.picture.source.known

    unknown = "rays", "as Blender wrote it, but nothing says that it was rasterised"
    rendered_png()
    assert renderer() == ("raster", "as Blender wrote it, and its engine is BLENDER_WORKBENCH")
    rendered.forget()
    assert renderer(says_what_to_do=True) == unknown
    made_by = compare(judge="RENDER_RESULT", diagnose=False, renderer="raster")
    assert not made_by.manifest.notes
    solids.render.engine = "TOY_TRACER"
    bpy.ops.render.render()
    solids.render.engine = "BLENDER_WORKBENCH"
    compare(judge="WORKBENCH")  # which renders a copy of the scene
    assert renderer() == unknown


def test_the_engine_of_a_result_goes_with_its_scene(rendered_png, solids):
    """Not with its name, which another scene may have by the time that it is compared."""
    rendered_png()
    name, solids.name = solids.name, "Renamed"
    other = bpy.data.scenes.new(name)
    assert rendered.engine_of_result(solids) == "BLENDER_WORKBENCH"
    assert rendered.engine_of_result(other) == ""


@pytest.mark.parametrize("kind", ["PNG", "OPEN_EXR"])
def test_the_render_result_leaves_the_output_settings(kind, rendered_png, solids):
    """A scene may save by another color management than it shows."""
    rendered_png()
    set_format(solids.render, kind, "RGB", "16")
    solids.reference_tracer.judge = "RENDER_RESULT"
    settings = solids.render.image_settings
    settings.color_management = "OVERRIDE"
    settings.linear_colorspace_settings.name = "ACEScg"
    view = settings.view_settings
    view.view_transform, view.exposure, view.use_curve_mapping = "Filmic", 2.0, True
    view.curve_mapping.curves[0].points.new(0.25, 0.75)

    def set_now():
        points = [tuple(p.location) for curve in view.curve_mapping.curves for p in curve.points]
        own = settings.color_management, settings.linear_colorspace_settings.name
        form = settings.file_format, settings.color_mode, settings.color_depth
        return form, own, view.view_transform, view.exposure, view.use_curve_mapping, points

    before = set_now()
    OPS.compare()
    assert results.content(Kind.COMPARISON, solids).verdict == "agree"
    assert set_now() == before


def test_a_result_of_another_view_layer_is_told(rendered_png, solids, compare):
    """Of several view layers it shows the first; the one that is active is traced."""
    first = solids.view_layers[0]
    other = solids.view_layers.new("Other")
    solids.collection.objects.unlink(solids.objects["Green"])
    solids.collection.children.link(own := bpy.data.collections.new("Own"))
    own.objects.link(bpy.data.objects["Green"])
    other.layer_collection.children["Own"].exclude = True
    rendered_png()
    solids.reference_tracer.judge = "RENDER_RESULT"

    def told(layer):
        with bpy.context.temp_override(scene=solids, view_layer=layer):
            found = compare(diagnose=False)
        return found.verdict, [n for n in found.manifest.notes if "the picture" in n]

    assert told(first) == ("agree", [])
    verdict, [note] = told(other)
    assert verdict == "differences"
    assert note == f"of the picture: it shows the view layer '{first.name}', and 'Other' was traced"
    first.use = False
    rendered_png()
    assert told(other) == ("agree", [])


def test_metadata_that_is_burned_in_is_told(rendered_png, solids, compare):
    solids.render.use_stamp = True
    rendered_png()
    found = compare(judge="RENDER_RESULT", diagnose=False)
    assert found.verdict == "differences"
    assert "of the picture: metadata is burned into it" in found.manifest.notes


def test_a_stereo_result_is_refused(rendered_png, solids, compare):
    solids.render.use_multiview = True
    rendered_png()
    settings = solids.render.image_settings
    settings.views_format = "STEREO_3D"
    for is_on in (True, False):
        solids.render.use_multiview = is_on
        with pytest.raises(SceneError, match="stereo Render Result: switch off Stereoscopy"):
            compare(judge="RENDER_RESULT")
    assert settings.views_format == "STEREO_3D"
    rendered_png()
    assert compare(judge="RENDER_RESULT").verdict == "agree"


def test_an_engine_without_a_name_is_asked_for(solids):
    solids.reference_tracer.judge = "ENGINE"
    with pytest.raises(RuntimeError, match="No engine is named: type its name below Compare With"):
        OPS.compare()


def test_without_a_render_there_is_no_result(solids):
    solids.reference_tracer.judge = "RENDER_RESULT"
    with pytest.raises(RuntimeError, match="no Render Result: render it first"):
        OPS.compare()


def test_images_of_the_comparison_are_not_offered(solids):
    offered = solids.reference_tracer.bl_rna.properties["image"]
    assert offered.fixed_type.identifier == "Image"
    own = results.show("Reference Tracer Traced", np.zeros((4, 4, 4), np.float32))
    assert not properties._is_a_picture(solids.reference_tracer, own)
    assert properties._is_a_picture(solids.reference_tracer, bpy.data.images.new("Mine", 4, 4))
