"""The boxes of pixels that a chunk's triangles may cover, from those of their vertices."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ....scene import Region, Scene
from ...candidates import pixel_bounds
from ...vector import gather
from ...world import world_corners
from .chunks import Expanded
from .film import Film

_TOGETHER = 1 << 15  # triangles at a time

Index = NDArray[np.integer]


def boxes_of(
    scene: Scene, film: Film, expanded: Expanded
) -> tuple[Index, Index, NDArray[np.float64]]:
    """Return lowest and highest x and y of triangles, (2, m) each, within the whole picture.

    And the most that the nearness of each can be, (m,).
    """
    vertices, corners = expanded.vertices, expanded.corners
    kind = vertices.box.dtype
    packed = vertices.box.view(np.int64 if kind.itemsize == 2 else np.complex128).ravel()
    count = corners.shape[1]
    low, high, nearest = np.empty((2, count), kind), np.empty((2, count), kind), np.empty(count)
    ends = np.array([[film.camera.width - 1], [film.camera.height - 1]], kind)
    for first in range(0, count, _TOGETHER):
        part = slice(first, first + _TOGETHER)
        some = corners[:, part].astype(np.intp)
        box = _smallest(*(gather(packed, c).view(kind) for c in some)).reshape(-1, 4).T
        np.maximum(box[:2], 0, out=low[:, part])
        np.minimum(-box[2:], ends, out=high[:, part])
        nearest[part] = _largest(*(gather(vertices.nearest, c) for c in some))
    if not vertices.ahead.all() or not vertices.finite.all():
        _mend(scene, film, expanded, low, high)
    return low, high, nearest


def _mend(scene: Scene, film: Film, expanded: Expanded, low: Index, high: Index) -> None:
    """Mend the boxes of triangles with a corner that is not before the eye, or not finite."""
    vertices, corners = expanded.vertices, expanded.corners
    whole = replace(film.camera, region=Region(0, 0, film.camera.width, film.camera.height))
    finite = vertices.finite.take(corners).all(axis=0)
    high[:, ~finite] = -1
    some = np.flatnonzero(finite & ~vertices.ahead.take(corners).all(axis=0))
    for part in np.split(some, range(_TOGETHER, len(some), _TOGETHER)):
        world = world_corners(scene, *expanded.names.of(part))
        x0, x1, y0, y1 = pixel_bounds(whole, world, reach=1.0)
        low[:, part], high[:, part] = (x0, y0), (x1 - 1, y1 - 1)


def _smallest(first: NDArray, *others: NDArray) -> NDArray:
    for other in others:
        first = np.minimum(first, other)
    return first


def _largest(first: NDArray, *others: NDArray) -> NDArray:
    for other in others:
        first = np.maximum(first, other)
    return first
