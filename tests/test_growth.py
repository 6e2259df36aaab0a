"""Work grows with a scene as the scene does: four times as many objects take four times as much."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.comparison.mesh_diagnosis import diagnosed
from reference_tracer.files.scenes import Account, load_scene, save_scene
from reference_tracer.opened import file_manifest
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.tracer.progress import result_of

from .files.old_scenes import old_arrays
from .growth import operations

FEW, MANY = 60, 240


def of_new_file(scene, path):
    save_scene(path, scene)
    return lambda: load_scene(path)


def of_old_file(scene, path):
    np.savez(path, **old_arrays(scene))
    return lambda: load_scene(path)


def of_writing(scene, path):
    return lambda: save_scene(path, scene)


def of_manifest(scene, path):
    return lambda: file_manifest(path, scene, Account())


def of_diagnosis(scene, path):
    manifest = file_manifest(path, scene, Account())
    return lambda: result_of(diagnosed(scene, manifest))


@pytest.mark.parametrize("of", [of_new_file, of_old_file, of_writing, of_manifest, of_diagnosis])
def test_work_grows_as_the_scene_does(of, make, tmp_path):
    """Each object has its own mesh, instance and plane."""
    taken = []
    for n in (FEW, MANY):
        scene = Scene(
            make.camera(),
            [Mesh(np.eye(3) + k, [[0, 1, 2]]) for k in range(n)],
            [Instance(k, k, np.eye(4)) for k in range(n)],
            [Plane(k, (0, 0, -k), (0, 0, 1)) for k in range(n)],
            objects=tuple(map(str, range(n))),
        )
        work = of(scene, tmp_path / "scene.npz")
        work()  # what is kept from now on is not counted
        taken.append(operations(work))
    assert taken[1] < 1.05 * MANY / FEW * taken[0]
