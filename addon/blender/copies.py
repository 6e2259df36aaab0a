"""Copies of the user's objects with colours of their own, in a temporary scene for one drawing.

A copy shares its mesh, materials and animation with the original, so that it costs little.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .collections import replace_objects
from .planes import STANDS_FOR

_NOT_DRAWN = ("ARMATURE", "CAMERA", "LATTICE", "LIGHT", "LIGHT_PROBE", "SPEAKER")


def drawn(tmp: Any, layer: str) -> list[Any]:
    """Return the objects of a view layer that may be drawn, or instance what is."""
    return [o for o in tmp.view_layers[layer].objects if o.type not in _NOT_DRAWN]


@contextmanager
def colored_copies(
    tmp: Any, layer: str, objects: list[Any], colors: NDArray[np.float32]
) -> Iterator[None]:
    """Show copies of a temporary scene's objects, in object colours (n, 3), for a while.

    Stand-ins of infinite planes are ours, and are coloured themselves.
    """
    copies: dict[Any, Any] = {}
    try:
        for obj, color in zip(objects, colors, strict=True):
            if STANDS_FOR in obj:
                obj.color = (*color, 1.0)
                continue
            copies[obj] = copy = obj.copy()
            copy.color = (*color, 1.0)
        for copy in copies.values():  # whose corners or faces carry what is parented to it
            if copy.parent in copies and copy.parent.instance_type in ("VERTS", "FACES"):
                copy.parent = copies[copy.parent]
        replace_objects(tmp, layer, copies)
        yield
        replace_objects(tmp, layer, {copy: obj for obj, copy in copies.items()})
    finally:
        bpy.data.batch_remove(list(copies.values()))
