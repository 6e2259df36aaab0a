"""How far from its pixel's centre Blender's sample may lie, for every pixel of a traced picture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene
from ...tracer.frame import Frame
from ...tracer.nearest import NOTHING
from ...tracer.progress import Work, result_of
from ..bounds import SNAPPING, pixel_error, view_error

_ROWS = 64  # looked at together, at least, so that a step is short in large pictures


def sample_band(scene: Scene, frame: Frame) -> NDArray[np.float64]:
    """Return how far from each pixel's centre Blender's sample may lie, (h, w) pixels.

    It is the largest of the surfaces seen in the 3 x 3 pixels around, and of those farther off that
    float32 may move as far as this.
    """
    return result_of(sample_bands(scene, frame, [slice(None)]))


def sample_bands(scene: Scene, frame: Frame, all_rows: list[slice]) -> Work[NDArray[np.float64]]:
    """Do the work of :func:`sample_band`, some rows at a time; yields the share that is done."""
    own = np.zeros(frame.t.shape)  # of the surface that the pixel itself shows
    for number, rows in enumerate(all_rows):
        hits = frame.hits(rows)
        seen = np.flatnonzero(hits.instance != NOTHING)
        hits = hits.take(seen)
        view = view_error(scene, hits, frame.positions(rows)[seen])
        own[rows].reshape(-1)[seen] = pixel_error(scene.camera, hits.t, view)
        yield number / len(all_rows)
    return (yield from spread(own))


def spread(own: NDArray[np.float64]) -> Work[NDArray[np.float64]]:
    """Return SNAPPING, or what is larger of those whose surface may move as far as the pixel.

    `own` (h, w) is how far, in pixels; it counts in a square that reaches as far as the power of
    two above it.
    """
    band = np.full(own.shape, SNAPPING)
    reach, height, most = 1, len(own), max(own.shape)
    while True:
        together = max(_ROWS, 2 * reach)
        for y in range(0, height, together):
            first = max(0, y - reach)
            around = own[first : y + together + reach]
            # Those that reach so far, but not to half of it: they were looked at before.
            ring = around > (reach / 2 if reach > 1 else 0)
            ring &= (around <= reach) | (reach >= most)
            if ring.any():
                largest = _largest_within(np.where(ring, around, 0.0), reach)[y - first :]
                here = band[y : y + together]
                np.maximum(here, largest[: len(here)], out=here)
            yield 1.0
        if reach >= most:
            return band
        reach *= 2


def _largest_within(values: NDArray[np.float64], reach: int) -> NDArray[np.float64]:
    """Return the largest value at most `reach` rows and columns away."""
    for axis in (0, 1):
        values = np.moveaxis(values, axis, 0).copy()
        done = 0  # so far away has been looked
        while done < min(reach, len(values)):
            step = min(max(done, 1), reach - done)
            before = values.copy()
            np.maximum(values[step:], before[:-step], out=values[step:])
            np.maximum(values[:-step], before[step:], out=values[:-step])
            done += step
        values = np.moveaxis(values, 0, axis)
    return values
