"""Which triangles may cover which pixels of a tile, batch by batch, so that memory is bounded.

In come a scene and how far from their pixel's centre rays may pass; out go `Pairs` of a pixel and a
triangle in world space, that a test decides.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .candidates import Pairs, pairs, pixel_bounds, within
from .progress import Work
from .world import Batch, batches, world_triangles

if TYPE_CHECKING:
    from ..scene import Region, Scene

PAIRS = 1 << 15  # tested together: arrays of this length stay in a core's cache
_BYTES_PER_PAIR = 1024  # temporaries of the most demanding test, float64, rounded up


@dataclass(frozen=True, eq=False)
class Culled:
    """Batches of a scene with the rows that each may cover.

    For rays within `reach` pixels of their pixel's centre, and vertices rounded to `dtype`; pairs
    may take some `memory`, in bytes.
    """

    scene: Scene
    dtype: np.dtype
    memory: int
    reach: float
    batches: list[Batch]
    rows: list[tuple[int, int]]
    refused: int  # triangles that are not finite in world space


def cull(scene: Scene, dtype: np.dtype, memory: int, reach: float) -> Work[Culled]:
    """Look at every batch once; yields 0, as nothing is traced yet."""
    found, rows, refused = [], [], 0
    for batch in batches(scene):
        _, (x0, x1, y0, y1), left_out = _bounds(scene, dtype, reach, batch)
        refused += left_out
        seen = (x0 < x1) & (y0 < y1)
        if seen.any():
            found.append(batch)
            rows.append((int(y0[seen].min()), int(y1[seen].max())))
        yield 0.0
    return Culled(scene, dtype, memory, reach, found, rows, refused)


def _bounds(scene: Scene, dtype: np.dtype, reach: float, batch: Batch):
    """Return a batch's triangles but those that are not finite, their bounds, and how many are."""
    triangles = world_triangles(scene, batch, dtype)
    finite = np.isfinite(triangles.corners).all(axis=(0, 1))
    refused = len(finite) - int(finite.sum())
    if refused:
        triangles = triangles.take(np.flatnonzero(finite))
    return triangles, pixel_bounds(scene.camera, triangles.corners, reach), refused


def candidates(
    culled: Culled, tile: Region, wanted: NDArray[np.bool_] | None = None
) -> Iterator[tuple[float, Pairs | None]]:
    """Yield the share of the work that is done, and the next pairs of a tile (None: none yet).

    Parameters
    ----------
    culled : Culled
    tile : Region
        Of n pixels, which the pairs index row by row from the lowest.
    wanted : (n,) bool, optional
        Only these pixels are proposed.
    """
    limit = max(1, min(PAIRS, culled.memory // (4 * _BYTES_PER_PAIR)))
    work = [
        b
        for b, (y0, y1) in zip(culled.batches, culled.rows, strict=True)
        if y0 < tile.y1 and y1 > tile.y0
    ]
    for done, batch in enumerate(work):
        triangles, bounds, _ = _bounds(culled.scene, culled.dtype, culled.reach, batch)
        bounds = within(bounds, tile)
        inside = np.flatnonzero((bounds[0] < bounds[1]) & (bounds[2] < bounds[3]))
        triangles = triangles.take(inside)
        yield done / len(work), None
        for pixel, row in pairs(bounds[:, inside], tile, limit):
            if wanted is not None:
                keep = np.flatnonzero(wanted[pixel])
                pixel, row = pixel[keep], row[keep]
            yield done / len(work), Pairs(pixel, row, triangles)
