"""What a .blend needs and does not have is a warning, by name; it explains no pixel."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest
from reference_tracer.report.lines import describe
from reference_tracer.scene import SceneError

from .missing import found
from .scenes import save


def library(build, saved) -> Path:
    """Write a library with an object, a collection, a mesh and a material in use."""
    red = build.material("Lent Red", 0.9, 0.1, 0.1)
    build.collection("Kit", build.cube("Lent", material=red, location=(3, 0, 0)), link=True)
    path = saved.folder / "library.blend"
    save(path)
    saved.begin()
    return path


def linked(path: Path, **names: list[str]) -> SimpleNamespace:
    with bpy.data.libraries.load(str(path), link=True, relative=True) as (_, wanted):
        for kind, of_kind in names.items():
            setattr(wanted, kind, of_kind)
    return wanted


def linked_scene(build, saved, keep: bool = False) -> Path:
    """A scene with a linked object and an instance of a linked collection, beside its own cube."""
    path = library(build, saved)
    save(saved.folder / "scene.blend")
    wanted = linked(path, objects=["Lent"], collections=["Kit"])
    build.link(wanted.objects[0])
    build.instances("Holder", wanted.collections[0], location=(-3, 0, 0))
    build.cube("Own", 1, location=(0, 3, 0), material=build.material("Blue", 0.1, 0.1, 0.9))
    if not keep:
        path.unlink()
    saved.reopen()
    return path


def test_a_missing_library(build, saved, export, entries):
    linked_scene(build, saved)
    for run in export.modes.values():
        manifest = run()[1]
        missing = "//library.blend", "object 'Lent', collection 'Kit' of 'Holder'"
        assert found(manifest) == {"missing library": missing}
        by_name = entries(manifest)
        (lent,) = (e for name, e in by_name.items() if name.startswith("Lent"))
        assert lent.reason == "its library '//library.blend' is missing"
        said = "the library of its collection 'Kit', '//library.blend' is missing"
        assert by_name["Holder"].reason == said
        assert not lent.hidden


def test_an_empty_picture_for_want_of_a_library(build, saved, export, compare):
    """Its collection is linked into the scene: no object is left that would say so."""
    path = library(build, saved)
    save(saved.folder / "scene.blend")
    (kit,) = linked(path, collections=["Kit"]).collections
    bpy.context.scene.collection.children.link(kit)
    build.corner_camera()
    path.unlink()
    saved.reopen()
    for run in export.modes.values():
        assert found(run()[1]) == {"missing library": ("//library.blend", "collection 'Kit'")}
    said = "verdict: warnings (missing library of '//library.blend'; the picture is empty)"
    assert describe(compare())[-1] == said
    bpy.context.view_layer.layer_collection.children[0].exclude = True
    assert found(export.render()[1]) == {}


def test_linked_mesh_and_material(build, saved, export, entries):
    path = library(build, saved)
    save(saved.folder / "scene.blend")
    wanted = linked(path, meshes=["Lent"], materials=["Lent Red"])
    build.object("User", wanted.meshes[0])
    build.cube("Own", 1).data.materials.append(wanted.materials[0])
    path.unlink()
    saved.reopen()
    manifest = export.render()[1]
    _, things = found(manifest)["missing library"]
    assert set(things.split(", ")) == {"mesh 'Lent' of 'User'", "material 'Lent Red' of 'Own'"}
    assert "its mesh 'Lent', '//library.blend' is missing" in entries(manifest)["User"].reason
    bpy.context.scene.display.shading.color_type = "OBJECT"  # then no material is shown
    assert found(export.render()[1])["missing library"][1] == "mesh 'Lent' of 'User'"


def test_what_is_not_seen_is_no_warning(build, saved, export):
    """Another scene's, a hidden or an excluded object's library is missing; so is a lamp."""
    path = library(build, saved)
    save(saved.folder / "scene.blend")
    wanted = linked(path, objects=["Lent"], meshes=["Lent"])
    bpy.data.scenes.new("Other").collection.objects.link(wanted.objects[0])
    hidden = build.object("Hidden", wanted.meshes[0])
    hidden.hide_render = hidden.hide_viewport = True
    aside = build.object("Aside", wanted.meshes[0])
    bpy.context.scene.collection.objects.unlink(aside)
    build.collection("Aside", aside, link=True)
    bpy.context.view_layer.layer_collection.children["Aside"].exclude = True
    build.cube("Own")
    path.unlink()
    saved.reopen()
    for run in export.modes.values():
        assert found(run()[1]) == {}


def test_a_warning_that_explains_nothing(build, saved, compare, shown_otherwise):
    """The verdict is *warnings*; where the library's object was to be, a wrong pixel is wrong."""
    linked_scene(build, saved)
    comparison = compare()
    assert comparison.verdict == "warnings"
    assert comparison.counts.not_judged.pixels == comparison.counts.unexplained == 0

    def with_the_object(pixels):
        pixels[12:20, 30:38] = (0.9, 0.1, 0.1, 1)
        return pixels

    shown_otherwise(with_the_object)
    comparison = compare(diagnose=False)
    assert comparison.counts.unexplained == 64
    assert comparison.verdict == "differences"


def test_a_driver_whose_python_does_not_run(build, saved, export):
    cube = build.cube("Driven")
    for index, expression in enumerate(("frame * 2", "[7][0]", "len(bpy.data.objects) * 2.0")):
        cube.driver_add("location", index).driver.expression = expression
    saved.reopen()
    named = {"driver that did not run": ("Driven", "scripts are off: location")}
    assert found(export.render()[1]) == named
    bpy.data.objects["Driven"].driver_remove("location", 2)
    saved.reopen()
    assert found(export.render()[1]) == {}


def test_a_missing_camera(build, saved, export):
    path = saved.folder / "library.blend"
    save(path)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    build.cube("Own")
    save(saved.folder / "scene.blend")
    bpy.context.scene.camera = build.link(linked(path, objects=["Camera"]).objects[0])
    path.unlink()
    saved.reopen()
    why = r"'Camera', .* is not there: its library '//library.blend' is missing\. Find the file"
    with pytest.raises(SceneError, match=why):
        export.viewport()


@pytest.mark.parametrize("use", ["evaluated", "not linked", "switched off", "named alone"])
def test_a_node_that_this_blender_does_not_know(use, build, saved, export):
    """It counts where a modifier that is on evaluates it: a property may name any tree."""

    class Foreign(bpy.types.GeometryNode):
        bl_idname, bl_label = "ForeignNode", "Foreign"

        def init(self, context):
            self.outputs.new("NodeSocketVector", "Offset")

    user = build.cube("User")
    tree, (node,) = build.nodes(user, "GeometryNodeSetPosition")
    if use == "named alone":
        user.modifiers[0].node_group = bpy.data.node_groups.new("Other", "GeometryNodeTree")
        user["logic"] = tree
    elif use == "switched off":
        user.modifiers[0].show_render = user.modifiers[0].show_viewport = False
    bpy.utils.register_class(Foreign)
    try:
        foreign = tree.nodes.new("ForeignNode")
        if use != "not linked":
            tree.links.new(foreign.outputs[0], node.inputs["Offset"])
    finally:
        bpy.utils.unregister_class(Foreign)
    saved.reopen()
    named = {"missing type of node": ("Foreign", "node group 'Nodes' of 'User'")}
    assert found(export.render()[1]) == (named if use == "evaluated" else {})


def test_a_script_that_does_not_run_is_a_note(build, saved, export):
    build.cube("Own")
    for name, is_run in (("handlers.py", True), ("todo.txt", False)):
        text = bpy.data.texts.new(name)
        text.write("import bpy\n")
        text.use_module = is_run
    saved.reopen()
    manifest = export.render()[1]
    assert manifest.notes == ("script 'handlers.py' of the file is not run: scripts are off",)
    assert found(manifest) == {}
