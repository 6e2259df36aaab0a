"""Traces a picture with enough rays a pixel that its coverage is the truth for the others."""

from __future__ import annotations

import numpy as np

from ..arrays import Colors
from ..methods import Method
from ..rendering import frame_of
from ..scene import Scene
from ..tracer.progress import Work
from ..tracer.settings import Settings

# Samples a pixel and direction of the converged picture. With 16, a straight edge along the pixels
# is off by at most 1/32 of a pixel's coverage. A large picture takes fewer, so that there are
# about CONVERGED_RAYS, but at least twice as many as what is held against it. Powers of two are
# traced together, in a fraction of the time.
CONVERGED = 16
CONVERGED_RAYS = 4_000_000
MOST = 64  # that `Settings` have: pixels are divided for more


def samples_of(pixels: int, compared: int) -> int:
    """Return how many a converged picture has, of so many pixels; `compared` have the others."""
    most = min(CONVERGED, (CONVERGED_RAYS / pixels) ** 0.5)
    return next(1 << k for k in range(8) if 1 << k >= 2 * compared and 2 << k > most)


def converged(scene: Scene, samples: int) -> Work[Colors]:
    """Return the colour of a scene with `samples` x `samples` a pixel, (h, w, 4) linear RGBA.

    It is certified; through a panorama, where that would take long, `watertight` in float64.
    """
    method = Method.CERTIFIED if scene.camera.projection.is_linear else Method.WATERTIGHT
    times = max(1, samples // MOST)
    divided = scene.seen_by(scene.camera.divided(times))
    frame = yield from frame_of(divided, Settings(method, samples=samples // times))
    width, height = scene.camera.width, scene.camera.height
    return frame.color.reshape(height, times, width, times, 4).mean(axis=(1, 3))


def coverage_error(color: Colors, truth: Colors) -> float:
    """Return the root mean square, over pixels and RGBA, of a picture's difference from `truth`.

    A smaller picture (h, w, 4) is enlarged to the size of `truth` first, each pixel as it is.
    """
    (h, w), (height, width) = color.shape[:2], truth.shape[:2]
    y = (2 * np.arange(height) + 1) * h // (2 * height)  # the pixel in which each centre lies
    x = (2 * np.arange(width) + 1) * w // (2 * width)
    return float(np.sqrt(np.mean((color[np.ix_(y, x)] - truth) ** 2, dtype=np.float64)))
