"""What rays that are not a camera's see of triangles by themselves: the certified ladder."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from reference_tracer.certified.ladder import Ladder
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.world import Pairs, WorldTriangles


def nearest_hits(
    rays: Rays,
    corners: NDArray[np.float64],
    start: float = 0.0,
    end: float = np.inf,
    together: int = 1 << 15,
) -> Hits:
    """Return what n rays see of m triangles (3, 3, m), each ray tested with each triangle.

    Parameters are as of `any_rays.decide`, and how many pairs are entered `together`. A hit has the
    instance 0, and its triangle's number.
    """
    count, n = corners.shape[2], max(rays.origins.shape[1], rays.directions.shape[1])
    triangles = WorldTriangles(corners, np.zeros(count, np.int32), np.arange(count, dtype=np.int32))
    ladder = Ladder(rays, clip=(start, end))
    for first in range(0, n * count, together):
        ray, row = np.divmod(np.arange(first, min(first + together, n * count)), count)
        ladder.test(Pairs(ray, row, triangles))
    return result_of(ladder.hits(Statistics()))
