"""Whose surface each pixel of Blender's picture shows: the scene drawn again, a colour an object.

The colours are set on copies of the user's objects, in the temporary scene and for one drawing. A
copy shares its mesh, materials and animation with the original, so that it costs little. What is
instanced shows the colour of the object that instances it, and counts as that.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compare.identity import MOST_OBJECTS, colors_of, decode
from ..scene import Camera
from .judges import Judge
from .temporary import STANDS_FOR, colored_copies, drawn
from .viewport import picture, prepare


def draw_identity(
    tmp: Any, layer: str, judge: Judge, camera: Camera
) -> tuple[tuple[str, ...], NDArray[np.int32]] | None:
    """Return the names of what may be shown, and which of them each pixel shows, (h, w).

    The temporary scene is not as it was afterwards: it is to be the last drawing.

    Parameters
    ----------
    tmp : bpy.types.Scene
        Prepared, with the stand-ins of infinite planes.
    layer : str
        Name of the view layer.
    judge : Judge
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
    objects = drawn(tmp, layer)
    owners = [o.get(STANDS_FOR) or o.name_full for o in objects]
    names = tuple(dict.fromkeys(owners))
    if len(names) > MOST_OBJECTS:
        return None
    number = {name: n for n, name in enumerate(names)}
    numbers = [number[owner] for owner in owners]
    prepare(tmp, True)
    tmp.display.shading.color_type = "OBJECT"
    with colored_copies(tmp, layer, objects, colors_of(len(names))[numbers]):
        found = decode(picture(tmp, layer, judge, camera, True), len(names))
    return names, found
