"""Finds the certified picture that `definition.py` defines: most pixels by floats with bounds.

For each tile of pixels, `candidates` proposes pairs of a pixel and a triangle: too many perhaps,
but it leaves out none that is a hit. The `Ladder` decides them, by error bounds where these leave
no doubt, else by the order of depths, else in integers. `sweep/` has the same
result faster, where the picture is linear in the film position.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..tracer.camera import camera_rays, corner_rays, film_positions
from ..tracer.candidates import Plan, candidates, cull
from ..tracer.hits import Hits, Statistics
from ..tracer.progress import Progress, Work, scaled
from .arithmetic import sound_steps
from .ladder import Ladder

if TYPE_CHECKING:
    from ..scene import Region, Scene

_ROWS = 8  # rows of pixels in a tile


@sound_steps
def plain(
    scene: Scene,
    region: Region,
    memory: int,
    dx: float = 0.0,
    dy: float = 0.0,
    statistics: Statistics | None = None,
) -> Work[Hits]:
    """Find the nearest hits of a region's rays, with proof, in small steps.

    Parameters
    ----------
    region : Region
        n pixels within the camera's region.
    memory : int
        About how many bytes the pairs may take.
    dx, dy : float
        Offset of each ray from its pixel's centre, in pixels; at most half a pixel.
    statistics : Statistics, optional
        Counters to add to.

    Returns
    -------
    Hits
        Of the n rays, row by row from the lowest.
    """
    statistics = statistics or Statistics()
    plan = yield from cull(scene, np.dtype(np.float64), memory, max(abs(dx), abs(dy)))
    around = corner_rays(scene.camera, dx, dy)  # bounds for these hold for every tile
    found = []
    for y in range(region.y0, region.y1, _ROWS):
        tile = replace(region, y0=y, y1=min(y + _ROWS, region.y1))
        rays = camera_rays(scene.camera, *film_positions(tile, dx, dy))
        work = _tile(plan, tile, Ladder.of(scene, rays, around), statistics)
        done = (y - region.y0) / region.height
        found.append((yield from scaled(work, done, tile.height / region.height)))
    return Hits.joined(found)


def _tile(plan: Plan, tile: Region, ladder: Ladder, statistics: Statistics) -> Work[Hits]:
    """Test a tile's candidates, and decide its rays."""
    statistics.pairs_tested += len(plan.scene.planes) * tile.width * tile.height
    for share, pairs in candidates(plan, tile):
        if pairs is not None:  # else only progress
            statistics.pairs_tested += len(pairs.pixel)
            ladder.test(pairs)
        yield Progress(share)
    return (yield from ladder.hits(statistics))
