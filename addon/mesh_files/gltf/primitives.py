"""Makes triangles of a primitive's indices: triangle lists, strips and fans.

Source: Khronos, glTF 2.0 specification, 3.7.2.1.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Index, Integers
from ...scene import SceneError
from .accessors import Accessors, check_fits
from .document import Thing

TRIANGLES, STRIP, FAN = 4, 5, 6  # below: points and lines

Triangles = Integers  # (n, 3) int32, of corners


def triangles_of(primitive: Thing, count: int, accessors: Accessors) -> Triangles:
    """Return the triangles of a primitive with so many corners.

    Raises
    ------
    SceneError
        If an index is out of range, or the number of indices fits no triangles.
    """
    number = primitive.refers("indices")
    if number is None:
        order: Index = np.arange(count, dtype=np.int32)
    else:
        order = accessors.whole_numbers(number, primitive.label, "SCALAR", packed=True)[:, 0]
        _check_indices(order, count, primitive.label)
    mode, length = primitive.whole("mode", TRIANGLES), len(order)
    if length < 3 or (mode == TRIANGLES and length % 3):
        raise SceneError(f"{primitive.label} has {length} indices, which make no triangles")
    check_fits(36 * length, primitive.label)
    return _FACES[mode](order.astype(np.int32, copy=False))


def _check_indices(order: Index, count: int, label: str) -> None:
    """Refuse an index out of range, and one that would start a new strip."""
    highest = int(np.max(order))
    if highest == np.iinfo(order.dtype).max:
        raise SceneError(
            f"{label} has the index {highest}, which starts a strip anew in some graphics "
            "interfaces, and which glTF does not allow: export each strip by itself"
        )
    if highest >= count:
        raise SceneError(f"{label} has the index {highest}, and {count} corners")


def _of_list(order: Integers) -> Triangles:
    return order.reshape(-1, 3)


def _of_strip(order: Integers) -> Triangles:
    """Return triangles i, i + 1, i + 2, of which every second is turned round."""
    i = np.arange(len(order) - 2)
    odd = i % 2
    return np.stack((order[i], order[i + 1 + odd], order[i + 2 - odd]), axis=1)


def _of_fan(order: Integers) -> Triangles:
    """Return triangles i + 1, i + 2, 0."""
    hub = np.broadcast_to(order[0], len(order) - 2)
    return np.stack((order[1:-1], order[2:], hub), axis=1)


_FACES = {TRIANGLES: _of_list, STRIP: _of_strip, FAN: _of_fan}
