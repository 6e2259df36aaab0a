"""Whose surface each pixel of Blender's picture shows: the scene drawn again, a colour an object.

The colours are set on copies of the user's objects, in the temporary scene and for one drawing. A
copy shares its mesh, materials and animation with the original, so that it costs little. What is
instanced shows the colour of the object that instances it, and counts as that.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..compare.identity import MOST, colors_of, decode
from ..scene import Camera
from .collections import replace_objects
from .planes import STANDS_FOR
from .viewport import picture, prepare

_NOT_DRAWN = ("ARMATURE", "CAMERA", "LATTICE", "LIGHT", "LIGHT_PROBE", "SPEAKER")


def draw_identity(
    tmp: Any, layer: str, source: str, camera: Camera
) -> tuple[tuple[str, ...], NDArray[np.int32]] | None:
    """Return the names of what may be shown, and which of them each pixel shows, (h, w).

    The temporary scene is not as it was afterwards: it is to be the last drawing.

    Parameters
    ----------
    tmp : bpy.types.Scene
        Prepared, with the stand-ins of infinite planes.
    layer : str
        Name of the view layer.
    source : {'viewport', 'workbench', 'cycles'}
    camera : Camera

    Returns
    -------
    tuple, or None
        None where there are more objects than colours tell apart.

    Raises
    ------
    RuntimeError, SizeError
        As :func:`viewport.picture` does.
    """
    drawn = [o for o in tmp.view_layers[layer].objects if o.type not in _NOT_DRAWN]
    owners = [o.get(STANDS_FOR) or o.name_full for o in drawn]
    names = tuple(dict.fromkeys(owners))
    if len(names) > MOST:
        return None
    number = {name: n for n, name in enumerate(names)}
    numbers = [number[owner] for owner in owners]
    prepare(tmp, True)
    tmp.display.shading.color_type = "OBJECT"
    with _colored(tmp, layer, drawn, colors_of(len(names))[numbers]):
        found = decode(picture(tmp, layer, source, camera, True), len(names))
    return names, found


@contextmanager
def _colored(
    tmp: Any, layer: str, objects: list[Any], colors: NDArray[np.float32]
) -> Iterator[None]:
    """Show copies of objects in colours (n, 3); stand-ins, which are ours, are coloured as such."""
    copies: dict[Any, Any] = {}
    collections: list[Any] = []
    view_layer = tmp.view_layers[layer]
    try:
        for obj, color in zip(objects, colors, strict=True):
            if STANDS_FOR in obj:
                obj.color = (*color, 1.0)
                continue
            copies[obj] = copy = obj.copy()
            copy.color = (*color, 1.0)
        hidden = [copy for obj, copy in copies.items() if obj.hide_get(view_layer=view_layer)]
        for copy in copies.values():  # whose corners or faces carry what is parented to it
            if copy.parent in copies and copy.parent.instance_type in ("VERTS", "FACES"):
                copy.parent = copies[copy.parent]
        replace_objects(tmp, layer, copies, collections)
        for copy in hidden:
            copy.hide_set(True, view_layer=view_layer)
        yield
    finally:
        bpy.data.batch_remove([*copies.values(), *collections])
