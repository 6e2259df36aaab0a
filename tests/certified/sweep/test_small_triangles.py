"""Of dense instances, triangles that cover no pixel are left out, and nothing else changes."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.certified.sweep import small_triangles as module
from reference_tracer.certified.sweep.boxes import InstanceBoxes
from reference_tracer.certified.sweep.film import Film
from reference_tracer.certified.sweep.small_triangles import SmallTriangles
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Region, Scene
from reference_tracer.tracer.settings import Settings

FIELDS = ("instance_index", "triangle_index", "t", "barycentrics", "certainty", "color")


def small_in(scene: Scene, film: Film, region: Region) -> SmallTriangles:
    with np.errstate(all="ignore"):
        return SmallTriangles(scene, film, region, InstanceBoxes.of(scene, film).area)


@pytest.fixture
def dense_scene(make) -> Scene:
    """Spheres before one another, of two meshes, of many triangles a pixel, and one that is not."""
    spheres = [
        make.mesh(trimesh.creation.icosphere(subdivisions=3)),
        make.mesh(trimesh.creation.uv_sphere(count=(24, 24))),
        make.mesh(trimesh.creation.icosphere(subdivisions=1)),
    ]
    rng, instances = np.random.default_rng(3), []
    for k, place in enumerate(rng.uniform(-1, 1, (14, 3)) * (0.5, 0.4, 2) - (0, 0, 4)):
        matrix = np.diag((0.1, 0.12, 0.1, 1.0) if k else (2.0, 2, 2, 1))
        matrix[:3, 3] = place if k else (1.5, 1, -8)
        instances.append(Instance(k % 2 if k else 2, 0, matrix))
    return Scene(make.camera(60, 44, half=0.2), spheres, instances, objects=("A",))


@pytest.mark.parametrize("together", [1 << 15, 3000, 100])
@pytest.mark.parametrize("orthographic", [False, True])
def test_the_picture_is_the_same(make, dense_scene, orthographic, together, monkeypatch):
    camera = make.camera(60, 44, half=0.6 if orthographic else 0.2, orthographic=orthographic)
    scene = Scene(camera, dense_scene.meshes, dense_scene.instances, objects=("A",))
    small = small_in(scene, Film(camera), camera.region)
    assert small.is_dense[1:].all() and not small.is_dense[0]
    some = np.flatnonzero(scene.instance_meshes == 0)
    total, each = 0, len(scene.meshes[0].vertices)
    monkeypatch.setattr(module, "_TRIANGLES", together)
    for part in filter(None, small.within(scene.meshes[0], some)):
        _, own, counts, corners, used, triangle = part
        copy = np.repeat(np.arange(len(own)), counts)
        assert np.array_equal(used[corners], scene.meshes[0].triangles[triangle].T + each * copy)
        total += counts.sum()
    assert 0 < total < 0.7 * len(some) * len(scene.meshes[0].triangles)
    found = render(scene, Settings("certified"))
    monkeypatch.setattr(module, "_PER_PIXEL", np.inf)
    whole = render(scene, Settings("certified"))
    for name in FIELDS:
        assert np.array_equal(getattr(found, name), getattr(whole, name), equal_nan=True), name
    assert (found.triangle_index >= 0).sum() > 300
