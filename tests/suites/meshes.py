"""Meshes from their construction; closed ones are counter-clockwise from outside."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def on_sphere(rng: np.random.Generator, count: int, radius: float = 1.0) -> NDArray[np.float64]:
    """Return points (3, count) evenly distributed on a sphere."""
    points = rng.normal(size=(3, count))
    return radius * points / np.sqrt((points**2).sum(axis=0))


def grid(n: int) -> tuple[NDArray, NDArray]:
    """Return n x n quads of two triangles each, over [0, 1]^2 at z = 0, facing +Z."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    k = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()[:, None]
    triangles = np.concatenate([k + c for c in ([0, 1, n + 2], [0, n + 2, n + 1])])
    return np.stack((x.ravel(), y.ravel(), 0 * x.ravel()), axis=-1), triangles


def closed_fan(count: int) -> tuple[NDArray, NDArray]:
    """Return `count` triangles around (0, 0, -1), a fan closed by its indices, facing +Z."""
    angle = 2 * np.pi * np.arange(count) / count
    rim = np.stack((np.cos(angle), np.sin(angle), np.full(count, -1.0)), axis=-1)
    vertices = np.concatenate(([(0, 0, -1)], rim))
    k = np.arange(count)
    triangles = np.stack((0 * k, 1 + k, 1 + (k + 1) % count), axis=-1)
    return vertices, triangles


def box(low=-0.5, high=0.5) -> tuple[NDArray, NDArray]:
    """Return a box of 12 triangles; with integers, rays to its corners are true ties."""
    low, high = np.broadcast_to(low, 3), np.broadcast_to(high, 3)
    bits = np.array([[k >> 2 & 1, k >> 1 & 1, k & 1] for k in range(8)])
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    return np.where(bits, high, low).astype(np.float64), np.array(triangles)
