"""Pieces hold every triangle that may be in view once, by its own name and at its own place."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.certified.sweep import chunks as module
from reference_tracer.certified.sweep.boxes import InstanceBoxes
from reference_tracer.certified.sweep.chunks import Chunk, Expanded, chunks, expand
from reference_tracer.certified.sweep.film import Film
from reference_tracer.certified.sweep.small_triangles import SmallTriangles
from reference_tracer.scene import Instance, Mesh, Scene
from reference_tracer.tracer.candidates import has_sound_axes
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.world import Batch, refused, world_triangles

from ...oracle import OUTSIDE, intersect_pairs
from ...sampled import sampled
from ...tracer.hostile import hostile_camera, hostile_triangles
from ...tracer.hostile_scenes import hostile_scene, offsets, scaled_camera
from .test_film import project, rays_of

FLOATS = ("p", "q", "w", "depth", "size", "nearest", "ahead", "finite")
LIMITS = (1, 2, 5, 13, 10**9)


def expanded_of(scene: Scene, film: Film, chunk: Chunk) -> Expanded:
    with np.errstate(all="ignore"):
        return result_of(expand(scene, film, chunk, small_of(scene, film)))


def all_chunks(scene: Scene, film: Film, limit: int) -> list[Chunk]:
    if not scene.instances:
        return []
    around = InstanceBoxes.of(scene, film)
    in_view = around.in_region(film.camera.region)
    return chunks(scene, in_view, around.depth, limit, small_of(scene, film).is_dense)


def small_of(scene: Scene, film: Film) -> SmallTriangles:
    """Here no instance is dense, so that every triangle is expanded."""
    with np.errstate(all="ignore"):
        return SmallTriangles(scene, film, film.camera.region, np.inf)


def names_of(scene: Scene, film: Film, limit: int) -> list[tuple[int, int]]:
    """Return the names of all chunks' triangles, in their order."""
    names = []
    for chunk in all_chunks(scene, film, limit):
        expanded = expanded_of(scene, film, chunk)
        count = expanded.corners.shape[1]
        assert count == expanded.names.starts[-1] <= limit
        assert expanded.corners.flags.c_contiguous  # else each small `take` copies all of them
        names += zip(*(v.tolist() for v in expanded.names.of(np.arange(count))), strict=True)
    return names


@pytest.mark.slow
@pytest.mark.parametrize("part", range(3))
def test_every_triangle_is_in_one_piece(make, part):
    """Of every instance that may be in view; whatever the limit, the same instances are."""
    left_out, several = 0, 0
    for seed in range(part * 20, part * 20 + 20):
        rng = np.random.default_rng(seed)
        scene = hostile_scene(make, rng)
        film = Film(scene.camera, *offsets(rng))
        found = [names_of(scene, film, limit) for limit in LIMITS]
        shown = {i for i, _ in found[0]}
        counts = [len(scene.meshes[i.mesh].triangles) for i in scene.instances]
        for names in found:
            assert sorted(names) == [(i, k) for i in sorted(shown) for k in range(counts[i])], seed
        left_out += sum(bool(n) for n in counts) - len(shown)
        several += len(all_chunks(scene, film, 5)) > 1
    assert left_out > 1 and several > 10


def test_vertices_that_no_triangle_uses_fill_no_chunk(make):
    mesh = make.quad(-1, 1, -1, 1, -3)
    loose = Mesh(np.vstack((mesh.vertices, np.zeros((1000, 3)))), mesh.triangles)
    scene = make.scene(make.camera(), *[loose] * 20)
    film = Film(scene.camera)
    for chunk in all_chunks(scene, film, 1000):
        assert len(expanded_of(scene, film, chunk).vertices.p) <= 3 * 1000
    assert len(all_chunks(scene, film, 1000)) == 10
    for chunk in all_chunks(scene, film, 300):
        assert len(expanded_of(scene, film, chunk).vertices.p) == 4  # what is used of one


@pytest.mark.slow
@pytest.mark.parametrize("chunk", [1, 2, 7, 1 << 13])
def test_places_are_those_of_world_triangles(make, chunk, monkeypatch):
    """Bit for bit, however many vertices are transformed together, and whoever shares them."""
    monkeypatch.setattr(module, "_CHUNK", chunk)
    compared = 0
    for seed in range(8):
        rng = np.random.default_rng(seed)
        scene = hostile_scene(make, rng)
        film = Film(scene.camera, *offsets(rng))
        for limit in LIMITS:
            for chunk in all_chunks(scene, film, limit):
                expanded = expanded_of(scene, film, chunk)
                instance, triangle = expanded.names.of(np.arange(expanded.names.starts[-1]))
                for i in np.unique(instance).tolist():
                    own = np.flatnonzero(instance == i)
                    first, last = int(triangle[own].min()), int(triangle[own].max()) + 1
                    batch = Batch(scene.instances[i].mesh, np.array([i]), first, last)
                    world = world_triangles(scene, batch, np.float64).corners
                    for corner in range(3):
                        plain = project(film, world[corner, :, triangle[own] - first].T)
                        at = expanded.corners[corner, own]
                        for name in FLOATS:
                            value = getattr(expanded.vertices, name)[at]
                            assert value.tobytes() == getattr(plain, name).tobytes(), (seed, name)
                        known = plain.ahead
                        assert np.array_equal(expanded.vertices.box[at][known], plain.box[known])
                    compared += len(own)
    assert compared > 500


@sampled(3)
def test_only_instances_that_no_ray_hits_are_left_out(make, every):
    """Judged by integers: all rays with all triangles of whatever is left out."""
    judged, instances, kept = 0, 0, 0
    for seed in range(0, 90, every):
        rng = np.random.default_rng(seed)
        scale, camera = hostile_camera(make, rng)
        corners = hostile_triangles(camera, scale, rng).astype(np.float64)[..., :24]
        factor = 2.0 ** rng.choice([0, 0, -300, 300])
        camera, corners = scaled_camera(camera, factor), corners * factor
        meshes = [Mesh(corners[..., k], [[0, 1, 2]]) for k in range(24)]
        scene = Scene(
            camera, meshes, [Instance(k, 0, np.eye(4)) for k in range(24)], objects=("A",)
        )
        film = Film(camera, *offsets(rng))
        shown = {i for i, _ in names_of(scene, film, 10**9)}
        hidden = np.array(sorted(set(range(24)) - shown), int)
        kept += len(shown)
        if not len(hidden):
            continue
        assert has_sound_axes(camera)
        r = camera.region
        y, x = np.indices((r.height, r.width)).reshape(2, -1)
        pixel, which = np.divmod(np.arange(len(x) * len(hidden)), len(hidden))
        o, d = rays_of(film, x + r.x0, y + r.y0)
        found = intersect_pairs(o[:, pixel], d[:, pixel], corners[..., hidden[which]])
        for k in np.flatnonzero(found.side != OUTSIDE):
            assert not camera.clip_start <= found.t(k) <= camera.clip_end, seed
        judged, instances = judged + len(pixel), instances + len(hidden)
    assert judged > 20_000 / every and instances > 200 / every and kept > 200 / every


def test_instances_come_from_the_front_to_the_back_and_none_that_is_out_of_view(make, rng):
    camera = make.camera(clip_start=1, clip_end=50)
    depths = rng.permutation(np.arange(2.0, 40))
    places = [(0, 0, -d) for d in depths]
    places += [
        (0, 0, 5),
        (0, 0, -0.2),
        (0, 0, -90),
        (99, 0, -9),
        (-99, 0, -9),
        (0, 99, -9),
        (0, -99, -9),
    ]
    instances = []
    for place in places:
        matrix = np.eye(4)
        matrix[:3, 3] = place
        instances.append(Instance(0, 0, matrix))
    scene = Scene(camera, (make.quad(-0.1, 0.1, -0.1, 0.1, 0),), instances, objects=("A",))
    names = names_of(scene, Film(camera), 2)
    assert [i for i, _ in names] == [k for k in np.argsort(depths) for _ in range(2)]
    grouped = all_chunks(scene, Film(camera), 20)
    nearest = [depths[p.instances].min() for p in grouped]
    farthest = [depths[p.instances].max() for p in grouped]
    assert len(grouped) == 4 and all(a < b for a, b in zip(farthest, nearest[1:], strict=False))


@pytest.mark.parametrize("spread", ["neighbours", "far apart"])
def test_a_part_of_a_mesh_takes_its_own_vertices(make, rng, spread):
    """A stretch of them, where its triangles' numbers are close; else only those that occur."""
    count = 3000
    vertices = rng.normal(size=(count, 3)) - (0, 0, 4)
    if spread == "neighbours":
        triangles = np.arange(300)[:, None] * 9 + rng.integers(0, 30, (300, 3))
    else:
        triangles = rng.integers(0, count, (300, 3))
    scene = make.scene(make.camera(), Mesh(vertices, triangles))
    film = Film(scene.camera)
    at = project(film, vertices.T)
    for chunk in all_chunks(scene, film, 40):
        expanded = expanded_of(scene, film, chunk)
        own = triangles[chunk.first : chunk.last].T
        assert np.array_equal(expanded.vertices.p[expanded.corners], at.p[own])
        assert np.array_equal(expanded.vertices.w[expanded.corners], at.w[own])
        used = len(expanded.vertices.p)
        assert used == len(np.unique(own)) if spread == "far apart" else used < 500


def test_refused_triangles_are_counted(make):
    """As by looking at each: those with a corner that is not finite in world space."""
    total = 0
    for seed in range(60):
        rng = np.random.default_rng(seed)
        scene = hostile_scene(make, rng)
        instances = list(scene.instances)
        for _ in range(3):
            matrix = np.eye(4)
            matrix[:3] = rng.normal(size=(3, 4)) * 10.0 ** rng.choice([0, 150, 307], (3, 4))
            instances.append(Instance(int(rng.integers(len(scene.meshes))), 0, matrix))
        meshes = [
            replace(m, vertices=m.vertices * 10.0 ** rng.choice([0.0, 0, 150]))
            if np.abs(m.bounds).max() < 1e150
            else m
            for m in scene.meshes
        ]
        scene = replace(scene, instances=instances, meshes=meshes)
        plain = 0
        for i, instance in enumerate(instances):
            some = Batch(instance.mesh, np.array([i]), 0, len(meshes[instance.mesh].triangles))
            corners = world_triangles(scene, some, np.float64).corners
            plain += int((~np.isfinite(corners).all(axis=(0, 1))).sum())
        assert refused(scene) == plain, seed
        total += plain
    assert total > 200


def test_nothing_to_see(make):
    camera = make.camera()
    assert all_chunks(make.scene(camera), Film(camera), 10) == []
    empty = Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert all_chunks(make.scene(camera, empty), Film(camera), 10) == []
