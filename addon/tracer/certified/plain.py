"""The certified picture by its definition: each ray meets every triangle that it may come near.

In come a scene and a region of its camera's pixels; out go `Hits`, proven. Read from here
downwards: `candidates` proposes pairs of a pixel and a triangle, and leaves out none that is hit.
A `Contest` decides them: by error bounds (`bounds`) where these leave no doubt, else in integers
(`exact`, `ties`, `order`; `settle` puts them together). `sweep/` finds the same sooner.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..camera import camera_rays, corner_rays, film_positions
from ..candidates import Culled, candidates, cull
from ..hits import Hits, Statistics
from ..progress import Work
from .contest import Contest

if TYPE_CHECKING:
    from ...scene import Region, Scene

_ROWS = 8  # of a tile


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
    region
        Of n pixels, within the camera's.
    memory : int
        Bytes that the pairs may take, about.
    dx, dy : float
        Where each ray passes its pixel's centre, in pixels; at most half a pixel.
    statistics
        To count in, if any.

    Returns
    -------
    Hits
        Of the n rays, row by row from the lowest.
    """
    statistics = statistics or Statistics()
    culled = yield from cull(scene, np.dtype(np.float64), memory, max(abs(dx), abs(dy)))
    found = []
    for y in range(region.y0, region.y1, _ROWS):
        tile = replace(region, y0=y, y1=min(y + _ROWS, region.y1))
        found.append((yield from _tile(culled, tile, dx, dy, statistics)))
    return Hits.joined(found)


def _tile(culled: Culled, tile: Region, dx: float, dy: float, statistics: Statistics) -> Work[Hits]:
    scene, camera = culled.scene, culled.scene.camera
    rays = camera_rays(camera, *film_positions(tile, dx, dy))
    contest = Contest.of(scene, rays, corner_rays(camera, dx, dy))
    statistics.pairs_tested += len(scene.planes) * tile.width * tile.height
    for share, pairs in candidates(culled, tile):
        if pairs is not None:
            statistics.pairs_tested += len(pairs.pixel)
            contest.enter(pairs)
        yield share
    return (yield from contest.hits(statistics))
