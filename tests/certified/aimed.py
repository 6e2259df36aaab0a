"""Triangles that a pixel's own ray meets, from 2^-1070 to 2^1020 m, near an edge or edge-on."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.random import Generator
from reference_tracer.projections import EQUIRECTANGULAR, ORTHOGRAPHIC, Projection
from reference_tracer.scene import Camera, Instance, Mesh, Scene, SceneError, ViewWindow
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.vector import Vectors

from ..tracer.test_candidates import exact_depth

UNITS = (
    0,
    0,
    0,
    0,
    -1070,
    -1060,
    -1030,
    -900,
    -600,
    -300,
    300,
    600,
    900,
    1010,
    1019,
)  # 2^ so many m
CLOSE = (0.3, 1e-3, 1e-9, 0.0)  # how near an edge, of a triangle's size


class Aimed(NamedTuple):
    """Instances of one triangle each; the ray of pixel (x, y) meets that of instance k at t."""

    scene: Scene
    met: list[tuple[int, int, int, float]]  # k, x, y, t


def axes_of(rng: Generator) -> Vectors:
    """Return axes: rotated, scaled, sheared up to where bounds are refused, or mirrored."""
    turned = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    kind = rng.integers(5)
    if kind == 0:
        return np.diag(rng.choice([-1.0, 1.0], 3))
    if kind == 1:
        return turned @ np.diag(rng.uniform(0.51, 1.99, 3))
    if kind == 2:
        return turned @ ((1.9, 0, 0.5), (0, 1.9, 0), (0, 0, rng.uniform(0.06, 0.1)))
    if kind == 3:
        return turned @ (np.eye(3) + rng.uniform(-0.5, 0.5, (3, 3)) * (1 - np.eye(3)))
    return turned


def camera_of(rng: Generator, projection: Projection, unit: float) -> Camera | None:
    """Return a camera for lengths of about `unit`; None where there is none."""
    half = 10.0 ** rng.uniform(-3, 1)
    middle = half * rng.choice([0, 1, -3, 300], 2) * rng.uniform(0.5, 1, 2)
    if projection is EQUIRECTANGULAR:
        half = rng.choice([3.0, 1.5, 0.1, 9.0])
        middle = rng.choice([0, 0, 1.0, -9.0, 1.5, 100.0], 2)
    lengths = unit if projection is ORTHOGRAPHIC else 1.0
    window = ViewWindow(-half, half, -half / 2, half / 2).moved(*middle).scaled(lengths, lengths)
    matrix = np.eye(4)
    matrix[:3, :3] = axes_of(rng)
    matrix[:3, 3] = unit * rng.normal(size=3) * rng.choice([0, 0, 0.1, 1])
    start = max(1e-9 * unit, 5e-324)
    if projection is ORTHOGRAPHIC:
        start = rng.choice([-np.inf, -1e9 * min(unit, 2.0**980), start])
    width, height = (int(n) for n in rng.choice([1, 2, 3, 40], 2))
    try:
        return Camera(matrix, window, width, height, projection, start, np.inf)
    except SceneError:
        return None


@np.errstate(all="ignore")
def aimed(rng: Generator, projection: Projection, count: int = 8) -> Aimed | None:
    """Return a camera and `count` triangles of one scale; None where there is no camera."""
    unit = 2.0 ** rng.choice(UNITS)
    camera = camera_of(rng, projection, unit)
    if camera is None:
        return None
    x, y = rng.integers(camera.width, size=count), rng.integers(camera.height, size=count)
    rays = camera_rays(camera, *film_positions(camera.region, pixel=y * camera.width + x))
    origins, directions = (np.broadcast_to(v, (3, count)) for v in (rays.origins, rays.directions))
    meshes, instances, met = [], [], []
    for k in range(count):
        o, d = origins[:, k], directions[:, k]
        t = unit * rng.uniform(0.2, 3) * rng.choice([1, 1, 1e-3])
        size = t * 10.0 ** rng.uniform(-15, 2)
        weights = rng.dirichlet((1, 1, 1)) * (1, 1, rng.choice(CLOSE))
        corners = rng.normal(size=(3, 3))
        if rng.integers(3) == 0:  # seen edge-on, nearly
            corners = corners * 10.0 ** rng.uniform(-12, 0) + rng.normal(size=(3, 1)) * d
        corners -= weights / weights.sum() @ corners
        matrix = np.eye(4)
        power = rng.choice(UNITS, 3) * rng.choice([0, 0, 1], 3)
        matrix[:3, :3] = np.diag(np.ldexp(1.0, power))
        vertices = np.ldexp(o + t * d + size * corners, -power)
        if not np.isfinite(vertices).all():
            continue
        instances.append(Instance(len(meshes), 0, matrix))
        meshes.append(Mesh(vertices, [[0, 1, 2]]))
        world = vertices * np.diag(matrix)[:3]
        if np.isfinite(world).all() and (at := exact_depth(o, d, world)) is not None:
            if camera.clip_start <= at and 0 < abs(at) < 2**1023:
                met.append((len(meshes) - 1, int(x[k]), int(y[k]), at))
    return Aimed(Scene(camera, meshes, instances, objects=("A",)), met) if meshes else None
