"""What of a Blender scene reaches the tracer, against Blender's own evaluated data."""

from __future__ import annotations

import math

import bpy
import numpy as np
import pytest
from reference_tracer.tracer.vector import transform_points

MODES = ("VIEWPORT", "RENDER")


def own_triangles(obj) -> int:
    """Count an object's triangles by Blender's `to_mesh`, in the viewport's evaluation."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    evaluated.to_mesh_clear()
    return count


def world_corners(obj) -> np.ndarray:
    """Return the corners of an object's triangles in world space, float64, from Blender's data."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    matrix = np.array(evaluated.matrix_world, float)
    corners = [[mesh.vertices[v].co[:] for v in t.vertices] for t in mesh.loop_triangles]
    evaluated.to_mesh_clear()
    points = np.array(corners, float).reshape(-1, 3)
    return (points @ matrix[:3, :3].T + matrix[:3, 3]).reshape(-1, 3, 3)


def exported_corners(scene, name: str) -> np.ndarray:
    """Return the corners of all triangles of one object as the tracer has them."""
    out = []
    for instance in scene.instances:
        if scene.objects[instance.object] == name:
            mesh = scene.meshes[instance.mesh]
            points = transform_points(instance.world_from_object, mesh.vertices.T).T
            out.append(points[mesh.triangles])
    return np.concatenate(out)


def test_modifiers_have_the_level_of_the_mode(build, export):
    build.scene()
    build.camera()
    cube = build.cube()
    modifier = cube.modifiers.new("Subdivision", "SUBSURF")
    modifier.subdivision_type, modifier.levels, modifier.render_levels = "SIMPLE", 1, 2
    found = {mode: run() for mode, run in export.modes.items()}
    assert {m: scene.triangle_count for m, (scene, _) in found.items()} == {
        "VIEWPORT": 12 * 4,
        "RENDER": 12 * 16,
    }
    assert {m: manifest.evaluation for m, (_, manifest) in found.items()} == {m: m for m in MODES}


@pytest.mark.parametrize("mode", MODES)
def test_every_type_gives_the_triangles_that_blender_makes(mode, build, export, entries):
    build.camera()
    made = [build.cube(), build.text(), build.bevelled_curve(), build.surface(), build.metaball()]
    made[3].data.resolution_u = made[3].data.resolution_v = 4
    for curve in (made[2].data, made[3].data):
        curve.render_resolution_u = getattr(curve, "resolution_u", 0)
    scene, manifest = export.modes[mode]()
    found = entries(manifest)
    for obj in made:
        count = own_triangles(obj)
        assert count > 10
        assert found[obj.name].exported
        assert found[obj.name].triangles == count
        assert found[obj.name].type == obj.type
    assert scene.triangle_count == sum(own_triangles(obj) for obj in made)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("name", ["negative", "sheared", "zero", "rotated"])
def test_world_vertices_are_blenders_in_float64(name, mode, build, export):
    build.far_camera()
    cube = build.cube(
        location=(1.1, -2.2, 3.3),
        rotation=(0.3, 0.7, 1.9),
        scale={
            "negative": (-1, 2, 0.5),
            "sheared": (1, 3, 1),
            "zero": (1, 1, 0),
            "rotated": (1, 1, 1),
        }[name],
    )
    if name == "sheared":
        cube.parent = build.empty("Parent", rotation=(0.2, 0.9, 0.4), scale=(0.3, 2, 1))
    bpy.context.view_layer.update()
    scene, _ = export.modes[mode]()
    # A few roundings of float64 on numbers of some metres.
    np.testing.assert_allclose(
        exported_corners(scene, "Cube"), world_corners(cube), rtol=0, atol=1e-14
    )
    assert scene.meshes[0].vertices.dtype == np.float32
    assert np.linalg.det(scene.instances[0].world_from_object[:3, :3]) == pytest.approx(
        np.linalg.det(np.array(cube.matrix_world, float)[:3, :3]), abs=1e-12
    )


@pytest.mark.parametrize("mode", MODES)
def test_n_gons_are_blenders_own_loop_triangles(mode, build, export):
    build.camera()
    angles = np.arange(10) * math.tau / 10
    star = [
        (r * math.cos(a), r * math.sin(a), 0) for a, r in zip(angles, [2, 0.7] * 5, strict=True)
    ]
    obj = build.mesh("Star", star, [range(10)])
    scene, _ = export.modes[mode]()
    np.testing.assert_array_equal(exported_corners(scene, "Star"), world_corners(obj))
    assert scene.triangle_count == 8
    a, b, c = np.moveaxis(exported_corners(scene, "Star"), 1, 0)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert area == pytest.approx(10 * 2 * 0.7 * math.sin(math.tau / 10) / 2)


@pytest.mark.parametrize("mode", MODES)
def test_vertices_that_are_not_finite_are_left_out_and_counted(mode, build, export, entries):
    build.camera()
    cube, square = build.cube(), build.square()
    cube.data.vertices[0].co.x = math.nan  # of three faces, in one or two triangles of each
    touching = sum(0 in face.vertices for face in cube.data.polygons)
    points = np.zeros((4, 3), np.float32)
    points[2, 0] = math.inf  # `co` would cut it off at the largest float
    square.data.attributes["position"].data.foreach_set("vector", points.ravel())
    scene, manifest = export.modes[mode]()
    found = entries(manifest)
    assert touching == 3
    assert 3 <= found["Cube"].left_out <= 6
    assert found["Cube"].triangles == 12 - found["Cube"].left_out
    assert 1 <= found["Square"].left_out <= 2
    assert all(np.isfinite(mesh.vertices).all() for mesh in scene.meshes)
    assert f"  Cube: {found['Cube'].left_out} triangles left out (not finite)" in manifest.lines()


@pytest.mark.parametrize("mode", MODES)
def test_a_matrix_that_is_not_finite_leaves_the_object_out(mode, build, export, entries):
    build.camera()
    build.cube("Lost").location.x = math.nan
    build.cube("Kept")
    scene, manifest = export.modes[mode]()
    assert scene.objects == ("Kept",)
    lost = entries(manifest)["Lost"]
    assert (lost.exported, lost.left_out) == (False, 12)
    assert "not finite" in lost.reason


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


def test_the_mesh_in_the_editor_is_exported_as_its_modifiers_make_it(build, export):
    build.camera()
    cube = build.cube(location=(0.3, 0, 0))
    cube.modifiers.new("Array", "ARRAY").count = 2
    before = exported_corners(export.viewport()[0], "Cube")
    bpy.context.view_layer.objects.active = cube
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        scene, _ = export.viewport()
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
    np.testing.assert_array_equal(exported_corners(scene, "Cube"), before)


@pytest.mark.parametrize("color_type", ["MATERIAL", "OBJECT", "SINGLE", "RANDOM", "VERTEX"])
def test_color_attributes_are_carried_only_where_they_are_shown(color_type, build, export):
    build.scene(color_type=color_type)
    build.camera()
    build.color_attribute(build.cube(), "CORNER")
    (mesh,) = export.viewport()[0].meshes
    assert (mesh.corner_colors is not None) == (color_type == "VERTEX")
