"""Small pictures of which every pixel, and every ray, can be traced alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.projections import EQUIRECTANGULAR, ORTHOGRAPHIC, PROJECTIONS
from reference_tracer.projections.projection import Projection
from reference_tracer.scene import Instance, Mesh, Region, Scene, ViewWindow
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.hits import Hits

from .tracer.pictures import mess

SIZES = (2, 1), (1, 2), (1, 1)
# A scene of every kind, and a camera of every kind; all others are tortures.
EACH = pytest.mark.parametrize(
    ("seed", "projection"),
    [
        pytest.param(seed, p, marks=() if seed == k else pytest.mark.torture, id=f"{seed} {p.name}")
        for k, p in enumerate(PROJECTIONS.values())
        for seed in range(60)
    ],
)


def small(make, seed: int, projection: Projection, size: tuple[int, int]) -> Scene:
    """Return a scene of many surfaces, one plane, or one triangle; of odd seeds with many ties."""
    scene = mess(make, np.random.default_rng(seed), projection is ORTHOGRAPHIC, seed % 2 == 1)
    if projection is EQUIRECTANGULAR:
        window = ViewWindow(-0.8, 0.8, -0.5, 0.5)
        scene = replace(scene, camera=replace(scene.camera, window=window, projection=projection))
    if seed % 3 == 1:
        scene = replace(scene, instances=(), planes=scene.planes[:1])
    if seed % 3 == 2:
        one = Mesh([(-4, -3, 0), (4, -3, 0), (0, 5, -1)], [[0, 1, 2]])
        placed = Instance(
            0, 0, np.array([(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, -5), (0, 0, 0, 1.0)])
        )
        scene = replace(scene, meshes=(one,), instances=(placed,), planes=())
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
