"""Instances of every kind: where Blender puts them, sharing one mesh, under the right object."""

from __future__ import annotations

from collections import Counter

import bpy
import numpy as np
import pytest

MODES = ("VIEWPORT", "RENDER")


def instances_of(scene) -> Counter:
    return Counter(scene.objects[instance.object] for instance in scene.instances)


def places(scene) -> np.ndarray:
    """Return the instances' matrices, (n, 4, 4), in an order of their own."""
    found = np.array([instance.world_from_object for instance in scene.instances])
    return found[np.lexsort(found.reshape(len(found), -1).round(5).T)]


def blenders_places() -> np.ndarray:
    """Return the matrices of every mesh with a face, in the viewport's evaluation."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = np.array(
        [
            np.array(item.matrix_world)
            for item in depsgraph.object_instances
            if item.show_self and item.object.type == "MESH" and item.object.data.polygons
        ],
        float,
    )
    return found[np.lexsort(found.reshape(len(found), -1).round(5).T)]


@pytest.mark.parametrize("mode", MODES)
def test_collection_instances(mode, build, export, entries):
    build.far_camera()
    inner = build.collection("Inner", build.cube(link=False, location=(1, 0, 0)))
    nested = build.empty("Nested", location=(0, 2, 0))
    nested.instance_type, nested.instance_collection = "COLLECTION", inner
    bpy.context.scene.collection.objects.unlink(nested)
    outer = build.collection("Outer", nested, build.square(link=False))
    outer.instance_offset = (0.5, 0, 0)
    for x in range(3):
        empty = build.empty(
            f"Empty {x}",
            location=(3 * x, 0, 0),
            rotation=(0, 0, x),
            scale=(-1 if x == 2 else 1, 2, 1),
        )
        empty.instance_type, empty.instance_collection = "COLLECTION", outer
    scene, manifest = export.modes[mode]()
    assert instances_of(scene) == {"Cube": 3, "Square": 3}
    assert len(scene.meshes) == 2
    assert sum(np.linalg.det(i.world_from_object[:3, :3]) < 0 for i in scene.instances) == 2
    np.testing.assert_array_equal(places(scene), blenders_places())
    found = entries(manifest)
    assert found["Cube"].instances == 3
    assert found["Empty 0"].reason == "has no surface"


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("shown", ["object", "primitive"])
def test_geometry_node_instances(shown, mode, build, export):
    build.far_camera()
    points = build.mesh("Points", np.random.default_rng(6).uniform(-2, 2, (40, 3)), [])
    source = build.cube("Source", link=False)
    build.instances_on_points(points, source if shown == "object" else "GeometryNodeMeshCube")
    scene, _ = export.modes[mode]()
    assert instances_of(scene) == {"Source" if shown == "object" else "Points": 40}
    assert sum(len(mesh.triangles) > 0 for mesh in scene.meshes) == 1
    assert scene.triangle_count == 480
    np.testing.assert_array_equal(places(scene), blenders_places())


@pytest.mark.parametrize("mode", MODES)
def test_a_mesh_that_nothing_shows_is_not_carried(mode, build, export):
    build.far_camera()
    build.mesh("Points", [(0, 0, 0)], [])
    build.square("Lost").location.x = np.nan
    build.square("Kept")
    scene, _ = export.modes[mode]()
    assert scene.objects == ("Kept",)
    assert [mesh.name for mesh in scene.meshes] == ["Kept"]


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("kind", ["HAIR", "EMITTER"])
def test_particle_instances(kind, mode, build, export, entries):
    build.far_camera()
    ground, source = build.square("Ground", 4), build.cube("Source", 0.2, location=(9, 9, 9))
    ground.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = ground.particle_systems[0].settings
    settings.type, settings.count = kind, 25
    settings.render_type, settings.instance_object = "OBJECT", source
    if kind == "EMITTER":
        settings.frame_start = settings.frame_end = 1
        settings.lifetime, settings.physics_type = 100, "NO"
        bpy.context.scene.frame_set(5)
    scene, manifest = export.modes[mode]()
    assert instances_of(scene) == {"Ground": 1, "Source": 26}
    assert len(scene.meshes) == 2
    assert entries(manifest)["Source"].instances == 26
    if mode == "VIEWPORT":
        np.testing.assert_array_equal(places(scene), blenders_places())
    assert "hair" not in {u.feature for u in manifest.unmodelled}


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("kind", ["VERTS", "FACES"])
def test_instances_on_vertices_and_faces(kind, mode, build, export):
    build.far_camera()
    parent, child = build.cube("Parent", 4), build.square("Child", 0.5)
    child.parent = parent
    parent.instance_type = kind
    parent.show_instancer_for_render = parent.show_instancer_for_viewport = False
    scene, manifest = export.modes[mode]()
    # The viewport draws the child itself too.
    own = mode == "VIEWPORT"
    assert instances_of(scene) == {"Child": (8 if kind == "VERTS" else 6) + own}
    assert len(scene.meshes) == 1
    hidden = next(e for e in manifest.objects if e.name == "Parent")
    assert (hidden.exported, bool(hidden.reason)) == (False, True)


def test_the_instancer_is_shown_in_the_mode_that_says_so(build, export):
    build.far_camera()
    parent, child = build.cube("Parent", 4), build.square("Child", 0.5)
    child.parent = parent
    parent.instance_type = "VERTS"
    parent.show_instancer_for_viewport, parent.show_instancer_for_render = True, False
    assert instances_of(export.viewport()[0]) == {"Parent": 1, "Child": 9}
    assert instances_of(export.render()[0]) == {"Child": 8}
    parent.show_instancer_for_viewport, parent.show_instancer_for_render = False, True
    assert instances_of(export.viewport()[0]) == {"Child": 9}
    assert instances_of(export.render()[0]) == {"Parent": 1, "Child": 8}


def test_meshes_that_differ_are_not_shared(build, export):
    """One mesh datablock, but a modifier on one of its users."""
    build.far_camera()
    cube = build.cube()
    second = build.link(bpy.data.objects.new("Second", cube.data))
    second.modifiers.new("Array", "ARRAY").count = 3
    scene, _ = export.render()
    assert sorted(len(mesh.triangles) for mesh in scene.meshes) == [12, 36]
    assert {
        scene.objects[i.object]: len(scene.meshes[i.mesh].triangles) for i in scene.instances
    } == {"Cube": 12, "Second": 36}


def test_no_reference_to_blenders_data_is_kept(build, export):
    build.far_camera()
    cube = build.cube()
    scene, _ = export.viewport()
    before = scene.meshes[0].vertices.copy()
    bpy.data.meshes.remove(cube.data)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    np.testing.assert_array_equal(scene.meshes[0].vertices, before)


def test_instances_look_the_same_once_a_script_has_looked_at_their_object(build, export):
    """Blender hands out the object itself then, without its instancer's colour and display."""
    build.scene(color_type="OBJECT")
    build.far_camera()
    kit = build.collection("Kit", build.cube(link=False, color=(0, 0, 1, 1)))
    for name, display in (("Empty", "TEXTURED"), ("Wire", "WIRE")):
        empty = build.empty(name, color=(1, 0, 0, 0.5))
        empty.instance_type, empty.instance_collection = "COLLECTION", kit
        empty.display_type = display
    bpy.context.view_layer.update()

    def seen():
        scene, manifest = export.viewport()
        features = [(u.feature, u.detail) for u in manifest.unmodelled]
        return [i.colors.tolist() for i in scene.instances], features

    before = seen()
    assert before[0] == [[[1, 0, 0, 0.5]]]
    assert len(before[1]) == 2
    for evaluated in bpy.context.evaluated_depsgraph_get().ids:
        assert evaluated.name
    assert seen() == before
