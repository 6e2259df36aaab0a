"""Clusters hold every triangle once, and change no picture: only how much of it is looked at."""

from __future__ import annotations

import gc
from weakref import ref

import numpy as np
import pytest
import trimesh
from reference_tracer.certified.sweep import clustered, clusters, small_triangles, sweep
from reference_tracer.certified.sweep.clusters import SIZE, Clusters, clusters_of
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Scene
from reference_tracer.tracer.hits import Statistics
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ...tracer.hostile_scenes import hostile_scene, offsets, scaled
from .test_sweep import assert_same

FIELDS = ("instance_index", "triangle_index", "t", "barycentrics", "certainty", "color")


def soup(rng, count: int, scale: float = 1.0) -> Mesh:
    """Small triangles anywhere in a cube, in any order."""
    corners = rng.uniform(-1, 1, (count, 1, 3)) + rng.normal(0, 0.01, (count, 3, 3))
    return Mesh(corners.reshape(-1, 3) * scale, np.arange(3 * count).reshape(-1, 3))


@pytest.mark.parametrize("count", [1, SIZE - 1, SIZE, 5 * SIZE + 7])
@pytest.mark.parametrize("scale", [1.0, 1e-320, 1.6e308])
@pytest.mark.filterwarnings("ignore:overflow", "ignore:invalid value")
def test_every_triangle_is_in_one_cluster_and_in_its_box(rng, count, scale):
    mesh = soup(rng, count, min(scale, 1e308))
    found = Clusters.of(mesh)
    assert np.array_equal(np.sort(found.order), np.arange(count))
    every = np.arange(len(found))
    assert np.array_equal(found.triangles(every), found.order)
    for k in every.tolist():
        own = found.triangles(np.array([k]))
        corners = mesh.vertices[mesh.triangles[own]]
        assert len(own) == min(SIZE, count - k * SIZE)
        assert np.array_equal(found.bounds[0, :, k], corners.min(axis=(0, 1)))
        assert np.array_equal(found.bounds[1, :, k], corners.max(axis=(0, 1)))
        places = found.places[:, :, k, : len(own)].transpose(2, 0, 1)
        assert np.array_equal(places, corners.astype(np.float32))
    some = np.array([3, 0, 4]) % len(found)
    whole = found.triangles(some, np.arange(SIZE * len(some) - SIZE, SIZE * len(some)))
    assert np.array_equal(whole, found.triangles(some[-1:]))


def test_the_better_order_is_taken(rng):
    """A subdivided sphere keeps its own; what is shuffled is sorted, for smaller boxes."""
    sphere = trimesh.creation.icosphere(subdivisions=5)
    ordered = Clusters.of(Mesh(sphere.vertices, sphere.faces))
    assert np.array_equal(ordered.order, np.arange(len(sphere.faces)))
    shuffled = Clusters.of(Mesh(sphere.vertices, rng.permutation(sphere.faces)))
    sides = (shuffled.bounds[1] - shuffled.bounds[0]).max(axis=0)
    assert np.median(sides) < 1.0  # in any order they would be 2


def test_they_are_made_the_second_time_kept_and_freed_with_the_mesh(rng):
    assert clusters_of(soup(rng, clusters.LEAST - 1)) is None
    mesh = soup(rng, clusters.LEAST)
    assert clusters_of(mesh) is None
    found = clusters_of(mesh)
    assert found is not None and clusters_of(mesh) is found
    known, freed = len(clusters._KNOWN), ref(mesh)
    del mesh, found
    gc.collect()
    assert freed() is None and len(clusters._KNOWN) < known


@pytest.mark.parametrize("per_pixel", [0.0, 1e9])
@pytest.mark.parametrize("size", [1, 3])
def test_hostile_scenes_look_the_same(make, monkeypatch, size, per_pixel):
    monkeypatch.setattr(clusters, "SIZE", size)
    monkeypatch.setattr(clustered, "SIZE", size)
    seen = 0
    for seed in range(60):
        rng = np.random.default_rng(seed)
        scene, beside = hostile_scene(make, rng, finite=seed % 4 == 0), offsets(rng)
        if seed % 4 == 0:
            scene = scaled(scene, 2.0 ** rng.choice([-300, -150, 150, 300]))
        region = scene.camera.region

        def swept(scene=scene, region=region, beside=beside):
            return result_of(sweep.sweep(scene, region, 1 << 30, *beside))

        whole = swept()
        with monkeypatch.context() as context:
            context.setattr(sweep, "clusters_of", Clusters.of)
            context.setattr(small_triangles, "_PER_PIXEL", 0.0)
            members = clustered.SmallTriangles

            def few(*given, members=members):
                context.setattr(small_triangles, "_PER_PIXEL", per_pixel)
                return members(*given)

            context.setattr(clustered, "SmallTriangles", few)
            assert_same(swept(), whole, seed)
        seen += (whole.triangle >= 0).sum()
    assert seen > 500


@pytest.mark.parametrize("orthographic", [False, True])
def test_what_is_hidden_or_out_of_view_is_not_projected(make, orthographic):
    """Spheres within one another, one beside the view, one mirrored around the eye."""
    sphere = trimesh.creation.icosphere(subdivisions=5)
    mesh = make.mesh(sphere)
    places = [((0, 0, -5), 1.0), ((0, 0, -5), 0.6), ((3, 0, -5), 1.0), ((0, 0, -8), -20.0)]
    instances = []
    for place, size in places:
        matrix = np.diag((size, abs(size), abs(size), 1.0))
        matrix[:3, 3] = place
        instances.append(Instance(0, 0, matrix))
    half = 1.5 if orthographic else 0.3
    camera = make.camera(96, 64, half=half, orthographic=orthographic)
    scene = Scene(camera, (mesh,), instances, objects=("A",))
    first, second, third = (render(scene, Settings("certified")) for _ in range(3))
    for name in FIELDS:
        own = getattr(first, name)
        assert np.array_equal(own, getattr(second, name), equal_nan=True), name
        assert np.array_equal(own, getattr(third, name), equal_nan=True), name
    boxed = first.statistics.culling["boxed"], third.statistics.culling["boxed"]
    assert boxed[1] < 0.95 * boxed[0]
    assert len(np.unique(first.instance_index)) >= 2


def test_samples_and_regions_share_them(make):
    mesh = make.mesh(trimesh.creation.icosphere(subdivisions=5))
    scene = Scene(make.camera(40, 30, half=0.3), (mesh,), objects=("A",), instances=(
        Instance(0, 0, np.array([[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -5], [0, 0, 0, 1]])),
    ))  # fmt: skip
    statistics = Statistics()
    for dx in (-0.25, 0.25):
        result_of(sweep.sweep(scene, scene.camera.region, 1 << 30, dx, 0.0, statistics))
    assert clusters._KNOWN[mesh] is not None
