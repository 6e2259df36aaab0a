"""What the tracer's plain methods see of one ray among some triangles and planes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..tracer import plane
from ..tracer.hits import NOTHING, Name
from ..tracer.nearest import within_clip
from ..tracer.settings import Method, Precision
from ..tracer.triangle import METHODS
from ..tracer.world import WorldTriangles
from .pixel import Pixel

NOWHERE: Name = (NOTHING, NOTHING)  # what a ray sees that meets nothing
PLAIN = tuple((m, p) for m in Method if m.is_plain for p in Precision)

Meeting = tuple[float, Name, NDArray[np.float64]]  # t, what is seen, its barycentrics


def nearest(
    pixel: Pixel, triangles: WorldTriangles, method: Method, precision: Precision
) -> Meeting:
    """Return what a plain method sees; t is inf, NOWHERE is seen, where it is nothing.

    Parameters
    ----------
    pixel : Pixel
        Its planes are among what may be seen, its triangles are not.
    triangles : WorldTriangles
    method, precision
    """
    rays = pixel.rays(precision.dtype)
    with np.errstate(over="ignore"):  # what float32 cannot hold is inf, and is not hit
        corners = triangles.corners.astype(precision.dtype)
        planes = [
            (c.name, c.points.astype(precision.dtype)) for c in pixel.candidates if c.is_plane
        ]
    met: list[Meeting] = []
    if len(triangles.instance):
        hit, t, s = METHODS[method](rays, *corners)
        for k in np.flatnonzero(hit & within_clip(pixel.camera, t)):
            name = int(triangles.instance[k]), int(triangles.triangle[k])
            met.append((float(t[k]), name, s[:, k].astype(float)))
    for name, (point, normal) in planes:
        t = plane.intersect(rays, point[:, None], normal[:, None])
        if within_clip(pixel.camera, t)[0]:
            met.append((float(t[0]), name, np.zeros(3)))
    return min(met, key=lambda m: m[:2], default=(np.inf, NOWHERE, np.zeros(3)))
