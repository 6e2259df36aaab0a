"""Work grows as the number of things does: nothing is done or made for each pair of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import CONVENTIONS, of_frames, read, texts
from reference_tracer.comparison.mesh_diagnosis import diagnosed
from reference_tracer.files.scenes import Account, load_scene, save_scene
from reference_tracer.methods import Method
from reference_tracer.opened import file_manifest
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer_grading.class_folder import ClassFolder
from reference_tracer_grading.external import Run
from reference_tracer_grading.judging import names
from reference_tracer_grading.subjects.triangle import TRIANGLE
from reference_tracer_meshes.load import load_meshes
from reference_tracer_scene_diff.differences import differences

from .growth import of_each_pair
from .meshes.gltf_build import Build

pytestmark = pytest.mark.slow
MANY = 120
SOME = 40  # where each thing takes many lines
# Of all pairs, bytes: lists and dicts grow by leaps, which is less.
LEAST = 1 << 17


@pytest.fixture
def scene_of(make):
    """Return a scene in which each object has its own mesh, instance and plane."""

    def scene(n):
        return Scene(
            make.camera(),
            [Mesh(np.eye(3) + k, [[0, 1, 2]]) for k in range(n)],
            [Instance(k, k, np.eye(4)) for k in range(n)],
            [Plane(k, (0, 0, -k), (0, 0, 1)) for k in range(n)],
            objects=tuple(map(str, range(n))),
        )

    return scene


def of_new_file(scene, path):
    save_scene(path, scene)
    return lambda: load_scene(path)


def of_writing(scene, path):
    return lambda: save_scene(path, scene)


def of_manifest(scene, path):
    return lambda: file_manifest(path, scene, Account())


def of_diagnosis(scene, path):
    manifest = file_manifest(path, scene, Account())
    return lambda: result_of(diagnosed(scene, manifest))


def of_tracing(scene, path):
    without = replace(scene, planes=())  # each is tested with every ray
    return lambda: render(without, Settings(Method.CERTIFIED))


def of_differences(scene, path):
    larger = np.diag((2.0, 2, 2, 1))
    other = replace(
        scene, instances=[replace(i, world_from_object=larger) for i in scene.instances]
    )
    return lambda: differences(scene, other)


def of_materials(scene, path):
    n = len(scene.meshes)
    mesh = Mesh(np.eye(3), [[0, 1, 2]] * n, slots=np.arange(n))
    colors = np.full((n, 4), 0.5, np.float32)
    save_scene(path, replace(scene, meshes=[mesh], instances=[Instance(0, 0, np.eye(4), colors)]))
    return lambda: load_scene(path)


def of_frames_of_a_camera(scene, path):
    views = [View(scene.camera, f"{k}.png") for k in range(len(scene.meshes))]
    [text] = texts(views, CONVENTIONS["nerf"]).values()
    path.with_suffix(".json").write_text(text)
    return lambda: of_frames(read(path.with_suffix(".json"), "nerf"), range(len(views)))


def of_an_obj(scene, path):
    corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    faces = (f"o {k}\n{corners}f {' '.join(str(4 * k + c) for c in (1, 2, 3, 4))}\n"
             for k in range(len(scene.meshes)))  # fmt: skip
    path.with_suffix(".obj").write_text("".join(faces))
    return lambda: load_meshes(path.with_suffix(".obj"))


def of_a_glb(scene, path):
    build = Build()
    build.scene(*(build.node(mesh=build.mesh(), name="same") for _ in scene.meshes))
    build.write(path.with_suffix(".glb"))
    return lambda: load_meshes(path.with_suffix(".glb"))


def of_students(scene, path):
    same = [Run("same")] * len(scene.meshes)
    own = [path.parent / str(k) / "ray.py" for k in range(len(scene.meshes))]
    return lambda: ClassFolder(path.parent, TRIANGLE, names([*own, *same]))


WORKS = {
    of_new_file: MANY,
    of_writing: MANY,
    of_manifest: MANY,
    of_diagnosis: SOME,
    of_tracing: MANY,
    of_differences: SOME,
    of_materials: MANY,
    of_frames_of_a_camera: MANY,
    of_an_obj: MANY,
    of_a_glb: MANY,
    of_students: MANY,
}


@pytest.mark.parametrize("of", WORKS)
def test_nothing_is_done_for_each_pair(of, scene_of, tmp_path):
    many = WORKS[of]
    lines, allocated = of_each_pair(lambda n: of(scene_of(n), tmp_path / "scene.npz"), many)
    assert abs(lines) < 0.05 and allocated * many**2 < LEAST


def test_what_is_done_for_each_pair_is_noticed():
    """In Python, and by numpy, whose intermediate arrays have a number for each of the others."""

    def by_python(n):
        return lambda: [[k for k in range(n) if k == own] for own in range(n)]

    def by_numpy(n):
        return lambda: [np.flatnonzero(np.arange(n) * 2.0 == k) for k in range(n)]

    assert of_each_pair(by_python, MANY)[0] > 0.9
    assert of_each_pair(by_numpy, MANY)[1] * MANY**2 > LEAST


def test_what_others_left_counts_for_nobody():
    """A collection, which comes at any time, runs the last lines of what is freed."""

    class Left:
        def __init__(self):
            self.itself = self

        def __del__(self):
            for _ in range(MANY**2):
                pass

    def work_of(n):
        Left()
        return lambda: [[] for _ in range(n * 1000)]  # which makes Python collect

    assert of_each_pair(work_of, 1)[0] == 0
