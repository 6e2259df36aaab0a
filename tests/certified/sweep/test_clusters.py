"""Clusters hold every triangle, and change no picture: only how much of it is looked at."""

from __future__ import annotations

import gc
from dataclasses import replace
from functools import partial
from weakref import ref

import numpy as np
import pytest
import trimesh
from reference_tracer.certified.sweep import clustered, clusters, small_triangles, sweep
from reference_tracer.certified.sweep.chunks import Chunk
from reference_tracer.certified.sweep.clustered import Clustered
from reference_tracer.certified.sweep.clusters import SIZE, Clusters, clusters_of
from reference_tracer.certified.sweep.film import Film
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Region, Scene
from reference_tracer.tracer.settings import Settings

from ...tracer.hostile_scenes import hostile_scene, offsets, scaled
from ..test_definition import held
from .test_sweep import assert_same, swept

FIELDS = ("instance_index", "triangle_index", "t", "barycentrics", "certainty", "color")
PARTS = [0, *(pytest.param(part, marks=pytest.mark.torture) for part in range(1, 48))]
SEEDS = 20  # in a part
CERTIFIED = Settings("certified")


def soup(rng, count: int, scale: float = 1.0) -> Mesh:
    """Small triangles anywhere in a cube, in any order."""
    corners = rng.uniform(-1, 1, (count, 1, 3)) + rng.normal(0, 0.01, (count, 3, 3))
    return Mesh(corners.reshape(-1, 3) * scale, np.arange(3 * count).reshape(-1, 3))


@pytest.fixture
def sphere(make) -> Mesh:
    return make.mesh(trimesh.creation.icosphere(subdivisions=5))


@pytest.mark.parametrize("count", [1, SIZE - 1, SIZE, 5 * SIZE + 7])
@pytest.mark.parametrize("scale", [1.0, 1e-320, 1e307])
def test_every_triangle_is_in_the_box_of_its_cluster(rng, count, scale):
    mesh = soup(rng, count, scale)
    found = Clusters.of(mesh)
    assert len(found) == -(-count // SIZE)
    corners = mesh.vertices[mesh.triangles]
    for k in range(len(found)):
        own = corners[k * SIZE : (k + 1) * SIZE]
        middle, half = found.middle[:, k], found.half[:, k]
        slack = 4 * np.spacing(np.abs(own).max())
        assert (np.abs(own - middle) <= half + slack).all()
        assert (own.max(axis=(0, 1)) - own.min(axis=(0, 1)) >= 2 * half - 4 * slack).all()


def test_they_are_made_the_second_time_kept_and_freed_with_the_mesh(make, rng):
    assert [clusters_of(soup(rng, clusters.LEAST - 1)) for _ in range(3)] == [None] * 3
    mesh = make.mesh(trimesh.creation.icosphere(subdivisions=5))
    assert len(mesh.triangles) >= clusters.LEAST and clusters_of(mesh) is None
    found = clusters_of(mesh)
    assert found is not None and clusters_of(mesh) is found
    assert sum(a.nbytes for a in (found.middle, found.half)) < len(mesh.triangles)
    freed = ref(mesh)
    known = len(clusters._KNOWN), len(clusters._SWEPT)
    del mesh, found
    gc.collect()
    assert freed() is None and len(clusters._KNOWN) < known[0] and len(clusters._SWEPT) < known[1]


def test_a_mesh_in_any_order_has_none(rng):
    mesh = soup(rng, clusters.LEAST)
    assert [clusters_of(mesh) for _ in range(3)] == [None] * 3


def always(monkeypatch, size: int) -> None:
    """Have all meshes clusters of a few triangles, and all instances use them, in several bins."""
    for module in (clusters, clustered):
        monkeypatch.setattr(module, "SIZE", size)

    def clusters_at_once(mesh: Mesh) -> Clusters | None:
        return Clusters.of(mesh) if len(mesh.triangles) else None

    monkeypatch.setattr(sweep, "clusters_of", clusters_at_once)
    monkeypatch.setattr(Clustered, "pay", lambda self: True)
    monkeypatch.setattr(clustered, "_DEEP", -1.0)


@pytest.mark.slow
@pytest.mark.parametrize("dense", [False, True])
@pytest.mark.parametrize("part", PARTS)
def test_hostile_scenes_look_the_same(make, monkeypatch, part, dense):
    """Any scale; cameras inside; clip ends at surfaces; mirrored, sheared, degenerate; any ties."""
    if dense:
        monkeypatch.setattr(small_triangles, "_PER_PIXEL", 0.0)
    seen = 0
    for seed in range(part * SEEDS, (part + 1) * SEEDS):
        rng = np.random.default_rng(seed)
        scene, beside = hostile_scene(make, rng, finite=seed % 4 == 0), offsets(rng)
        if seed % 4 == 0:
            scene = scaled(scene, 2.0 ** rng.choice([-500, -300, -150, 150, 300, 500]))
        scene = replace(
            scene, meshes=(*scene.meshes, Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)))
        )
        work = partial(swept, scene, beside=beside)
        whole = work()
        with monkeypatch.context() as context:
            always(context, int(rng.choice([1, 3])))
            memory = 300 if seed % 8 == 1 else 1 << 30  # then a chunk may begin within a cluster
            assert_same(work(memory=memory), whole, seed)
        seen += (whole.triangle >= 0).sum()
    assert seen > 160


@pytest.mark.parametrize("orthographic", [False, True])
def test_what_is_hidden_or_out_of_view_is_not_projected(make, sphere, orthographic, monkeypatch):
    """Spheres within one another, one beside the view, one mirrored around the eye."""
    monkeypatch.setattr(clustered, "_DEEP", 2.0)
    instances = []
    for place, size in (((0, 0, -5), 1.0), ((0, 0, -5), 0.6), ((3, 0, -5), 1.0), ((0, 0, -8), -20)):
        matrix = np.diag((size, abs(size), abs(size), 1.0))
        matrix[:3, 3] = place
        matrix[0, 1] = 0.1
        instances.append(Instance(0, 0, matrix))
    half = 1.5 if orthographic else 0.3
    camera = make.camera(160, 120, half=half, orthographic=orthographic)
    scene = Scene(camera, (sphere,), instances, objects=("A",))
    first, second, third = (render(scene, CERTIFIED) for _ in range(3))
    for name in FIELDS:
        own = getattr(first, name)
        assert np.array_equal(own, getattr(second, name), equal_nan=True), name
        assert np.array_equal(own, getattr(third, name), equal_nan=True), name
    boxed = first.statistics.culling["boxed"], third.statistics.culling["boxed"]
    assert boxed[1] < 0.95 * boxed[0], boxed
    assert len(np.unique(first.instance_index)) >= 2


def clusters_in(scene: Scene) -> Clustered:
    every = np.arange(len(scene.instances), dtype=np.int32)
    known = {k: Clusters.of(mesh) for k, mesh in enumerate(scene.meshes)}
    film, region = Film(scene.camera), scene.camera.region
    return Clustered.of(scene, film, region, Chunk(every), known)


@pytest.mark.parametrize("orthographic", [False, True])
def test_one_pixel_that_is_seen_keeps_a_cluster(make, rng, orthographic, monkeypatch):
    """Of a triangle in front of which another is, but for one pixel; or at the picture's edge."""
    camera = make.camera(32, 24, half=0.5, orthographic=orthographic)
    w, deep = camera.window, 2.0

    def quad(x0, x1, y0, y1, depth) -> Mesh:
        """Between positions on the film, in pixels."""
        factor = 1.0 if orthographic else depth
        x = [(w.left + v / 32 * (w.right - w.left)) * factor for v in (x0, x1)]
        y = [(w.bottom + v / 24 * (w.top - w.bottom)) * factor for v in (y0, y1)]
        return make.quad(x[0], x[1], y[0], y[1], -depth)

    always(monkeypatch, 2)
    column = int(rng.integers(2, 30))
    parts = [quad(-1, column, -1, 25, 1.0), quad(column + 1, 33, -1, 25, 1.0)]
    parts += [quad(column - 1, column + 2, -1, 10, 1.0), quad(column - 1, column + 2, 11, 25, 1.0)]
    behind = quad(-1, 33, -1, 25, deep)
    scene = make.scene(camera, *parts, behind)
    frame = render(scene, CERTIFIED)
    seen = frame.instance_index.reshape(24, 32) == 4
    assert seen[10, column] and seen.sum() == 1
    edge = make.scene(camera, quad(31.4, 40, 23.4, 30, deep))
    assert (render(edge, CERTIFIED).instance_index >= 0).sum() == 1
    beside = make.scene(camera, quad(33.1, 40, 25.1, 30, deep))
    assert not clusters_in(beside).in_view.any() and clusters_in(edge).in_view.all()


def test_what_begins_behind_the_eye_is_kept(make):
    """Most of a floor is behind the camera, and the rest is seen."""
    floor = Mesh([(-99, -1, -9), (99, -1, -9), (0, -1, 999)], [[0, 1, 2]])
    found = clusters_in(make.scene(make.camera(32, 24, half=0.5), floor))
    assert found.in_view.all() and (found.nearest == np.inf).all()
    behind = Mesh([(-99, -1, 1e-3), (99, -1, 1e-3), (0, -1, 999)], [[0, 1, 2]])
    assert not clusters_in(make.scene(make.camera(32, 24, half=0.5), behind)).in_view.any()


def test_bands_and_samples_share_them(sphere, make):
    matrix = np.eye(4)
    matrix[2, 3] = -5
    scene = Scene(
        make.camera(40, 30, half=0.3), (sphere,), [Instance(0, 0, matrix)], objects=("A",)
    )
    for dx in (-0.25, 0.25):
        swept(scene, beside=(dx, 0.0))
    assert clusters._KNOWN[sphere] is not None


def test_what_overflows_is_not_left_out(make):
    """A flat grid that is scaled across its plane by so much that rows of its matrix overflow."""
    x, y = np.meshgrid(np.linspace(-1, 1, 71), np.linspace(-1, 1, 71))
    vertices = np.stack((x.ravel(), y.ravel(), np.zeros(x.size)), axis=1)
    corner = (np.arange(70)[:, None] * 71 + np.arange(70)).ravel()
    below = np.stack((corner, corner + 1, corner + 71), axis=1)
    above = np.stack((corner + 1, corner + 72, corner + 71), axis=1)
    mesh = Mesh(vertices, np.concatenate((below, above)))
    assert len(mesh.triangles) >= clusters.LEAST
    matrix = np.diag([1.0, 1.0, 1e308, 1.0])
    matrix[2, 3] = -3
    scene = Scene(make.camera(40, 40), (mesh,), (Instance(0, 0, matrix),), objects=("Grid",))
    first, second = (render(scene, CERTIFIED) for _ in range(2))
    assert clusters_of(mesh) is not None and (first.instance_index == 0).any()
    for name in FIELDS:
        assert getattr(first, name).tobytes() == getattr(second, name).tobytes(), name


def test_a_matrix_that_underflows_drops_no_cluster(make, monkeypatch):
    """Of 2^-1070, in front of a mesh of 2^1020: rows of the film have four digits left."""
    always(monkeypatch, 1)
    seen = 0
    for seed in (2, 6, 12):
        rng = np.random.default_rng(seed)
        axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        region, unit = Region(52, 52, 60, 60), 2.0**-50
        camera = make.camera(64, 64, axes=axes, region=region, clip_start=1e-3 * unit)
        depth = rng.uniform(1, 6, (8, 1)) * np.ones((8, 3))
        x, y = (rng.uniform(0.25, 0.5, (2, 8, 1)) + 0.04 * rng.normal(size=(2, 8, 3))) * depth
        corners = unit * np.stack((x, y, -depth), axis=-1) @ axes.T
        mesh = Mesh(corners.reshape(-1, 3) * 2.0**600 * 2.0**470, np.arange(24).reshape(8, 3))
        matrix = np.diag((2.0**-1070, 2.0**-1070, 2.0**-1070, 1.0))
        scene = Scene(camera, (mesh,), (Instance(0, 0, matrix),), objects=("A",))
        seen += held(scene, sweep.sweep)[1]
    assert seen > 20
