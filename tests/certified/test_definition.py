"""The definition, plain and the sweep see the same: owner, t to the bit, and ties."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.certified.definition import definition
from reference_tracer.certified.plain import plain
from reference_tracer.certified.sweep.sweep import sweep
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.scene import Camera, Instance, Mesh, Plane, Region, Scene, ViewWindow
from reference_tracer.tracer.hits import NOWHERE
from reference_tracer.tracer.progress import result_of

from ..tracer.hostile_scenes import hostile_scene

MEMORY = 64 << 20
FINDERS = {"plain": plain, "sweep": sweep}


def lattice_scene(seed: int) -> Scene:
    """Triangles, copies and planes on a lattice that rays meet in corners, edges and ties."""
    rng = np.random.default_rng(seed)
    corners = rng.integers(-2, 3, (24, 3)) * 1.0 if seed % 2 else rng.normal(size=(24, 3))
    mesh = Mesh(corners, rng.integers(0, 24, (14, 3)))
    instances = []
    for k in range(3):
        matrix = np.eye(4)
        matrix[:3, 3] = (*rng.integers(-2, 3, 2), rng.integers(-8, -3))
        instances += [Instance(0, 0, matrix)] * (1 + k % 2)  # one of them twice
    planes = Plane(0, (0, 0, -6), (0, 0, 1)), Plane(0, (0, -1, 0), (0, 1, 0))
    orthographic = seed // 2 % 2
    half = 4.0 if orthographic else 0.5
    matrix = np.eye(4)
    matrix[:2, 3] = 0.5
    camera = Camera(
        matrix,
        ViewWindow(-half, half, -half * 2 / 3, half * 2 / 3),
        12,
        8,
        projection=ORTHOGRAPHIC if orthographic else PERSPECTIVE,
        clip_start=2.0,
        clip_end=7.0,
    )
    return Scene(camera, (mesh,), tuple(instances), planes, objects=("M",))


def small(scene: Scene, pixels: int) -> Scene:
    """The scene through a part of its picture, about the middle, of at most so many pixels."""
    camera = scene.camera
    r = camera.region
    width = min(r.width, pixels)
    height = max(1, min(r.height, pixels // width))
    x0 = r.x0 + (r.width - width) // 2
    y0 = r.y0 + (r.height - height) // 2
    region = Region(x0, y0, x0 + width, y0 + height)
    return scene.seen_by(type(camera)(**vars(camera) | {"region": region}))


def held(scene: Scene, find) -> tuple[int, int, int]:
    """Hold a finder against the definition; count rays, hits and ambiguous rays."""
    hits = result_of(find(scene, scene.camera.region, MEMORY))
    rays = seen = ambiguous = 0
    for ray, expected in enumerate(definition(scene)):
        assert (int(hits.instance[ray]), int(hits.triangle[ray])) == expected.name, ray
        assert hits.t[ray] == expected.t, ray
        assert hits.ties.get(ray, frozenset()) == expected.ties, ray
        rays += 1
        seen += expected.name != NOWHERE
        ambiguous += bool(expected.ties)
    assert rays == len(hits)
    return rays, seen, ambiguous


@pytest.mark.parametrize("name", FINDERS)
def test_on_a_lattice(name):
    counts = np.sum([held(lattice_scene(seed), FINDERS[name]) for seed in range(12)], axis=0)
    rays, seen, ambiguous = counts
    assert seen > rays / 4 and ambiguous > 60


@pytest.mark.slow
@pytest.mark.parametrize("name", FINDERS)
def test_on_hostile_scenes(make, name):
    """Far, tiny, thin, edge-on, touching, through any camera."""
    counts = np.zeros(3, int)
    for seed in range(30):
        scene = hostile_scene(make, np.random.default_rng(seed))
        if scene.triangle_count <= 400:
            counts += held(small(scene, 60), FINDERS[name])
    rays, seen, ambiguous = counts
    assert seen > 200 and ambiguous > 10 and rays > seen


@pytest.mark.parametrize("name", FINDERS)
@pytest.mark.parametrize("projection", [ORTHOGRAPHIC, PERSPECTIVE])
def test_in_a_corner_of_the_largest_picture(projection, name):
    """Half pixels are a lattice: rays meet corners and edges."""
    size = 1 << 28
    region = Region(size - 8, size - 8, size, size)
    camera = Camera(np.eye(4), ViewWindow(-1, 1, -1, 1), size, size, projection, region=region)
    corners = np.ones((3 * 12, 3))
    corners[:, :2] -= np.random.default_rng(1).integers(0, 16, (36, 2)) / size
    depth = 4.0 if projection is PERSPECTIVE else 1.0
    mesh = Mesh(corners * (depth, depth, -4), np.arange(36).reshape(12, 3))
    scene = Scene(camera, (mesh,), (Instance(0, 0, np.eye(4)),), objects=("M",))
    rays, seen, ambiguous = held(scene, FINDERS[name])
    assert rays == 64 and seen > 30 and ambiguous > 10
