"""Finds boxes of the film in which faces may be seen, from what is hidden in its cells."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Bools, Floats, Index, parts
from ..scene import Plane, Scene
from ..tracer.progress import Work
from ..tracer.vector import spread
from .cells import TOP, Cells
from .faces import Faces
from .planes import behind_plane

_ROOM = 2.0**-8  # pixels around what may be seen, so that more than a corner is there
_TOGETHER = 1 << 16  # boxes that are looked at together


class Boxes(NamedTuple):
    """Boxes of the film, from `low` to `high` (2, n), in which faces (n,) may be seen."""

    face: Index
    low: Floats
    high: Floats

    def take(self, rows: Index | slice) -> Boxes:
        """Return some of the boxes."""
        return Boxes(self.face[rows], self.low[:, rows], self.high[:, rows])

    def quarters(self) -> Boxes:
        """Return the quarters of each."""
        ends = np.stack((self.low, (self.low + self.high) / 2, self.high))
        low = [ends[[j, k], [0, 1]] for j in (0, 1) for k in (0, 1)]
        high = [ends[[j, k], [0, 1]] for j in (1, 2) for k in (1, 2)]
        return Boxes(np.tile(self.face, 4), np.hstack(low), np.hstack(high))

    def within(self, low: Floats, high: Floats) -> Boxes:
        """Return what of the boxes is in the boxes of their faces, (2, m) each."""
        low = np.maximum(self.low, low[:, self.face])
        return Boxes(self.face, low, np.minimum(self.high, high[:, self.face]))

    def areas(self, count: int) -> Floats:
        """Return the sum of the areas for each of `count` faces, (count,)."""
        return np.bincount(self.face, np.prod(self.high - self.low, axis=0), count)

    def around(self, count: int) -> tuple[Floats, Floats]:
        """Return the box around all those of each of `count` faces, (2, count) from low to high."""
        low, high = np.full((2, 2, count), np.inf)
        for k in (0, 1):
            np.minimum.at(low[k], self.face, self.low[k])
            np.minimum.at(high[k], self.face, -self.high[k])
        return low, -high


def boxes_of(scene: Scene, faces: Faces, cells: Cells, some: Index) -> Work[Boxes]:
    """Return the boxes in which faces (n,) may be seen: hardly larger than a pixel's cells."""
    levels, new = _covering(faces, cells, some)
    boxes = new.take(slice(0))
    for level in range(TOP, -1, -1):
        pairs = zip(boxes.quarters(), new.take(np.flatnonzero(levels == level)), strict=True)
        boxes = Boxes(*(np.concatenate(pair, axis=-1) for pair in pairs))
        farthest = cells.hidden_from(level, boxes.low)
        rows = np.flatnonzero(faces.nearest[boxes.face] >= farthest)
        left = [rows[:0]]
        for part in parts(len(rows), _TOGETHER):
            own = rows[part]
            planes = scene.planes if level == 0 else ()
            left.append(own[_may_show(scene, faces, boxes.take(own), farthest[own], planes)])
            yield None
        boxes = boxes.take(np.concatenate(left))
    room = Boxes(boxes.face, boxes.low - _ROOM, boxes.high + _ROOM)
    return room.within(faces.low, faces.high)


def _covering(faces: Faces, cells: Cells, some: Index) -> tuple[Index, Boxes]:
    """Return cells about as large as each face (n,), all that it may reach; and their levels."""
    low, high = faces.low[:, some], faces.high[:, some]
    level = np.clip(np.frexp(np.maximum(*(high - low)))[1], 0, TOP)
    size = 2.0**level
    first, last = (np.floor((end - cells.corner) / size) for end in (low, high))
    width, height = (last - first + 1).astype(np.intp)
    which, number = spread(np.arange(len(some)), width * height)
    y, x = np.divmod(number, width[which])
    size = size[which]
    low = cells.corner + (first[:, which] + (x, y)) * size
    return level[which], Boxes(some[which], low, low + size)


def _may_show(
    scene: Scene, faces: Faces, boxes: Boxes, farthest: Floats, planes: Sequence[Plane]
) -> Bools:
    """Return in which of n boxes the faces may be seen, before planes and `farthest` (n,)."""
    boxes = boxes.within(faces.low, faces.high)
    out = (boxes.low <= boxes.high).all(axis=0)
    rows = np.flatnonzero(out)
    face, low, high = boxes.take(rows)
    farthest = farthest[rows]
    for plane in planes:
        farthest = np.maximum(farthest, behind_plane(scene, faces, plane, low, high))
    found = faces.within(face, low, high)
    missed = found.beside | faces.clip.outside(found.least, found.most)
    out[rows] = ~(missed | (found.most < farthest))
    return out
