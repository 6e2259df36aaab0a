"""Tiny scenes that are as hostile as they come, and what a plain contest makes of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from reference_tracer.certified.ladder import Ladder
from reference_tracer.scene import Camera, Instance, Mesh, Plane, Region, Scene, ViewWindow
from reference_tracer.tracer.camera import camera_rays, corner_rays, film_positions
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.world import Pairs, WorldTriangles, world_corners

from .hostile import hostile_camera, hostile_triangles

SIDE = 14  # pixels of a picture, at most


def hostile_scene(make, rng: np.random.Generator, finite: bool = False) -> Scene:
    """Return a scene of some dozen triangles, of any kind; one instance may not be finite."""
    scene = (_any, _any, scene_of_integers)[rng.integers(3)](make, rng)
    if finite or rng.random() < 0.8 or not scene.instances:
        return scene
    matrix = np.diag((1e308, 1e308, 1e308, 1))
    return replace(scene, instances=(*scene.instances, Instance(0, 0, matrix)))


def offsets(rng: np.random.Generator) -> tuple[float, float]:
    """Return where rays may pass their pixels' centres: mostly there."""
    if rng.random() < 0.5:
        return 0.0, 0.0
    return tuple(rng.choice([-0.5, -0.25, 0.0, 0.125, 0.375, 0.5], 2).tolist())


def _any(make, rng) -> Scene:
    """Any scale, axes, border; triangles tiny to huge, behind the eye, twice, nearly coplanar."""
    scale, camera = hostile_camera(make, rng)
    if rng.random() < 0.05:  # of several cells of the depth buffer
        camera = _larger(camera, int(rng.integers(3, 6)))
    corners = hostile_triangles(camera, scale, rng).astype(np.float64)
    corners = corners[..., : rng.integers(1, 13)]
    if rng.random() < 0.4:  # surfaces behind one another, as far as the picture reaches
        corners = np.concatenate((corners, _backdrops(camera, rng)), axis=2)
    if rng.random() < 0.4:
        corners = np.concatenate((corners, _beside(corners, rng)), axis=2)
    planes = []
    for _ in range(rng.choice([0, 0, 1, 2])):
        a, b, c = corners[..., rng.integers(corners.shape[2])]
        normal = np.cross(b - a, c - a) if rng.integers(2) else rng.normal(size=3)
        if normal.any() and np.isfinite(normal).all():
            planes.append(Plane(0, a, normal))
    return _scene(camera, corners, planes, rng)


def scene_of_integers(make, rng) -> Scene:
    """Small integers: rays through edges and corners, equal depths, clip ends at surfaces."""
    count = int(rng.integers(1, 16))
    corners = (
        np.stack(
            [
                rng.integers(-4, 5, (3, count)),
                rng.integers(-4, 5, (3, count)),
                rng.integers(-5, 1 + rng.integers(3), (3, count)),
            ],
            axis=1,
        )
        * 1.0
    )
    if rng.random() < 0.5:
        corners[:, 2] = corners[0, 2]  # across the axis, many at the same depth
    orthographic = bool(rng.integers(2))
    camera = make.camera(
        int(rng.integers(1, SIDE)), int(rng.integers(1, 9)),
        half=float(rng.choice([2, 4])) if orthographic else float(rng.choice([0.5, 1, 2])),
        orthographic=orthographic, eye=rng.choice([0, 0.5, 0.25], 3),
        clip_start=float(rng.choice([0.0, -1.0, 1.0, 2.0] if orthographic else [0.5, 1, 2])),
        clip_end=float(rng.choice([3, 4, 100])),
    )  # fmt: skip
    planes = [
        Plane(0, rng.integers(-3, 1, 3), np.eye(3)[rng.integers(3)])
        for _ in range(rng.choice([0, 0, 1, 2]))
    ]
    return _scene(camera, corners, planes, rng, exact=True)


def _larger(camera: Camera, times: int) -> Camera:
    """Return a camera with more pixels, and its border around the same of what it sees."""
    region = Region(*(v * times for v in vars(camera.region).values()))
    return replace(camera, width=camera.width * times, height=camera.height * times, region=region)


def _backdrops(camera, rng) -> NDArray[np.float64]:
    """Return triangles that cover the picture, across the view axis or slanted."""
    count = int(rng.integers(1, 6))
    start = max(camera.clip_start, 1e-300)
    depth = start * 10 ** rng.uniform(-0.1, 2, count)
    slant = 1 + rng.choice([0, 1e-3, 0.3]) * rng.uniform(-1, 1, (3, count))
    w = camera.window
    middle = (w.left + w.right) / 2, (w.bottom + w.top) / 2
    half = w.right - w.left, w.top - w.bottom
    out = []
    for k, (x, y) in enumerate(((-4, -4), (4, -4), (0, 4))):
        far = depth * slant[k]
        along = 1.0 if camera.projection.shares_direction else far
        x, y = (middle[0] + x * half[0]) * along, (middle[1] + y * half[1]) * along
        out.append(
            camera.origin[:, None]
            + x * camera.right[:, None] + y * camera.up[:, None] + far * camera.forward[:, None]
        )  # fmt: skip
    return np.stack(out)


def _beside(corners, rng) -> NDArray[np.float64]:
    """Return some again: the same, turned round, moved within their plane, or by one float."""
    some = corners[..., rng.integers(corners.shape[2], size=rng.integers(1, 6))]
    kind = rng.integers(4)
    if kind == 1:
        some = some[rng.permutation(3)]
    elif kind == 2:
        some = some.copy()
        some[2] += rng.uniform(-0.3, 0.3) * (some[1] - some[0])
    elif kind == 3:
        some = np.nextafter(some, some + rng.normal(size=some.shape))
    return some


def _scene(camera, corners, planes, rng, exact=False) -> Scene:
    """Share triangles out to meshes of their own, in instances that may be mirrored, or twice."""
    meshes, instances = [], []
    for part in np.array_split(rng.permutation(corners.shape[2]), rng.integers(1, 5)):
        matrix = np.eye(4)
        if rng.integers(2):
            matrix[:3, :3] = np.diag(rng.choice([-1.0, 1.0, 1.0], 3))[rng.permutation(3)]
        if rng.integers(2) and not exact:
            matrix[:3, :3] @= np.linalg.qr(rng.normal(size=(3, 3)))[0]
            matrix[:3, 3] = camera.origin
        inverse = np.linalg.inv(matrix[:3, :3])
        local = np.einsum("ij,cjn->nci", inverse, corners[..., part] - matrix[:3, 3, None])
        vertices = local.reshape(-1, 3)
        if not exact and rng.integers(4) == 0:
            with np.errstate(over="ignore", under="ignore"):
                vertices = np.nan_to_num(vertices.astype(np.float32))
        triangles = np.arange(3 * len(part)).reshape(-1, 3)
        if len(part) and rng.integers(3) == 0:  # one without area, and one twice
            triangles = np.concatenate((triangles, triangles[:1, [0, 1, 1]], triangles[-1:]))
        meshes.append(Mesh(vertices, triangles))
        instances += [Instance(len(meshes) - 1, 0, matrix)] * rng.choice([1, 1, 2])
    order = rng.permutation(len(instances))
    return Scene(camera, meshes, [instances[k] for k in order], planes, objects=("It",))


def brute_force(scene: Scene, region: Region, dx: float = 0.0, dy: float = 0.0) -> Hits:
    """Return what the ladder decides of every ray with every triangle."""
    camera = scene.camera
    names = [
        (i, k)
        for i, instance in enumerate(scene.instances)
        for k in range(len(scene.meshes[instance.mesh].triangles))
    ]
    instance, triangle = np.array(names, np.int32).reshape(-1, 2).T
    corners = world_corners(scene, instance, triangle)
    finite = np.flatnonzero(np.isfinite(corners).all(axis=(0, 1)))
    triangles = WorldTriangles(corners, instance, triangle).take(finite)
    rays = camera_rays(camera, *film_positions(region, dx, dy))
    around = corner_rays(camera, dx, dy)  # the bounds are for all rays of the picture
    ladder = Ladder.of(scene, rays, around)
    count = len(finite)
    ray, row = np.divmod(np.arange(region.width * region.height * count), max(count, 1))
    ladder.test(Pairs(ray, row, triangles))
    return result_of(ladder.hits(Statistics()))


def scaled_camera(camera: Camera, factor: float) -> Camera:
    """Return a camera with all lengths times a power of two."""
    window, matrix = camera.window, camera.world_from_camera.copy()
    matrix[:3, 3] *= factor
    if camera.projection.shares_direction:
        window = ViewWindow(*(v * factor for v in vars(window).values()))
    ends = {k: getattr(camera, k) * factor for k in ("clip_start", "clip_end")}
    return replace(camera, world_from_camera=matrix, window=window, **ends)


def scaled(scene: Scene, factor: float) -> Scene:
    """Return a scene with all lengths times a power of two."""
    grown = np.array([[factor]] * 3 + [[1.0]])
    return replace(
        scene,
        camera=scaled_camera(scene.camera, factor),
        instances=[
            replace(i, world_from_object=i.world_from_object * grown) for i in scene.instances
        ],
        planes=[replace(p, point=p.point * factor) for p in scene.planes],
    )
