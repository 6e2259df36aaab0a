"""How much work each row of a picture is, about: so that it can be cut into bands of even work.

In comes a scene; out go rows. It is estimated from the boxes of some of the triangles, and nothing
but the time that a picture takes depends on it.

The unit is what a pixel takes that sees something. Every pixel takes a little, and so does every
triangle that a pixel is tested with. A band takes a look at all triangles of the instances in it,
before it can leave out those that are in other rows: the more they are, the fewer bands there are.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..scene import Region, Scene
from .candidates import pixel_bounds, spread
from .film import Film
from .instance_boxes import InstanceBoxes
from .world import world_corners

_SAMPLE = 1 << 13  # triangles
_CELLS = 32  # of rows: a large triangle of the sample stands for others above and below it
# Measured on the scenes of the benchmark.
_PIXEL, _PAIR, _TRIANGLE, _LOOK = 0.02, 0.005, 0.9, 0.15
_LOSS = 0.05  # of the time: what more bands may cost, so that nobody is the last for long
_ROUNDS = 2  # bands that everybody takes, at most: triangles that cross their ends are done twice


@dataclass(frozen=True)
class Workload:
    """What each row of the region takes (h,), from the lowest; and what every band takes."""

    rows: NDArray[np.float64]
    band: float


def workload(scene: Scene) -> Workload:
    """Return what a scene's picture takes."""
    region = scene.camera.region
    boxes, weight, looks = _boxes(scene)
    x0, x1, y0, y1 = boxes - np.array([[region.x0]] * 2 + [[region.y0]] * 2)
    pairs, triangles = (
        _over_rows(y0, y1, v, region.height) for v in (weight * (x1 - x0), weight / (y1 - y0))
    )
    # Half of a box is triangle. Where surfaces hide others, the ends of what is seen are the limit.
    covered = np.minimum(_smooth(pairs) / 2, _extent(x0, x1, y0, y1, region))
    if scene.planes:
        covered[:] = region.width
    rows = _PIXEL * region.width + covered + _PAIR * pairs + _TRIANGLE * triangles
    return Workload(rows, _LOOK * looks)


def even_bands(region: Region, load: Workload, processes: int, most_rows: int) -> list[Region]:
    """Cut a region into bands of about as much work, at least as many as processes if possible."""
    each = load.rows.sum() / processes
    rounds = int(np.clip(1 + _LOSS * each / max(load.band, 1.0), 1, _ROUNDS))
    count = min(rounds * processes, region.height)
    done = np.cumsum(load.rows)
    cuts = np.searchsorted(done, done[-1] * np.arange(1, count) / count) + 1
    ends = np.unique([0, *np.minimum(cuts, region.height), region.height]).tolist()
    return [
        Region(region.x0, region.y0 + y, region.x1, region.y0 + min(y + most_rows, end))
        for start, end in pairwise(ends)
        for y in range(start, end, most_rows)
    ]


def _boxes(scene: Scene) -> tuple[NDArray, NDArray[np.float64], int]:
    """Return boxes of some of the triangles in view, (4, m), and how many each stands for, (m,).

    With how many triangles a band looks at: those of the instances that are in its rows.
    """
    if not scene.instances:
        return np.zeros((4, 0), np.int32), np.zeros(0), 0
    counts = np.array([len(m.triangles) for m in scene.meshes], np.intp)[scene.instance_meshes]
    around, region = InstanceBoxes.of(scene, Film(scene.camera)), scene.camera.region
    seen = np.flatnonzero(around.in_view & (counts > 0))
    rows = np.minimum(around.high[1], region.y1 - 1) - np.maximum(around.low[1], region.y0) + 1
    looks = int((counts * np.clip(rows, 0, region.height))[seen].sum()) // region.height
    total = int(counts[seen].sum())
    few = seen[:: -(-len(seen) // _SAMPLE) or 1]
    counts = counts[few]
    # At least some of each instance: few triangles may be the larger ones.
    sample = np.ceil(counts * (_SAMPLE / max(total, 1))).astype(np.intp)
    sample = np.minimum(np.maximum(sample, 8), counts)
    which, number = spread(np.arange(len(few)), sample)
    # Not at even steps, which may be those of how the mesh was made.
    shift = np.random.default_rng(0).random(len(number))
    triangle = ((number + shift) * (counts / sample)[which]).astype(np.intp)
    weight = (counts / sample)[which] * (len(seen) / max(len(few), 1))
    corners = world_corners(scene, few[which], triangle)
    finite = np.flatnonzero(np.isfinite(corners).all(axis=(0, 1)))
    boxes, weight = pixel_bounds(scene.camera, corners[..., finite]), weight[finite]
    covers = np.flatnonzero((boxes[0] < boxes[1]) & (boxes[2] < boxes[3]))
    return boxes[:, covers], weight[covers], looks


def _over_rows(y0: NDArray, y1: NDArray, value: NDArray, height: int) -> NDArray[np.float64]:
    """Return the sums over the rows y0 <= y < y1 of each value: (height,)."""
    starts, ends = (np.bincount(y, value, height + 1) for y in (y0, y1))
    return np.maximum(np.cumsum(starts - ends)[:height], 0)


def _smooth(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return for every row the mean over its cell."""
    starts = np.arange(0, len(rows), -(-len(rows) // _CELLS))
    counts = np.diff(starts, append=len(rows))
    return np.repeat(np.add.reduceat(rows, starts) / counts, counts)


def _extent(x0: NDArray, x1: NDArray, y0: NDArray, y1: NDArray, region: Region) -> NDArray:
    """Return how far apart the ends of what is seen in each row are, in pixels: (height,)."""
    size = -(-region.height // _CELLS)
    first, last = y0 // size, (y1 - 1) // size
    which, number = spread(np.arange(len(first)), last - first + 1)
    cell = first[which] + number
    low, high = np.full(_CELLS, region.width), np.zeros(_CELLS, np.intp)
    np.minimum.at(low, cell, x0[which])
    np.maximum.at(high, cell, x1[which])
    return np.repeat(np.maximum(high - low, 0), size)[: region.height]
