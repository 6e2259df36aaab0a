"""Polygons for tests: (n, 2) float64, wound to the left, with their areas."""

from __future__ import annotations

import numpy as np


def star(rng, count):
    """Return corners around the origin, which sees them all, and is inside."""
    angles = (np.arange(count) + rng.uniform(0, 0.9, count)) * 2 * np.pi / count
    radii = rng.uniform(0.2, 1, count)
    return np.column_stack((radii * np.cos(angles), radii * np.sin(angles)))


def spiral(rng, count):
    """Return a band round the origin: of 40 corners, more than once."""
    angles = np.linspace(0, rng.uniform(0.2, 0.25) * count, count // 2)
    radii = 1 + angles
    outer = np.column_stack((radii * np.cos(angles), radii * np.sin(angles)))
    return np.concatenate((outer, 0.8 * outer[::-1]))


def area(points):
    """Return the area, with its sign."""
    x, y = points.T
    return 0.5 * float(x @ np.roll(y, -1) - np.roll(x, -1) @ y)


def in_space(rng, points, scale=1.0, offset=0.0):
    """Return the corners (n, 3) in a random plane."""
    axes, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return scale * (points @ axes[:, :2].T + offset * rng.normal(size=3))
