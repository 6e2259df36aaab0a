"""Linked collections beside their library overrides, and objects that have the same name."""

from __future__ import annotations

import os

import bpy
import numpy as np
import pytest
from reference_tracer.blender.values import untold

from .test_unchanged import differences, state


@pytest.fixture
def kit(build, tmp_path):
    """A linked collection of two objects; gives it anew in an empty file."""
    part = build.square("Part", 1, link=False)
    ball = build.cube("Ball", 0.6, link=False, location=(0.8, 0, 0))
    library = tmp_path / "library.blend"
    bpy.data.libraries.write(str(library), {build.collection("Kit", part, ball)})
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(os.fspath(library), link=True) as (_, to):
        to.collections = ["Kit"]
    return to.collections[0]


def overridden(build, kit, editable: bool) -> None:
    """An empty that instances the collection, and a library override of it in the scene."""
    build.scene()
    build.instances("Kit", kit, location=(-1, 0.5, 0.3))
    scene, layer = bpy.context.scene, bpy.context.view_layer
    kit.override_hierarchy_create(scene, layer, do_fully_editable=editable)
    build.camera()
    bpy.context.view_layer.update()


@pytest.mark.parametrize("editable", [True, False])
@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_a_linked_collection_and_its_override_are_told_apart(judge, editable, build, compare, kit):
    overridden(build, kit, editable)
    before = state()
    colors = {o.name_full: o.color[:] for o in bpy.data.objects}
    found = compare(judge=judge)
    assert found.verdict == "agree"
    counts = found.identity.shows()
    assert counts.not_known == 0 and counts.other_object == 0
    shown = {found.identity.names[n] for n in np.unique(found.identity.shown) if n >= 0}
    assert shown == {"Part", "Ball", "Kit"}
    assert colors == {o.name_full: o.color[:] for o in bpy.data.objects}
    assert [d for d in differences(before, state()) if "/names/images" not in d[0]] == []


def test_each_object_gets_its_own_colour_and_its_own_back(build, kit):
    """`foreach_set` passes over an override's object, and would give its value to the next."""
    overridden(build, kit, False)
    for number, obj in enumerate(bpy.data.objects):
        obj.color = (number / 16, 0.5, 0.25, 1.0)
    before = {o: o.color[:] for o in bpy.data.objects}
    some = [o for o in bpy.context.scene.objects if o.type != "CAMERA"]
    new = np.linspace(0, 1, 4 * len(some), dtype=np.float32).reshape(-1, 4)
    with untold(bpy.data.objects, "color", dict(zip(some, new, strict=True))):
        for obj, color in zip(some, new, strict=True):
            assert np.allclose(obj.color, color)
        for obj in set(before) - set(some):
            assert obj.color[:] == before[obj]
    assert before == {o: o.color[:] for o in bpy.data.objects}


@pytest.mark.parametrize("first", [True, False], ids=["override first", "linked first"])
def test_a_collection_is_left_out_of_by_itself_not_by_its_name(first, build, compare, kit):
    """Both collections have one name; one is seen by indirect rays alone, and has a plane."""
    build.scene()
    scene, layer = bpy.context.scene, bpy.context.view_layer
    scene.collection.children.link(kit)
    made = kit.override_hierarchy_create(scene, layer, do_fully_editable=True)
    made = made or next(c for c in bpy.data.collections if c.override_library)
    for child in list(scene.collection.children):
        scene.collection.children.unlink(child)
    for child in (made, kit) if first else (kit, made):
        scene.collection.children.link(child)
    made.name = kit.name
    assert [c.name for c in scene.collection.children] == ["Kit", "Kit"]
    plane = next(o for o in made.objects if o.name.startswith("Part"))
    plane.reference_tracer.infinite_plane = True
    plane.location.z = -1
    next(o for o in made.objects if o != plane).location.x -= 1.5
    next(c for c in layer.layer_collection.children if c.collection == kit).exclude = True
    build.camera(rotation=(0.2, 0, 0))
    found = compare()
    assert found.verdict == "agree" and found.identity.shows().other_object == 0
    shown = {found.identity.names[n] for n in np.unique(found.identity.shown) if n >= 0}
    assert shown == {o.name for o in made.objects}
    hidden = [e.reason for e in found.manifest.objects if e.name.endswith("[library.blend]")]
    assert len(hidden) == 2 and all("its collection is excluded" in why for why in hidden)
