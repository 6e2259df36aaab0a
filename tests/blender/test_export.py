"""What of a Blender scene reaches the tracer, against Blender's own evaluated data."""

from __future__ import annotations

import math
from collections import Counter

import bpy
import numpy as np
import pytest

from .exporter_scenes import SCENES, make_scene

MODES = ("VIEWPORT", "RENDER")


def exported(scene) -> Counter:
    """Count each appearance: its object, its matrix and its triangles' corners, to the bit."""
    return Counter(
        (
            scene.objects[i.object],
            i.world_from_object.tobytes(),
            mesh.vertices[mesh.triangles].tobytes(),
        )
        for i in scene.instances
        for mesh in [scene.meshes[i.mesh]]
    )


def blenders() -> tuple[Counter, int]:
    """Count the same by Blender's `to_mesh` in the viewport, where a text is a mesh; and meshes."""
    out: Counter = Counter()
    meshes = set()
    for item in bpy.context.evaluated_depsgraph_get().object_instances:
        obj = item.object
        if not item.show_self or obj.type != "MESH":
            continue
        mesh = obj.to_mesh()
        mesh.calc_loop_triangles()
        points = np.array([v.co for v in mesh.vertices], np.float32)
        corners = [t.vertices[:] for t in mesh.loop_triangles]
        if corners:
            matrix = np.array(item.matrix_world, float)
            out[obj.name_full, matrix.tobytes(), points[corners].tobytes()] += 1
            meshes.add(obj.data.as_pointer())
        obj.to_mesh_clear()
    return out, len(meshes)


def nested(build):
    """Instances of instances, one of them mirrored."""
    inner = build.collection("Inner", build.cube(link=False, location=(1, 0, 0)))
    empty = build.instances("Nested", inner, location=(0, 2, 0))
    bpy.context.scene.collection.objects.unlink(empty)
    outer = build.collection("Outer", empty, build.square(link=False))
    outer.instance_offset = (0.5, 0, 0)
    for x in range(3):
        place = {"location": (3 * x, 0, 0), "rotation": (0, 0, x), "scale": (1 - x, 2, 1)}
        empty = build.instances(f"Empty {x}", outer, **place)


def on_points(build):
    """Of a mesh that the nodes make."""
    points = np.random.default_rng(6).uniform(-2, 2, (40, 3))
    build.instances_on_points(build.mesh("Points", points, []), "GeometryNodeMeshCube")


def particles(build, kind="EMITTER"):
    ground, source = build.square("Ground", 4), build.cube("Source", 0.2, location=(9, 9, 9))
    ground.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = ground.particle_systems[0].settings
    settings.type, settings.count = kind, 25
    settings.render_type, settings.instance_object = "OBJECT", source
    if kind == "EMITTER":
        settings.frame_start = settings.frame_end = 1
        settings.lifetime, settings.physics_type = 100, "NO"
        bpy.context.scene.frame_set(5)


def hair(build):
    particles(build, "HAIR")


def on_vertices(build, kind="VERTS"):
    parent, child = build.cube("Parent", 4), build.square("Child", 0.5)
    child.parent = parent
    parent.instance_type = kind


def on_faces(build):
    on_vertices(build, "FACES")


def of_an_excluded_collection(build):
    collection = build.collection("Kit", build.cube(link=False), link=True)
    bpy.context.view_layer.layer_collection.children["Kit"].exclude = True
    build.instances("Empty", collection)


def one_with_a_modifier(build):
    """Of two that have one mesh."""
    second = build.object("Second", build.cube().data)
    second.modifiers.new("Array", "ARRAY").count = 3


def of_no_picture(build):
    """A mesh without a face, and one of no place."""
    build.mesh("Points", [(0, 0, 0)], [])
    build.square("Flat", scale=(1, 1, 0))


INSTANCES = {
    make.__name__: make
    for make in (
        nested,
        on_points,
        particles,
        hair,
        on_vertices,
        on_faces,
        of_an_excluded_collection,
        one_with_a_modifier,
        of_no_picture,
    )
}
# Hidden by the eye alone, or a child that its parent instances: the viewport shows it otherwise.
OF_ONE_MODE = {"hidden_and_empty": "Hidden", "on_vertices": "Child", "on_faces": "Child"}


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", [*SCENES, *INSTANCES])
def test_it_is_what_blender_shows(name, mode, build, export, entries):
    """Every triangle of every appearance, in its place to the bit; and the manifest counts them."""
    if name in SCENES:
        make_scene(name, build)
    else:
        build.far_camera()
        INSTANCES[name](build)
    bpy.context.view_layer.update()
    expected, meshes = blenders()
    scene, manifest = export.modes[mode]()
    found = exported(scene)
    other = {key[0] for key in (found - expected) + (expected - found)}
    assert other == ({OF_ONE_MODE[name]} if mode == "RENDER" and name in OF_ONE_MODE else set())
    assert len(scene.meshes) == meshes + (other == {"Hidden"})
    own, triangles = entries(manifest), scene.triangle_count
    for obj, count in Counter(key[0] for key in found.elements()).items():
        assert own[obj].exported and own[obj].instances == count
    assert sum(e.instances * e.triangles for e in own.values()) == triangles > 0
    assert "hair" not in {u.feature for u in manifest.unmodelled}


def test_modifiers_have_the_level_of_the_mode(build, export):
    build.scene()
    build.camera()
    modifier = build.cube().modifiers.new("Subdivision", "SUBSURF")
    modifier.subdivision_type, modifier.levels, modifier.render_levels = "SIMPLE", 1, 2
    for (mode, run), count in zip(export.modes.items(), (4, 16), strict=True):
        scene, manifest = run()
        assert (scene.triangle_count, manifest.evaluation) == (12 * count, mode)


@pytest.mark.parametrize("mode", MODES)
def test_what_is_not_finite_is_left_out_and_counted(mode, build, export, entries):
    build.camera()
    cube, square = build.cube(), build.square()
    build.cube("Lost").location.x = math.nan
    cube.data.vertices[0].co.x = math.nan  # of three faces, in one or two triangles of each
    points = np.zeros((4, 3), np.float32)
    points[2, 0] = math.inf  # `co` would cut it off at the largest float
    square.data.attributes["position"].data.foreach_set("vector", points.ravel())
    scene, manifest = export.modes[mode]()
    found = entries(manifest)
    assert "Cube" in scene.objects and "Lost" not in scene.objects
    assert 3 <= found["Cube"].left_out <= 6
    assert found["Cube"].triangles == 12 - found["Cube"].left_out
    assert 1 <= found["Square"].left_out <= 2
    assert all(np.isfinite(mesh.vertices).all() for mesh in scene.meshes)
    assert f"  Cube: {found['Cube'].left_out} triangles left out (not finite)" in manifest.lines()
    lost = found["Lost"]
    assert (lost.exported, lost.left_out) == (False, 12) and "not finite" in lost.reason


@pytest.mark.parametrize("kind", ["FACE INT", "POINT FLOAT"])
def test_slots_are_those_of_the_loop_triangles(kind, build, export):
    """An attribute by that name may be of another kind: Blender converts it."""
    build.camera()
    mesh = build.cube().data
    domain, data_type = kind.split()
    attribute = mesh.attributes.new("material_index", data_type, domain)
    if attribute is None:
        pytest.skip("it is of no other kind in this Blender")
    attribute.data.foreach_set("value", np.arange(len(attribute.data)))
    (exported,) = export.viewport()[0].meshes
    assert exported.slots.tolist() == [t.material_index for t in mesh.loop_triangles]
    assert len(set(exported.slots)) > 1


def test_the_instancer_is_shown_in_the_mode_that_says_so(build, export, entries):
    build.far_camera()
    on_vertices(build)
    parent = bpy.data.objects["Parent"]
    for viewport, render in ((True, False), (False, True)):
        parent.show_instancer_for_viewport, parent.show_instancer_for_render = viewport, render
        for run, is_shown in ((export.viewport, viewport), (export.render, render)):
            own = entries(run()[1])["Parent"]
            assert own.exported == is_shown == (not own.reason)


def test_instances_look_the_same_once_a_script_has_looked_at_their_object(build, export):
    """Blender hands out the object itself then, without its instancer's colour and display."""
    build.scene(color_type="OBJECT")
    build.far_camera()
    kit = build.collection("Kit", build.cube(link=False, color=(0, 0, 1, 1)))
    for name, display in (("Empty", "TEXTURED"), ("Wire", "WIRE")):
        empty = build.instances(name, kit, color=(1, 0, 0, 0.5))
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
