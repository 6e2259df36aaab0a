"""Blender's random colours, which it makes of an object's name and library."""

from __future__ import annotations

import bpy
import pytest
from reference_tracer.blender.reading.colors import random_color

from .scenes import assert_same_colors, save


@pytest.mark.parametrize("relative", [False, True], ids=["absolute", "relative"])
def test_random_colors_of_linked_objects(relative, build, compare, tmp_path):
    """Of the same name as a local object, and yet of another colour."""
    library = tmp_path / "bücher.blend"
    bpy.data.libraries.write(str(library), {build.square("Square", 1)})
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    build.scene(color_type="RANDOM")
    save(tmp_path / "user.blend")
    with bpy.data.libraries.load(str(library), link=True, relative=relative) as (_, to):
        to.objects = ["Square"]
    linked = build.link(to.objects[0])
    assert linked.library.filepath.startswith("//") == relative
    local = build.square("Square", 1, location=(1.5, 0, 0))
    build.camera()
    assert linked.name == local.name
    assert random_color(linked) != random_color(local)
    assert_same_colors(compare(), distinct=2)
