"""What a .blend needs and does not have is a warning, by name; it explains no pixel."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from PIL import ImageFont
from reference_tracer.manifest import Effect
from reference_tracer.scene import SceneError

SIZE = 48, 32


def found(manifest) -> dict[str, tuple[str, str]]:
    """Return what is missing by what it is: its name, and what needs it."""
    missing = [u for u in manifest.unmodelled if u.effect is Effect.MISSING]
    lines = [line.strip() for line, warns in manifest.facts() if warns]
    for u in missing:
        assert u.line() in lines and u.bounds is None
    return {u.feature: (u.object, u.detail) for u in missing}


@pytest.fixture
def saved(build, tmp_path):
    """A scene that is made, saved and opened again."""

    def reopen(name: str = "scene") -> None:
        path = str(tmp_path / f"{name}.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)

    def begin() -> None:
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        build.scene(*SIZE)
        build.camera((0, 0, 12))

    begin()
    return SimpleNamespace(folder=tmp_path, reopen=reopen, begin=begin)


def library(build, saved) -> Path:
    """Write a library with an object, a collection, a mesh and a material in use."""
    red = build.material("Lent Red", 0.9, 0.1, 0.1)
    build.collection("Kit", build.cube("Lent", material=red, location=(3, 0, 0)), link=True)
    path = saved.folder / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
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
    bpy.ops.wm.save_as_mainfile(filepath=str(saved.folder / "scene.blend"))
    wanted = linked(path, objects=["Lent"], collections=["Kit"])
    build.link(wanted.objects[0])
    empty = build.empty("Holder", location=(-3, 0, 0))
    empty.instance_type, empty.instance_collection = "COLLECTION", wanted.collections[0]
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


def test_a_library_that_is_there(build, saved, export):
    linked_scene(build, saved, keep=True)
    scene, manifest = export.render()
    assert found(manifest) == {}
    assert len(scene.instances) == 3


def test_a_library_without_what_is_linked(build, saved, export):
    path = linked_scene(build, saved, keep=True)
    scene = saved.folder / "scene.blend"
    saved.begin()
    build.collection("Kit", build.cube("Another"), link=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(scene))
    missing = {"missing data in library": ("//library.blend", "object 'Lent'")}
    assert found(export.render()[1]) == missing


def test_linked_mesh_and_material(build, saved, export, entries):
    path = library(build, saved)
    bpy.ops.wm.save_as_mainfile(filepath=str(saved.folder / "scene.blend"))
    wanted = linked(path, meshes=["Lent"], materials=["Lent Red"])
    build.link(bpy.data.objects.new("User", wanted.meshes[0]))
    build.cube("Own", 1).data.materials.append(wanted.materials[0])
    path.unlink()
    saved.reopen()
    manifest = export.render()[1]
    _, things = found(manifest)["missing library"]
    assert set(things.split(", ")) == {"mesh 'Lent' of 'User'", "material 'Lent Red' of 'Own'"}
    assert "its mesh 'Lent', '//library.blend' is missing" in entries(manifest)["User"].reason
    bpy.context.scene.display.shading.color_type = "OBJECT"  # then no material is shown
    assert found(export.render()[1])["missing library"][1] == "mesh 'Lent' of 'User'"


def test_an_override_of_a_missing_library(build, saved, export):
    path = library(build, saved)
    bpy.ops.wm.save_as_mainfile(filepath=str(saved.folder / "scene.blend"))
    wanted = linked(path, objects=["Lent"])
    build.link(wanted.objects[0].override_create())
    path.unlink()
    saved.reopen()
    name, things = found(export.render()[1])["missing library"]
    assert name == "//library.blend" and "object 'Lent'" in things


def test_what_is_not_seen_is_no_warning(build, saved, export):
    """Another scene's, a hidden or an excluded object's library is missing; so is a lamp."""
    path = library(build, saved)
    bpy.ops.wm.save_as_mainfile(filepath=str(saved.folder / "scene.blend"))
    wanted = linked(path, objects=["Lent"], meshes=["Lent"])
    bpy.data.scenes.new("Other").collection.objects.link(wanted.objects[0])
    hidden = build.link(bpy.data.objects.new("Hidden", wanted.meshes[0]))
    hidden.hide_render = hidden.hide_viewport = True
    aside = build.link(bpy.data.objects.new("Aside", wanted.meshes[0]))
    bpy.context.scene.collection.objects.unlink(aside)
    build.collection("Aside", aside, link=True)
    bpy.context.view_layer.layer_collection.children["Aside"].exclude = True
    build.cube("Own")
    path.unlink()
    saved.reopen()
    for run in export.modes.values():
        assert found(run()[1]) == {}


def test_a_warning_that_explains_nothing(build, saved, compare, monkeypatch):
    """The verdict is *warnings*; where the library's object was to be, a wrong pixel is wrong."""
    from reference_tracer.blender import compare as compare_module

    linked_scene(build, saved)
    comparison = compare()
    assert comparison.verdict == "warnings"
    assert comparison.pixels["not_judged"]["pixels"] == comparison.pixels["unexplained"] == 0
    real = compare_module.picture

    def with_the_object(*args, **options):
        picture = real(*args, **options)
        picture[12:20, 30:38] = (0.9, 0.1, 0.1, 1)
        return picture

    monkeypatch.setattr(compare_module, "picture", with_the_object)
    comparison = compare(diagnose=False)
    assert comparison.pixels["unexplained"] == 64
    assert comparison.verdict == "differences"


def test_the_command_says_it_everywhere(build, saved, reftrace):
    linked_scene(build, saved)
    out = saved.folder / "out"
    done = reftrace("compare", saved.folder / "scene.blend", "--out", out)
    assert done.returncode == 1, done.stderr
    assert "  missing library: //library.blend (object 'Lent'" in done.stdout
    assert "Info:" not in done.stdout  # Blender's own reports
    stored = json.loads((out / "comparison.json").read_text(encoding="utf-8"))
    (missing,) = stored["scene"]["unmodelled"]
    assert (missing["effect"], missing["object"]) == ("missing", "//library.blend")
    assert "//library.blend" in (out / "page.html").read_text(encoding="utf-8")


# Each makes an object that needs a file, and returns the file.


def mesh_cache(build, folder: Path) -> Path:
    path = folder / "points.pc2"
    header = np.array([b"POINTCACHE2\0"]).tobytes() + np.array([1, 8], "<i4").tobytes()
    header += np.array([0, 1], "<f4").tobytes() + np.array([1], "<i4").tobytes()
    path.write_bytes(header + np.zeros((8, 3), "<f4").tobytes())
    modifier = build.cube("User").modifiers.new("Cache", "MESH_CACHE")
    modifier.cache_format, modifier.filepath = "PC2", str(path)
    return path


def displacing_image(build, folder: Path) -> Path:
    texture = bpy.data.textures.new("Bumps", "IMAGE")
    texture.image = image(folder / "bumps.png")
    build.cube("User").modifiers.new("Displace", "DISPLACE").texture = texture
    return folder / "bumps.png"


def image(path: Path):
    made = bpy.data.images.new(path.stem, 4, 4)
    made.filepath_raw, made.file_format = str(path), "PNG"
    made.save()
    made.source = "FILE"
    return made


def image_of_nodes(build, folder: Path) -> Path:
    tree, (node,) = build.nodes(build.cube("User"), "GeometryNodeSetPosition")
    texture = tree.nodes.new("GeometryNodeImageTexture")
    texture.inputs["Image"].default_value = image(folder / "moves.png")
    tree.links.new(texture.outputs["Color"], node.inputs["Offset"])
    return folder / "moves.png"


def volume(build, folder: Path) -> Path:
    """A mesh is made of it; here it is no volume at all, but that is another matter."""
    (folder / "cloud.vdb").write_bytes(b"VDB")
    data = bpy.data.volumes.new("Cloud")
    data.filepath = str(folder / "cloud.vdb")
    holder = build.link(bpy.data.objects.new("Holder", data))
    build.cube("User").modifiers.new("Mesh", "VOLUME_TO_MESH").object = holder
    return folder / "cloud.vdb"


def cache_of_modifier(build, folder: Path) -> Path:
    """An Alembic file that Blender writes itself."""
    build.cube("User")
    path = folder / "moved.abc"
    bpy.ops.wm.alembic_export(filepath=str(path), start=1, end=1, as_background_job=False)
    bpy.ops.cachefile.open(filepath=str(path))
    modifier = bpy.data.objects["User"].modifiers.new("Cache", "MESH_SEQUENCE_CACHE")
    modifier.cache_file = bpy.data.cache_files[0]
    modifier.object_path = "/User/User"
    return path


def simulation_on_disk(build, folder: Path) -> Path:
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "scene.blend"))  # the cache lies beside it
    cache = build.square("User").modifiers.new("Cloth", "CLOTH").point_cache
    cache.use_disk_cache, cache.frame_start, cache.frame_end = True, 1, 3
    bpy.ops.ptcache.bake_all(bake=True)
    return folder / "blendcache_scene"


def external_cache(build, folder: Path) -> Path:
    cache = build.square("User").modifiers.new("Cloth", "CLOTH").point_cache
    cache.use_external, cache.filepath = True, str(folder / "external")
    (folder / "external").mkdir()
    return folder / "external"


def font(build, folder: Path) -> Path:
    """Blender has a font of its own in its place."""
    (folder / "letters.ttf").write_bytes(ImageFont.load_default(10).font_bytes)
    build.text("User").data.font = bpy.data.fonts.load(str(folder / "letters.ttf"))
    return folder / "letters.ttf"


def particles(build, folder: Path) -> Path:
    obj = build.square("User")
    obj.modifiers.new("Particles", "PARTICLE_SYSTEM")
    cache = obj.particle_systems[0].point_cache
    cache.use_external, cache.filepath = True, str(folder / "particles")
    (folder / "particles").mkdir()
    return folder / "particles"


FILES: dict[Callable[..., Path], str] = {
    mesh_cache: "modifier 'Cache' of 'User'",
    displacing_image: "image 'bumps' of 'User'",
    image_of_nodes: "image 'moves' of 'User'",
    volume: "volume 'Cloud' of 'Holder'",
    cache_of_modifier: "cache 'moved.abc' of 'User'",
    simulation_on_disk: "modifier 'Cloth' of 'User'",
    font: "font 'Aileron Regular' of 'User'",
    particles: "modifier 'Particles' of 'User'",
    external_cache: "modifier 'Cloth' of 'User'",
}


@pytest.mark.parametrize("make", FILES, ids=lambda make: make.__name__)
def test_a_missing_file(make, build, saved, export):
    """It is named once it is gone, and not while it is there."""
    path = make(build, saved.folder)
    saved.reopen()
    assert found(export.render()[1]) == {}
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink()
    saved.reopen()
    kind = "folder" if path.suffix == "" else "file"
    (missing,) = found(export.render()[1]).items()
    assert missing[0] == f"missing {kind}" and missing[1][0].endswith(path.name)
    assert FILES[make] in missing[1][1]


def test_a_path_as_windows_has_it(build, saved, export):
    """Blender reads the file, whatever the machine."""
    (saved.folder / "textures").mkdir()
    displacing_image(build, saved.folder / "textures")
    bpy.data.images["bumps"].filepath = "//textures\\bumps.png"
    saved.reopen()
    assert bpy.data.images["bumps"].size[:] == (4, 4)
    assert found(export.render()[1]) == {}
    (saved.folder / "textures" / "bumps.png").unlink()
    saved.reopen()
    assert list(found(export.render()[1])) == ["missing file"]


def test_a_sequence_has_its_frames_in_its_name_not_in_its_suffix(build, saved, export):
    displacing_image(build, saved.folder)
    (saved.folder / "bumps.png").rename(saved.folder / "bumps_0002.jp2")
    bumps = bpy.data.images["bumps"]
    bumps.source, bumps.filepath = "SEQUENCE", "//bumps_0001.jp2"
    saved.reopen()
    assert found(export.render()[1]) == {}
    (saved.folder / "bumps_0002.jp2").unlink()
    saved.reopen()
    assert list(found(export.render()[1])) == ["missing file"]


def test_packed_files_are_there(build, saved, export):
    displacing_image(build, saved.folder)
    font(build, saved.folder)
    bpy.data.images["bumps"].pack()
    bpy.data.objects["User.001"].data.font.pack()
    for path in (*saved.folder.glob("*.png"), *saved.folder.glob("*.ttf")):
        path.unlink()
    saved.reopen()
    assert found(export.render()[1]) == {}


def test_files_that_shape_nothing(build, saved, export):
    """An image of a material, an unused texture, or an empty; a modifier that is off."""
    material = build.material("Painted", 1, 1, 1)
    material.use_nodes = True
    material.node_tree.nodes.new("ShaderNodeTexImage").image = image(saved.folder / "a.png")
    cube = build.cube("Own", material=material)
    bpy.data.textures.new("Unused", "IMAGE").image = image(saved.folder / "b.png")
    bpy.data.textures["Unused"].use_fake_user = True
    reference = build.empty("Reference")
    reference.empty_display_type, reference.data = "IMAGE", image(saved.folder / "c.png")
    modifier = cube.modifiers.new("Off", "MESH_CACHE")
    modifier.filepath, modifier.show_viewport, modifier.show_render = "//no.mdd", False, False
    for name in "abc":
        (saved.folder / f"{name}.png").unlink()
    saved.reopen()
    for run in export.modes.values():
        assert found(run()[1]) == {}


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
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    build.cube("Own")
    bpy.ops.wm.save_as_mainfile(filepath=str(saved.folder / "scene.blend"))
    bpy.context.scene.camera = build.link(linked(path, objects=["Camera"]).objects[0])
    path.unlink()
    saved.reopen()
    why = r"'Camera', .* is not there: its library '//library.blend' is missing\. Find the file"
    with pytest.raises(SceneError, match=why):
        export.viewport()


def test_an_object_of_a_background_scene(build, saved, export):
    back = bpy.data.scenes.new("Back")
    text = build.text("User")
    bpy.context.scene.collection.objects.unlink(text)
    back.collection.objects.link(text)
    bpy.context.scene.background_set = back
    (saved.folder / "letters.ttf").write_bytes(ImageFont.load_default(10).font_bytes)
    text.data.font = bpy.data.fonts.load(str(saved.folder / "letters.ttf"))
    (saved.folder / "letters.ttf").unlink()
    saved.reopen()
    assert found(export.render()[1])["missing file"][1].endswith("of 'User'")


@pytest.mark.parametrize("linked_in", [True, False])
def test_a_node_that_this_blender_does_not_know(linked_in, build, saved, export):
    class Foreign(bpy.types.GeometryNode):
        bl_idname, bl_label = "ForeignNode", "Foreign"

        def init(self, context):
            self.outputs.new("NodeSocketVector", "Offset")

    tree, (node,) = build.nodes(build.cube("User"), "GeometryNodeSetPosition")
    bpy.utils.register_class(Foreign)
    try:
        foreign = tree.nodes.new("ForeignNode")
        if linked_in:
            tree.links.new(foreign.outputs[0], node.inputs["Offset"])
    finally:
        bpy.utils.unregister_class(Foreign)
    saved.reopen()
    named = {"missing type of node": ("Foreign", "node group 'Nodes' of 'User'")}
    assert found(export.render()[1]) == (named if linked_in else {})


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
