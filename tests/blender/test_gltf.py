"""What Blender's exporter writes as glTF is read as Blender's importer reads it, and as it was."""

from __future__ import annotations

from itertools import pairwise

import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix
from reference_tracer.tracer.vector import transform_points
from reference_tracer_meshes.gltf import read as read_gltf

from ..meshes.gltf_build import Build, inverse_binds

# Blender's matrices, poses and shape keys are float32: each rounds by 6e-8 of the scene's size.
ROUNDINGS = 32 * 2.0**-24


def evaluated() -> dict[str, np.ndarray]:
    """The triangles of each mesh object that the scene shows, in world space: (n, 3, 3)."""
    found: dict[str, list[np.ndarray]] = {}
    depsgraph = bpy.context.evaluated_depsgraph_get()
    for instance in depsgraph.object_instances:
        obj = instance.object
        if obj.type != "MESH":
            continue
        mesh = obj.to_mesh()
        mesh.calc_loop_triangles()
        points = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", points)
        corners = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", corners)
        world = transform_points(np.array(instance.matrix_world), points.reshape(-1, 3).T).T
        found.setdefault(obj.name, []).append(world[corners.reshape(-1, 3)])
        obj.to_mesh_clear()
    return {name: np.concatenate(parts) for name, parts in found.items()}


def ours(path) -> tuple[dict[str, np.ndarray], tuple[str, ...]]:
    """The same of a file, with its Y up turned into Blender's Z up; and the notes."""
    found: dict[str, list[np.ndarray]] = {}
    contents = read_gltf(path)
    for mesh, matrix, name in contents.placed:
        x, y, z = transform_points(matrix, mesh.vertices.T)
        world = np.stack((x, -z, y), axis=1)
        found.setdefault(name, []).append(world[mesh.triangles])
    return {name: np.concatenate(parts) for name, parts in found.items()}, contents.notes


def exported(tmp_path, suffix: str, **options):
    kind = {"glb": "GLB", "gltf": "GLTF_SEPARATE"}[suffix]
    path = tmp_path / f"a.{suffix}"
    done = bpy.ops.export_scene.gltf(filepath=str(path), export_format=kind, **options)
    assert done == {"FINISHED"}
    return path


def imported(path) -> dict[str, np.ndarray]:
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert bpy.ops.import_scene.gltf(filepath=str(path)) == {"FINISHED"}
    for collection in bpy.data.collections:
        if collection.name == "glTF_not_exported":  # shapes of bones, which no file holds
            collection.hide_viewport = True
    return evaluated()


def check_same(found: dict[str, np.ndarray], wanted: dict[str, np.ndarray]) -> None:
    assert found.keys() == wanted.keys()
    size = max(np.abs(triangles).max() for triangles in wanted.values())
    for name, triangles in wanted.items():
        assert found[name].shape == triangles.shape, name
        assert np.abs(found[name] - triangles).max() <= ROUNDINGS * size, name


def random_mesh(build, rng, name: str, rows: int = 6):
    """A strip with random heights, of two materials.

    It is of triangles: a quadrilateral is cut in two by its shape, which a pose changes.
    """
    points = [(x, y, rng.normal()) for x in range(rows) for y in range(2)]
    faces = [(k, k + 2, k + 1)[:: (-1) ** k] for k in range(2 * rows - 2)]
    obj = build.mesh(name, points, faces)
    for k in range(2):
        obj.data.materials.append(bpy.data.materials.new(f"{name} {k}"))
    for face in obj.data.polygons:
        face.material_index = int(face.index >= rows)
    return obj


def placed(build, rng):
    """Objects below one another, negatively scaled, sharing a mesh, in a collection's copies."""
    root = build.link(bpy.data.objects.new("Root", None))
    root.location, root.scale = rng.normal(size=3), (2, 2, 2)
    root.rotation_euler = Euler(rng.normal(size=3))
    parent = random_mesh(build, rng, "Parent")
    parent.parent, parent.scale = root, (-1.5, 1.5, 1.5)
    parent.rotation_euler = Euler(rng.normal(size=3))
    child = build.mesh("Child", rng.normal(size=(3, 3)), [(0, 1, 2)])
    child.parent, child.scale = parent, (1, -2, 0.25)
    child.matrix_parent_inverse = Matrix.Translation(rng.normal(size=3))
    twin = build.link(bpy.data.objects.new("Twin", parent.data))
    twin.location = rng.normal(size=3)


def keyed(build, rng):
    """Shape keys with values, one of them muted by a value of zero."""
    obj = random_mesh(build, rng, "Keyed")
    obj.location = 3, 4, 5
    obj.shape_key_add(name="Basis")
    for value in (0.3, 0.0, 0.85):
        key = obj.shape_key_add(name=f"Key {value}")
        for point in key.data:
            point.co = [c + d for c, d in zip(point.co, rng.normal(size=3), strict=True)]
        key.value = value


def rigged(build, rng):
    """A strip along two bones, the second bent and moved; and a shape key before the bend."""
    obj = random_mesh(build, rng, "Skinned", rows=9)
    armature = bpy.data.armatures.new("Armature")
    rig = build.link(bpy.data.objects.new("Rig", armature))
    rig.location, rig.rotation_euler = (1, 2, 3), (0.3, 0.2, 0.1)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    ends = (0, 0, 0), (4, 0, 1), (8, 1, 0)
    parent = None
    for k in range(2):
        bone = armature.edit_bones.new(f"Bone {k}")
        bone.head, bone.tail, bone.parent = ends[k], ends[k + 1], parent
        parent = bone
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.parent = rig
    obj.modifiers.new("Armature", "ARMATURE").object = rig
    groups = [obj.vertex_groups.new(name=f"Bone {k}") for k in range(2)]
    for vertex in obj.data.vertices:
        share = float(np.clip(vertex.co.x / 8, 0, 1))
        groups[0].add([vertex.index], 1 - share, "REPLACE")
        groups[1].add([vertex.index], share, "REPLACE")
    bend = rig.pose.bones["Bone 1"]
    bend.rotation_mode, bend.rotation_euler = "XYZ", (0.9, -0.4, 0.7)
    bend.location = 0.1, 0.2, 0.3
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Key")
    key.data[3].co.z += 2
    key.value = 0.5


SCENES = {"placed": placed, "keyed": keyed, "rigged": rigged}


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
def test_all_that_blender_exports_by_default(suffix, build, tmp_path, rng):
    """The rig at rest, which is what the exporter stores by default."""
    for make in SCENES.values():
        make(build, rng)
    bpy.data.armatures["Armature"].pose_position = "REST"
    scene = evaluated()
    path = exported(tmp_path, suffix)
    found, notes = ours(path)
    assert len(found) == 5 and not notes
    check_same(found, scene)
    check_same(found, imported(path))


@pytest.mark.parametrize("name", SCENES)
def test_a_pose(name, build, tmp_path, rng):
    SCENES[name](build, rng)
    scene = evaluated()
    path = exported(tmp_path, "glb", export_rest_position_armature=False)
    found, notes = ours(path)
    assert not notes
    check_same(found, scene)
    check_same(found, imported(path))


def every(found: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """All triangles, in an order of their own, each from its corner with the least x."""
    triangles = np.concatenate(list(found.values()))
    first = triangles[:, :, 0].argmin(axis=1)[:, None] + np.arange(3)
    triangles = np.take_along_axis(triangles, first[:, :, None] % 3, axis=1)
    return {"": triangles[np.lexsort(np.round(triangles.mean(axis=1), 3).T)]}


def test_copies_of_a_collection(build, tmp_path, rng):
    """Each is a node below the empty object that makes it."""
    collection = bpy.data.collections.new("Collection")
    obj = random_mesh(build, rng, "In Collection")
    collection.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    for k in range(2):
        copy = build.link(bpy.data.objects.new(f"Copy {k}", None))
        copy.instance_type, copy.instance_collection = "COLLECTION", collection
        copy.location, copy.rotation_euler = rng.normal(size=3), rng.normal(size=3)
    scene = evaluated()
    path = exported(tmp_path, "glb")
    found, _ = ours(path)
    assert len(found) == 2
    check_same(every(found), every(scene))
    check_same(every(found), every(imported(path)))


def test_instances_of_a_mesh(build, tmp_path, rng):
    first = random_mesh(build, rng, "Instanced")
    objects = [first, *(build.link(bpy.data.objects.new("Other", first.data)) for _ in range(4))]
    parent = build.link(bpy.data.objects.new("Parent", None))
    parent.location = 1, 2, 3
    for obj in objects:
        obj.parent = parent
        obj.location, obj.rotation_euler = 9 * rng.normal(size=3), rng.normal(size=3)
        obj.scale = rng.uniform(0.5, 2, 3)
    scene = evaluated()
    path = exported(tmp_path, "glb", export_gpu_instances=True)
    assert b"EXT_mesh_gpu_instancing" in path.read_bytes()
    contents = read_gltf(path)
    assert len(contents.placed) == 5 and len({id(p.mesh) for p in contents.placed}) == 1
    found, _ = ours(path)
    check_same(every(found), every(scene))
    check_same(every(found), every(imported(path)))


def random_matrix(rng) -> list[float]:
    """A rotation, a scale and a move, by columns."""
    place = Matrix.LocRotScale(rng.normal(size=3), Euler(rng.normal(size=3)), rng.uniform(1, 2, 3))
    return [x for column in place.transposed() for x in column]


def by_hand(kind: str, rng) -> Build:
    """A file of what Blender's exporter does not write, with random numbers."""
    build = Build()
    points = rng.normal(size=(12, 3)).astype(np.float32)
    if kind in ("strip", "fan"):
        mode = {"strip": 5, "fan": 6}[kind]
        mesh = build.mesh(points, rng.permutation(12).astype(np.uint8), mode=mode)
    elif kind == "quantised":
        mesh = build.mesh(np.int16(points * 9000), None)
        build.json["accessors"][0]["normalized"] = True
        build.extension("KHR_mesh_quantization", required=True)
    elif kind == "interleaved":
        mesh = build.mesh(points, None)
        mixed = np.hstack((points, np.ones((12, 2), np.float32)))
        build.json["accessors"][0]["bufferView"] = build.view(mixed.tobytes(), byteStride=20)
    else:
        mesh = build.mesh(points, None)
        for k in range(2):
            joints = np.tile(np.arange(4), (12, 1)) + 4 * k
            build.json["meshes"][mesh]["primitives"][0]["attributes"] |= {
                f"JOINTS_{k}": build.accessor(joints.astype(np.uint8)),
                f"WEIGHTS_{k}": build.accessor(np.full((12, 4), 1 / 8, np.float32)),
            }
    shown = build.node(mesh=mesh, matrix=random_matrix(rng))
    build.scene(build.node(children=[shown], matrix=random_matrix(rng), name="Parent"))
    if kind == "skin":  # of eight joints, in a chain
        joints = [build.node(translation=rng.normal(size=3).tolist()) for _ in range(8)]
        for parent, child in pairwise(joints):
            build.json["nodes"][parent]["children"] = [child]
        binds = inverse_binds(build, *rng.normal(size=(8, 3)))
        build.json["nodes"][shown]["skin"] = build.skin(joints, inverseBindMatrices=binds)
        build.json["scenes"][0]["nodes"].append(joints[0])
    return build


@pytest.mark.parametrize("kind", ["strip", "fan", "quantised", "interleaved", "skin"])
def test_what_blender_reads_but_does_not_write(kind, tmp_path, rng):
    path = by_hand(kind, rng).write(tmp_path / "a.glb")
    found, notes = ours(path)
    assert not notes
    check_same(every(found), every(imported(path)))


def test_a_light_a_camera_and_an_animation_are_named(build, tmp_path, rng):
    build.camera()
    build.link(bpy.data.objects.new("Light", bpy.data.lights.new("Light", "POINT")))
    obj = random_mesh(build, rng, "Moving")
    obj.keyframe_insert("location", frame=1)
    obj.location.x = 5
    obj.keyframe_insert("location", frame=9)
    bpy.context.scene.frame_set(1)  # whose place the exporter stores as the node's own
    scene = evaluated()
    options = {"export_cameras": True, "export_lights": True}
    found, notes = ours(exported(tmp_path, "glb", **options))
    check_same(found, scene)
    for word in ("Animations", "has 1 camera", "Lights"):
        assert any(word in note for note in notes), (word, notes)
