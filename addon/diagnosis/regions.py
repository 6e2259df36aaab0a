"""Groups the pixels of a mask into regions, and lists the objects in each.

Pixels belong together if a chain of them links them in which no step is longer than a few pixels.
None is left out: where there would be too many regions, longer steps link them.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Array, Bools, Bytes, Index, Places
from ..pictures.bounds import largest_within
from ..pictures.identity import Identity
from ..scene import Scene
from ..tracer.frame import Frame

NEAR = 4  # pixels that grow around each one: what is at most 2 NEAR + 1 away touches then
MOST = 60  # regions of a picture: more frames than these would hide it

Side = tuple[Sequence[str], Index]  # names, and which of them each pixel (h, w) shows; else < 0


@dataclass(frozen=True)
class Region:
    """Pixels that lie near one another, and the smallest rectangle around them."""

    left: int  # its first column
    bottom: int  # its lowest row, from the lower left of the picture
    width: int
    height: int
    pixels: int  # of the mask in it
    objects: tuple[str, ...] = ()  # that either side shows in these pixels, the largest first
    cause: int = 0  # the number of the cause that most of its pixels have, if requested

    @property
    def top(self) -> int:
        """Its highest row."""
        return self.bottom + self.height - 1

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it; (left, top) is the pixel at its upper left."""
        return {
            "left": self.left,
            "top": self.top,
            "width": self.width,
            "height": self.height,
            "pixels": self.pixels,
            "objects": list(self.objects),
        }


def sides(scene: Scene, frame: Frame, identity: Identity | None) -> list[Side]:
    """Return the object in each pixel of the traced side, and of the other side if known."""
    found: list[Side] = [(scene.objects, frame.object_index)]
    if identity is not None:
        found.append((identity.names, identity.shown))
    return found


def regions(
    mask: Bools,
    shown: Sequence[Side] = (),
    near: int = NEAR,
    most: int = MOST,
    causes: Bytes | None = None,
) -> list[Region]:
    """Return the regions of the pixels that a mask holds, those with the most pixels first.

    Parameters
    ----------
    mask : (h, w) bool
    shown : sequence of Side
        Which objects each side shows: see :func:`sides`.
    near : int
        Pixels that are at most 2 near + 1 columns and rows apart are in one region. It is doubled
        for as long as there are more than `most`.
    most : int
        At least 1.
    causes : (h, w) uint8, optional
        The number of each pixel's cause.

    Returns
    -------
    list of Region
        Each pixel of the mask is in exactly one.
    """
    y, x = np.nonzero(mask)
    if not len(y):
        return []
    while True:
        label = labels(largest_within(mask, near))[y, x]
        unique, number = np.unique(label, return_inverse=True)
        if len(unique) <= most:
            break
        near = max(2 * near, 1)
    parts = [np.flatnonzero(number == n) for n in range(len(unique))]
    parts.sort(key=lambda part: (-len(part), part[0]))
    return [_region(y[part], x[part], shown, causes) for part in parts]


def _region(y: Places, x: Places, shown: Sequence[Side], causes: Bytes | None) -> Region:
    count: Counter[str] = Counter()
    for names, number in shown:
        found, many = np.unique(number[y, x], return_counts=True)
        for n, pixels in zip(found.tolist(), many.tolist(), strict=True):
            if 0 <= n < len(names):
                count[names[n]] += pixels
    left, bottom = int(np.min(x)), int(np.min(y))
    size = int(np.max(x)) - left + 1, int(np.max(y)) - bottom + 1
    objects = tuple(name for name, _ in count.most_common())
    cause = 0 if causes is None else int(np.argmax(np.bincount(causes[y, x])))
    return Region(left, bottom, *size, len(y), objects, cause)


def labels(mask: Bools) -> Array:
    """Label the 8-connected components of a mask, (h, w); pixels outside it get any label.

    Runs of pixels that touch in neighbouring rows are linked.
    """
    height, width = mask.shape
    edges = np.zeros((height, width + 3), np.int8)
    edges[:, 1 : width + 1] = mask
    change = np.flatnonzero(np.diff(edges, axis=1).ravel())
    start, end = change[::2], change[1::2]  # row * (width + 2) + column, the end exclusive
    # Runs of the next row that begin no later than a run ends, and end no sooner than it begins.
    first = np.searchsorted(end, start + (width + 2), "left")
    last = np.searchsorted(start, end + (width + 2), "right")
    many = np.maximum(last - first, 0)
    above = np.repeat(np.arange(len(start)), many)
    below = np.arange(many.sum()) + np.repeat(first - np.cumsum(many) + many, many)
    label = np.append(_linked(len(start), above, below), 0)
    rows, columns = np.divmod(np.arange(height * width), width)
    run = np.searchsorted(start, rows * (width + 2) + columns, "right") - 1
    return label[run].reshape(height, width)


def _linked(count: int, one: Places, other: Places) -> Places:
    """Return the smallest item that each item is connected with, (count,) (union-find)."""
    lowest = np.arange(count)
    while True:
        a, b = lowest[one], lowest[other]
        apart = a != b
        if not apart.any():
            return lowest
        one, other, a, b = one[apart], other[apart], a[apart], b[apart]
        np.minimum.at(lowest, np.maximum(a, b), np.minimum(a, b))
        while not np.array_equal(lowest, lowest[lowest]):
            lowest = lowest[lowest]
