"""`reftrace diff`: each way in which a scene's objects differ is named, and no other."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.files.scenes import save_scene
from reference_tracer.scene import Instance, Mesh, Plane, SceneError
from reference_tracer_scene_diff.differences import differences

ROTATED = trimesh.transformations.rotation_matrix


@pytest.fixture
def scene(make):
    """A lopsided ball, a box and a cone, without symmetry in space."""
    ball = trimesh.creation.icosphere(2, radius=0.7)
    ball.vertices[:, 0] += 0.2 * ball.vertices[:, 2] ** 2
    box = trimesh.creation.box((0.8, 0.6, 1.1)).apply_translation((0.7, -0.4, -0.3))
    cone = trimesh.creation.cone(0.4, 1.3).apply_translation((-1.8, 1, -0.2))
    camera = make.camera(24, 18, eye=(0, 0, 9))
    return replace(
        make.scene(camera, *(make.mesh(s) for s in (ball, box, cone))),
        objects=("Ball", "Box", "The Cone"),
    )


def with_instance(scene, number, matrix):
    instances = list(scene.instances)
    own = instances[number]
    instances[number] = replace(own, world_from_object=matrix @ own.world_from_object)
    return replace(scene, instances=tuple(instances))


def with_mesh(scene, number, change):
    meshes = list(scene.meshes)
    meshes[number] = change(meshes[number])
    return replace(scene, meshes=tuple(meshes))


def without(scene, number):
    kept = tuple(i for i in scene.instances if i.object != number)
    return replace(scene, instances=kept)


def shuffled(mesh):
    """The same surface: float32, triangles and corners in another order."""
    rng = np.random.default_rng(3)
    order, points = rng.permutation(len(mesh.triangles)), rng.permutation(len(mesh.vertices))
    triangles = np.argsort(points)[mesh.triangles[order]]
    turns = rng.integers(0, 3, len(triangles))
    triangles = np.array([np.roll(t, k) for t, k in zip(triangles, turns, strict=True)])
    return replace(
        mesh, vertices=mesh.vertices[points].astype(np.float32), triangles=triangles, slots=None
    )


def subdivided(mesh):
    made = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).subdivide()
    return Mesh(np.array(made.vertices) * 1.01, np.array(made.faces))


def recut(mesh):
    """A box with one of its faces cut along the other diagonal."""
    t = mesh.triangles.copy()
    shared = [k for k in t[0] if k in t[1]]
    if len(shared) == 2:
        a, b = (next(k for k in t[n] if k not in shared) for n in (0, 1))
        t[0], t[1] = (a, b, shared[0]), (b, a, shared[1])
    return replace(mesh, triangles=t)


def turned_over(mesh, count=None):
    triangles = mesh.triangles.copy()
    triangles[:count] = triangles[:count, ::-1]
    return replace(mesh, triangles=triangles)


def twice(scene, matrix):
    again = Instance(1, 3, matrix, scene.instances[1].colors)
    return replace(scene, instances=(*scene.instances, again), objects=(*scene.objects, "Box.001"))


MOVED = np.eye(4)
MOVED[:3, 3] = 0.5, 0, -0.25
FAULTS = {
    "nothing": (lambda s: s, []),
    "order": (lambda s: with_mesh(s, 0, shuffled), []),
    "missing": (lambda s: without(s, 1), [("Box", "object_missing", "'Box' is missing")]),
    "moved": (
        lambda s: with_instance(s, 0, MOVED),
        [("Ball", "object_moved", "'Ball' is moved by (+0.5, +0, -0.25) m")],
    ),
    "turned": (
        lambda s: with_instance(s, 1, ROTATED(np.radians(30), (0, 0, 1), (0.7, -0.4, -0.3))),
        [("Box", "object_moved", "'Box' is turned by 30 degrees about Z")],
    ),
    "scaled": (
        lambda s: with_instance(s, 0, np.diag((100.0, 100, 100, 1))),
        [("Ball", "object_scaled", "'Ball' is scaled by 100")],
    ),
    "all Y up": (
        lambda s: with_all(s, ROTATED(np.radians(-90), (1, 0, 0))),
        [("", "scene_moved", "all objects are turned by -90 degrees about X")],
    ),
    "over": (
        lambda s: with_mesh(s, 0, turned_over),
        [("Ball", "flipped_winding", "all normals of 'Ball' are turned over")],
    ),
    "one over": (
        lambda s: with_mesh(s, 0, lambda m: turned_over(m, 1)),
        [("Ball", "flipped_winding", "the normals of 1 triangles of 'Ball' are turned over")],
    ),
    "lacks": (
        lambda s: with_mesh(s, 0, lambda m: replace(m, triangles=m.triangles[5:], slots=None)),
        [("Ball", "triangles_missing", "'Ball' lacks 5 of its triangles")],
    ),
    "level": (
        lambda s: with_mesh(s, 0, subdivided),
        [("Ball", "subdivision", "as with 1 more levels of subdivision")],
    ),
    "diagonal": (
        lambda s: with_mesh(s, 1, recut),
        [("Box", "other_diagonal", "2 of 12 triangles of 'Box' are cut otherwise")],
    ),
    "twice in place": (
        lambda s: twice(s, np.eye(4)),
        [("Box", "object_twice", "'Box' is there twice: again as 'Box.001'")],
    ),
    "twice": (
        lambda s: twice(s, MOVED),
        [("Box", "object_twice", "again as 'Box.001', moved by (+0.5, +0, -0.25) m")],
    ),
    "doubled": (
        lambda s: with_mesh(
            s, 1, lambda m: replace(m, triangles=np.vstack((m.triangles,) * 2), slots=None)
        ),
        [("Box", "object_twice", "'Box' is there 2 times in one place")],
    ),
    "renamed": (
        lambda s: replace(s, objects=("Kugel", *s.objects[1:])),
        [("Ball", "object_renamed", "'Ball' is called 'Kugel'")],
    ),
    "a format's name": (lambda s: replace(s, objects=("Ball", "Box", "The_Cone")), []),
    "other": (
        lambda s: with_mesh(s, 0, lambda m: replace(m, vertices=m.vertices**3)),
        [("Ball", "other_triangles", "'Ball' has other triangles: 320 triangles, not 320; ")],
    ),
    "two": (
        lambda s: without(with_instance(s, 0, MOVED), 1),
        [("Ball", "object_moved", "moved by"), ("Box", "object_missing", "is missing")],
    ),
}


def with_all(scene, matrix):
    for number in range(len(scene.instances)):
        scene = with_instance(scene, number, matrix)
    return scene


@pytest.mark.parametrize("name", FAULTS)
def test_what_differs_is_named_and_nothing_else(scene, name):
    make_, expected = FAULTS[name]
    found = differences(scene, make_(scene))
    assert [(d.object, d.kind) for d in found] == [(o, k) for o, k, _ in expected]
    for difference, (_, _, words) in zip(found, expected, strict=True):
        assert words in difference.sentence


@pytest.mark.parametrize("degrees, up", [(-90, "y"), (90, "z")])
@pytest.mark.parametrize("factor", [1, 100])
def test_a_file_with_another_axis_up_is_told_which(scene, degrees, up, factor):
    turned = ROTATED(np.radians(degrees), (1, 0, 0)) @ np.diag((factor, factor, factor, 1.0))
    [found] = differences(scene, with_all(scene, turned))
    assert found.advice == f"if the file has {up.upper()} up, --set up={up} turns it"


def test_beside_what_all_have_in_common_the_rest_is_named(scene):
    other = with_mesh(with_all(scene, np.diag((0.01, 0.01, 0.01, 1))), 2, turned_over)
    assert [d.kind for d in differences(scene, other)] == ["scene_moved", "flipped_winding"]


def test_a_file_without_objects_is_held_against_all(scene):
    joined = replace(
        scene,
        instances=tuple(replace(i, object=0) for i in scene.instances),
        objects=("file",),
    )
    assert not differences(scene, joined)
    [found] = differences(scene, with_instance(joined, 0, MOVED))
    assert found.kind == "other_triangles"


def test_the_command_prints_and_writes(scene, tmp_path, capsys, exit_code):
    save_scene(tmp_path / "a.npz", scene)
    save_scene(tmp_path / "b.npz", with_instance(scene, 0, MOVED))
    a, b, out = (str(tmp_path / name) for name in ("a.npz", "b.npz", "diff.json"))
    assert exit_code(["diff", a, a]) == 0
    assert "3 objects and 3 objects: the same" in capsys.readouterr().out
    assert exit_code(["diff", a, b, "--json", out]) == 2
    said = capsys.readouterr().out
    assert "'Ball' is moved by (+0.5, +0, -0.25) m\n  what to do: compare its world" in said
    [held] = json.loads((tmp_path / "diff.json").read_text(encoding="utf-8"))["differences"]
    assert held["object"] == "Ball" and held["kind"] == "object_moved"
    assert exit_code(["diff", a, str(tmp_path / "none.glb")]) == 4
    assert "there is no file" in capsys.readouterr().err


def test_infinite_planes_are_compared(scene):
    floor = Plane(3, np.array((0.0, 0, -1)), np.array((0.0, 0, 1)), np.ones(4))
    own = replace(scene, planes=(floor,), objects=(*scene.objects, "Floor"))
    slid = replace(floor, point=np.array((5.0, 3, -1)))
    assert not differences(own, replace(own, planes=(slid,)))
    for point, normal in (((0.0, 0, -1.1), floor.normal), (floor.point, -floor.normal)):
        other = replace(floor, point=np.array(point), normal=np.array(normal))
        [found] = differences(own, replace(own, planes=(other,)))
        assert found.kind == "plane_moved"
    [found] = differences(own, scene)
    assert found.sentence == "'Floor' is missing"
    [found] = differences(scene, own)
    assert found.kind == "object_added"


def test_an_object_too_large_to_be_compared_is_named(scene):
    for size in (1e308, 1e160):
        large = with_instance(scene, 1, np.diag((size, size, size, 1)))
        with pytest.raises(SceneError, match="'Box' is too large to be compared"):
            differences(scene, large)
