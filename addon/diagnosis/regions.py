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

from ..arrays import Bools, Bytes, Index, Integers, Places
from ..pictures.bounds import largest_within
from ..pictures.identity import Identity
from ..scene import Scene
from ..tracer.frame import Frame
from ..tracer.vector import grouped

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
    parts = sorted(grouped(number, len(unique)), key=lambda part: (-len(part), part[0]))
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


def labels(mask: Bools) -> Integers:
    """Label the 8-connected components of a mask, (h, w); pixels outside it get -1.

    A pixel takes the largest label beside it, and so do all that have its own (union-find).
    """
    label = np.full(mask.shape, -1, np.int32)
    own = np.arange(np.count_nonzero(mask), dtype=np.int32)
    while True:
        label[mask] = own
        near = largest_within(label, 1)[mask]
        if np.array_equal(own, near):
            return label
        linked = own.copy()
        np.maximum.at(linked, own, near)
        while not np.array_equal(linked, linked[linked]):
            linked = linked[linked]
        own = linked
