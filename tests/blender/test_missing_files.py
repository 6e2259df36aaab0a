"""A file that shapes what is seen and is not there is named, with what needs it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np
import pytest
from PIL import ImageFont
from reference_tracer.files.scenes import save_scene
from reference_tracer.opened import open_scene

from .missing import found
from .scenes import save

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
    holder = build.object("Holder", data)
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
    save(folder / "scene.blend")  # the cache lies beside it
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
    scene, manifest = export.render()
    save_scene(saved.folder / "scene.npz", scene, manifest)
    kept = open_scene(saved.folder / "scene.npz").manifest
    assert found(kept) == found(manifest)


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
