"""Cameras and triangles that are as hostile as they come."""

from __future__ import annotations

import numpy as np
from reference_tracer.scene import Region, ViewWindow
from reference_tracer.tracer.camera import pixel_size

TRIANGLES = 40


def hostile_camera(make, rng):
    """Return a camera of any scale, place, shape of axes, window, border and clip range."""
    orthographic, scale = bool(rng.integers(2)), 10.0 ** rng.uniform(-6, 6)
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]  # rotated or mirrored
    axes = (
        axes,
        axes @ (np.eye(3) + rng.uniform(-0.5, 0.5, (3, 3)) * (1 - np.eye(3))),
        axes @ np.array([[1, 0.97, 0], [0, 0.25, 0], [0, 0, 1]]),
        np.diag(rng.choice([-1.0, 1.0], 3)),
        axes @ np.array([[1, 1, 0], [0, 10.0 ** rng.uniform(-9, -2), 0], [0, 0, 1]]),
    )[rng.integers(5)]
    eye = scale * rng.normal(size=3) * 10.0 ** rng.choice([-3, 0, 2, 5])
    width, height = (int(n) for n in rng.integers(4, 21, 2))
    half = (scale if orthographic else 1) * 10.0 ** rng.uniform(-3, 1.5)
    x, y = rng.uniform(-2, 2, 2) * half * rng.integers(2)
    wide = half * width / height
    region = None
    if rng.integers(2):
        (x0, x1), (y0, y1) = (np.sort(rng.choice(n + 1, 2, replace=False)) for n in (width, height))
        region = Region(int(x0), int(y0), int(x1), int(y1))
    start = scale * 10.0 ** rng.uniform(-4, 0)
    return scale, make.camera(
        width,
        height,
        eye=eye,
        axes=axes,
        orthographic=orthographic,
        region=region,
        window=ViewWindow(x - wide, x + wide, y - half, y + half),
        clip_start=start,
        clip_end=start * 10.0 ** rng.uniform(0.3, 6),
    )


def hostile_triangles(camera, scale, rng):
    """Return corners (3, 3, n): tiny to huge, through pixel centres, behind the eye."""
    n = TRIANGLES
    size = 10.0 ** rng.uniform(-3, 2, n)  # pixels
    film = [
        rng.uniform(-0.5, 1.5, n) * extent + size * rng.normal(size=(3, n))
        for extent in (camera.width, camera.height)
    ]
    film = np.where(rng.random(n) < 0.3, np.floor(film) + 0.5, film)
    slant = np.where(rng.random((3, n)) < 0.5, 1, 10.0 ** rng.uniform(-1, 1, (3, n)))
    depth = scale * 10.0 ** rng.uniform(-3, 2, n) * slant
    depth *= np.where(rng.random(n) < 0.25, rng.choice([-1, 1, 0], (3, n)), 1)
    (width, height), w = pixel_size(camera), camera.window
    x, y = w.left + film[0] * width, w.bottom + film[1] * height
    if not camera.projection.shares_direction:
        x, y = (v * np.where(depth == 0, 1, np.abs(depth)) for v in (x, y))
    corners = [
        camera.origin[:, None]
        + x[i] * camera.right[:, None]
        + y[i] * camera.up[:, None]
        + depth[i] * camera.forward[:, None]
        for i in range(3)
    ]
    return np.stack(corners).astype(rng.choice([np.float64, np.float32]))
