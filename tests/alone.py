"""Small pictures of which every pixel, and every ray, can be traced alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.projections import EQUIRECTANGULAR, ORTHOGRAPHIC, PERSPECTIVE, PROJECTIONS
from reference_tracer.projections.projection import Projection
from reference_tracer.scene import Instance, Mesh, Region, Scene, ViewWindow
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.hits import Hits

from .tracer.pictures import mess

SIZES = (2, 1), (1, 2), (1, 1)
# Of each kind of camera and of scene some; and all.
FEW = [(1, PERSPECTIVE), (3, PERSPECTIVE), (5, ORTHOGRAPHIC), (9, EQUIRECTANGULAR)]
MANY = [
    pytest.param(seed, each, marks=pytest.mark.torture)
    for each in PROJECTIONS.values()
    for seed in range(10, 64)
]
EACH = pytest.mark.parametrize(("seed", "projection"), [*FEW, *MANY])


def small(make, seed: int, projection: Projection, size: tuple[int, int]) -> Scene:
    """Return a scene of many surfaces, one plane, or one triangle; of odd seeds with many ties."""
    scene = mess(make, np.random.default_rng(seed), projection is ORTHOGRAPHIC, seed % 2 == 1)
    if projection is EQUIRECTANGULAR:
        window = ViewWindow(-0.8, 0.8, -0.5, 0.5)
        scene = replace(scene, camera=replace(scene.camera, window=window, projection=projection))
    if seed % 3 == 1:
        scene = replace(scene, instances=(), planes=scene.planes[:1])
    if seed % 3 == 2:
        one = Mesh([(-9, -5, -5), (9, -5, -5), (0, 9, -6)], [[0, 1, 2]])
        scene = replace(scene, meshes=(one,), instances=(Instance(0, 0, np.eye(4)),), planes=())
    width, height = size
    region = Region(0, 0, width, height)
    camera = replace(scene.camera, width=width, height=height, region=region)
    return replace(scene, camera=camera)


def by_pixel(scene: Scene) -> Iterator[Scene]:
    """Yield the scene with each pixel of its picture as the region, row by row from the lowest."""
    for y, x in np.ndindex(scene.camera.height, scene.camera.width):
        yield replace(scene, camera=replace(scene.camera, region=Region(x, y, x + 1, y + 1)))


def rays_of(scene: Scene) -> list[Rays]:
    """Return the rays of a camera's pixels, as they are and as rays that share nothing."""
    rays = camera_rays(scene.camera, *film_positions(scene.camera.region))
    shape = 3, rays.count
    both = (np.broadcast_to(v, shape).copy() for v in (rays.origins, rays.directions))
    return [rays, Rays(*both)]


def is_same(one: Hits, many: Hits, ray: int, exactly: bool = True) -> bool:
    """Return whether the one ray's hit is that of a ray of many, to the bit.

    Without `exactly`, how it was decided, and the barycentrics, may be others.
    """
    own = many.take(np.array([ray]))
    names = ("instance", "triangle", "t") + (("certainty", "s") if exactly else ())
    same = all(getattr(one, n).tobytes() == getattr(own, n).tobytes() for n in names)
    return same and one.ties.get(0) == many.ties.get(ray)
