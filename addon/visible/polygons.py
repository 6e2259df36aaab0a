"""Cuts faces to parts, as convex polygons: the corners of n of them are (k, c, n), in turn."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Index
from ..tracer.camera import film_of
from .faces import Faces


def cut(polygons: Floats, value: Floats) -> Floats:
    """Return where a linear function is not negative, from its values at the corners, (k, n).

    (k + 1, c, n): some corners are there twice; where nothing is left, NaN.
    """
    after, then = np.roll(polygons, -1, axis=0), np.roll(value, -1, axis=0)
    share = value / (value - then)
    crossing = polygons + share[:, None] * (after - polygons)
    k, c, n = polygons.shape
    every = np.stack((polygons, crossing), axis=1).reshape(2 * k, c, n)
    inside = ~(value < 0)  # or not known, where that is NaN
    kept = np.stack((inside, inside != np.roll(inside, -1, axis=0)), axis=1).reshape(2 * k, n)
    order = np.argsort(~kept, axis=0, kind="stable")[: k + 1]
    order = np.where(np.take_along_axis(kept, order, axis=0), order, order[0])
    out = np.take_along_axis(every, order[:, None], axis=0)
    out[..., ~kept.any(axis=0)] = np.nan
    return out


def middles(
    faces: Faces, face: Index, low: Floats, high: Floats, value: Floats | float = 1.0
) -> Floats:
    """Return about the middle of each face (n,) in its box from `low` to `high`, (2, n).

    Of what is left where a linear function is not negative, from its values at the corners, (3, n).
    """
    v = faces.vertices
    corners = faces.corners[:, face]
    w = v.w[corners]
    polygons = np.stack((v.p[corners] - low[0] * w, v.q[corners] - low[1] * w, w), axis=1)
    polygons = cut(polygons, np.broadcast_to(value, corners.shape))
    for axis, size in enumerate(high - low):
        polygons = cut(polygons, polygons[:, axis])
        polygons = cut(polygons, polygons[:, 2] * size - polygons[:, axis])
    at = polygons[:, :2] / polygons[:, 2:]
    after = np.roll(at, -1, axis=0)
    length = np.linalg.norm(after - at, axis=1, keepdims=True)
    middle = (length * (at + after)).sum(axis=0) / (2 * length.sum(axis=0))
    return np.clip(np.where(np.isfinite(middle), low + middle, (low + high) / 2), low, high)


def on_film(faces: Faces, face: Index, polygons: Floats) -> tuple[Floats, Floats, Floats]:
    """Return where parts of faces (n,) may appear: from low to high, (2, n), and the area."""
    k, _, n = polygons.shape
    x, y, _ = film_of(faces.film.camera, polygons.swapaxes(0, 1).reshape(3, -1))
    at = np.stack((x, y)).reshape(2, k, n)
    # A crossing is off no more than a corner; and it is rounded.
    room = 2 * faces.room[faces.corners[:, face]].max(axis=0)
    step = np.roll(at, -1, axis=1) - at
    inside = np.abs((at[0] * step[1] - at[1] * step[0]).sum(axis=0)) / 2
    area = inside + room * np.hypot(*step).sum(axis=0) + 4 * room**2
    return at.min(axis=1) - room, at.max(axis=1) + room, area
