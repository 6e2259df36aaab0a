"""Traces a picture with enough rays a pixel that its coverage is the truth for the others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats, parts
from ..methods import Method
from ..rendering import steps
from ..scene import Region, Scene
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from ..tracer.settings import Settings

# Samples a pixel and direction of the converged picture. With 16, a straight edge along the pixels
# is off by at most 1/32 of a pixel's coverage. A large picture takes fewer, so that there are
# about CONVERGED_RAYS, but at least twice as many as what is held against it.
CONVERGED = 16
CONVERGED_RAYS = 4_000_000
BAND = 1 << 18  # rays of it that are held at a time: some 40 MiB


def converged(scene: Scene, samples: int) -> Work[Floats]:
    """Return the colour of a scene with `samples` x `samples` a pixel, (h, w, 4) linear RGBA.

    That of a picture so many times as large, averaged: the same rays as with `Settings.samples`, in
    a fraction of the time. It is certified; through a panorama, where that would take long,
    `watertight` in float64.
    """
    is_linear = scene.camera.projection.is_linear
    settings = Settings(Method.CERTIFIED if is_linear else Method.WATERTIGHT)
    width, height = scene.camera.width, scene.camera.height
    out = np.empty((height, width, 4))
    for rows in parts(height, max(1, BAND // (samples * samples * width))):
        y, end = rows.start, rows.stop
        region = Region(0, samples * y, samples * width, samples * end)
        band = replace(scene.camera, width=samples * width, height=samples * height, region=region)
        part = replace(scene, camera=band)
        frame = Frame.empty(part)
        yield from scaled(steps(part, settings, frame), y / height, (end - y) / height)
        blocks = frame.color.reshape(end - y, samples, width, samples, 4)
        out[rows] = blocks.mean(axis=(1, 3), dtype=np.float64)
    return out


def coverage_error(color: Floats, truth: Floats) -> float:
    """Return the root mean square, over pixels and RGBA, of a picture's difference from `truth`.

    A smaller picture (h, w, 4) is enlarged to the size of `truth` first, each pixel as it is.
    """
    (h, w), (height, width) = color.shape[:2], truth.shape[:2]
    y = (2 * np.arange(height) + 1) * h // (2 * height)  # the pixel in which each centre lies
    x = (2 * np.arange(width) + 1) * w // (2 * width)
    return float(np.sqrt(np.mean((color[np.ix_(y, x)] - truth) ** 2)))
