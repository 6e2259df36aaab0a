"""Arrays -> images in Blender."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

TRACED, BLENDER, DIFFERENCE = (f"Reference Tracer {n}" for n in ("Traced", "Blender", "Difference"))

TRADE = "Reference Tracer Trade"

MARK = "reference_tracer"  # a custom property of the images that the add-on may write into


def plot_name(name: str) -> str:
    """Return what the image of a study's picture is named: 'map_this_and_that' by its words."""
    return f"Reference Tracer {name.replace('_', ' ').title()}"


def show(name: str, color: NDArray) -> Any:
    """Put a picture into our image of this name, made where it is not there.

    Linear RGBA (h, w, 4) floats are seen through the scene's view transform; uint8 are sRGB, and
    seen as they are.
    """
    height, width = color.shape[:2]
    plot = color.dtype == np.uint8
    image = next((i for i in bpy.data.images if i.get(MARK) == name), None)
    if image and image.source != "GENERATED":  # the user has saved it: it is theirs now
        del image[MARK]
        image = None
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=not plot)
        image[MARK] = name
    elif tuple(image.size) != (width, height):
        image.scale(width, height)
    values = np.ascontiguousarray(color, dtype=np.float32)
    image.pixels.foreach_set((values / 255 if plot else values).ravel())
    image.update()
    return image


def show_in_editor(context: Any, image: Any) -> None:
    """Show an image in the window's first image editor, if there is one."""
    for area in context.window.screen.areas if context.window else ():
        if area.type == "IMAGE_EDITOR" and area.spaces.active.mode == "VIEW":
            area.spaces.active.image = image
            break
