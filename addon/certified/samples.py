"""Finds what all samples of a band see at once: they are the pixels of a picture n times as large.

Where n is a power of two, that picture's rays have the bits of the samples' own: a film position in
its smaller pixels is n times as large, without rounding, and a pixel's size n times as small. So
the hits are the same, and every triangle is read once, not once for each sample.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..scene import Region, Scene
from ..tracer.hits import Hits
from ..tracer.nearest import TraceBand
from ..tracer.progress import Work


def traced_together(
    centre: TraceBand, find: Callable[[Scene, Region], Work[Hits]], scene: Scene, samples: int
) -> TraceBand:
    """Return what traces a band's rays; the first sample finds all of the band.

    Parameters
    ----------
    centre : TraceBand
        Traces the rays through the pixels' centres.
    find : callable
        Returns the hits of a region of a scene, through the centres.
    scene : Scene
    samples : int
        Samples a direction: a power of two, at least 2.
    """
    n = samples
    camera = scene.camera
    size = n * camera.width, n * camera.height
    larger = replace(camera, width=size[0], height=size[1], region=Region(0, 0, *size))
    fine = replace(scene, camera=larger)
    held: dict[Region, Hits] = {}  # of the last band, all samples

    def trace(band: Region, dx: float, dy: float) -> Work[Hits]:
        if dx == dy == 0:
            return (yield from centre(band, dx, dy))
        if band not in held:
            held.clear()
            held[band] = yield from find(fine, Region(*(n * v for v in vars(band).values())))
        rows, columns = np.ogrid[: band.height, : band.width]
        row, column = (n * v + int((d + 0.5) * n) for v, d in ((rows, dy), (columns, dx)))
        return held[band].take((row * (n * band.width) + column).ravel())

    return trace
