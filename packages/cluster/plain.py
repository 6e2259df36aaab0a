"""t and barycentrics of owners that an unproven method has found: made here, not believed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.nearest import test_pairs, test_planes
from reference_tracer.tracer.progress import Work
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.vector import parts
from reference_tracer.tracer.world import Pairs, WorldTriangles, world_corners

_PIXELS = 1 << 15  # that are traced together


def plain_hits(
    scene: Scene, region: Region, dx: float, dy: float, names: NDArray[np.int32], settings: Settings
) -> Work[Hits]:
    """Return what an unproven method makes of the claimed owners (2, n), and of all planes."""
    found, dtype = [], settings.precision.dtype
    every = np.arange(region.width * region.height)
    for part in parts(len(every), _PIXELS):
        pixel = every[part]
        rays = camera_rays(scene.camera, *film_positions(region, dx, dy, pixel), dtype)
        hits = Hits.none(len(pixel))
        test_planes(scene, rays, hits)
        ray = np.flatnonzero(names[1, part] != NOTHING)
        own = names[:, part][:, ray]
        triangles = WorldTriangles(world_corners(scene, *own).astype(dtype), *own)
        test_pairs(scene, settings, rays, Pairs(ray, np.arange(len(ray)), triangles), hits)
        found.append(hits)
        yield 0.0
    return Hits.joined(found)
