"""Of dense instances, only triangles that cover no pixel are left out; and nothing else changes."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.certified.sweep import small_triangles as module
from reference_tracer.certified.sweep.boxes import InstanceBoxes, boxes_of
from reference_tracer.certified.sweep.chunks import Chunk, expand
from reference_tracer.certified.sweep.film import Film
from reference_tracer.certified.sweep.small_triangles import SmallTriangles
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Region, Scene
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ...sampled import sampled
from ...tracer.hostile_scenes import offsets
from .test_film import sound_camera

FIELDS = ("instance_index", "triangle_index", "t", "barycentrics", "certainty", "color")


def small_in(scene: Scene, film: Film, region: Region) -> SmallTriangles:
    with np.errstate(all="ignore"):
        return SmallTriangles(scene, film, region, InstanceBoxes.of(scene, film).area)


@pytest.mark.slow
@sampled(4)
def test_what_is_left_out_has_no_pixel_in_its_box(make, monkeypatch, every):
    monkeypatch.setattr(module, "_PER_PIXEL", 0.0)
    left_out, kept, in_vain = 0, 0, 0
    for seed in range(0, 250, every):
        rng = np.random.default_rng(seed)
        camera, corners = sound_camera(make, rng)
        matrix = np.eye(4)
        matrix[:3, 3] = camera.origin if rng.integers(2) else 0
        local = corners - matrix[:3, 3, None]  # a mesh at some distance, or around the eye
        if np.abs(local).max() < 1e30:
            local = local.astype(rng.choice([np.float32, np.float64]))
        meshes = [Mesh(local[..., k], [[0, 1, 2]]) for k in range(40)]
        instances = [Instance(k, 0, matrix) for k in range(40)]
        scene = Scene(camera, meshes, instances, objects=("A",))
        film = Film(camera, *offsets(rng))
        x, y = (np.sort(rng.choice(n + 1, 2, replace=False)) for n in (camera.width, camera.height))
        region = Region(*(int(v) for v in (x[0], y[0], x[1], y[1])))
        small = small_in(scene, film, region)
        for k in np.flatnonzero(small.is_dense).tolist():
            chunk = Chunk(np.array([k], np.int32))
            with np.errstate(all="ignore"):
                expanded = result_of(expand(scene, film, chunk, small))
                low, high, _ = boxes_of(scene, film, expanded)
            first, last = [[region.x0], [region.y0]], [[region.x1 - 1], [region.y1 - 1]]
            inside = (np.maximum(low, first) <= np.minimum(high, last)).all()
            [(_, counts, _, used, triangle)] = filter(None, small.within(meshes[k], np.array([k])))
            assert counts.sum() == len(triangle) and len(used) == 3 * len(triangle)
            assert len(triangle) or not inside, seed
            left_out += not len(triangle)
            kept += bool(inside)
            in_vain += len(triangle) and not inside
    assert left_out > 300 / every and kept > 300 / every and in_vain < 0.1 * left_out


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
    for own, counts, corners, used, triangle in filter(None, small.within(scene.meshes[0], some)):
        copy = np.repeat(np.arange(len(own)), counts)
        assert np.array_equal(used[corners], scene.meshes[0].triangles[triangle].T + each * copy)
        total += counts.sum()
    assert 0 < total < 0.7 * len(some) * len(scene.meshes[0].triangles)
    found = render(scene, Settings("certified"))
    monkeypatch.setattr(module, "_PER_PIXEL", np.inf)
    whole = render(scene, Settings("certified"))
    for name in FIELDS:
        assert np.array_equal(getattr(found, name), getattr(whole, name), equal_nan=True), name
    assert found.statistics.culling["boxed"] == whole.statistics.culling["boxed"]
    assert (found.triangle_index >= 0).sum() > 300
