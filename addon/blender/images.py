"""Arrays -> images in Blender, and PNG files through it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

TRACED, BLENDER, DIFFERENCE = (f"Reference Tracer {n}" for n in ("Traced", "Blender", "Difference"))

MARK = "reference_tracer"  # a custom property of the images that a comparison may write into


def show(name: str, color: NDArray[np.floating]) -> Any:
    """Put linear RGBA (h, w, 4) into our image of this name, made where it is not there."""
    height, width = color.shape[:2]
    image = next((i for i in bpy.data.images if i.get(MARK) == name), None)
    if image and image.source != "GENERATED":  # the user has saved it: it is theirs now
        del image[MARK]
        image = None
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
        image[MARK] = name
    elif tuple(image.size) != (width, height):
        image.scale(width, height)
    image.pixels.foreach_set(np.ascontiguousarray(color, dtype=np.float32).ravel())
    image.update()
    return image


def save_png(path: str | Path, picture: NDArray[np.uint8]) -> None:
    """Write an (h, w, 4) uint8 picture, row 0 at the bottom.

    Raises
    ------
    OSError
        If Blender cannot write the file.
    """
    height, width = picture.shape[:2]
    image = bpy.data.images.new("Reference Tracer File", width, height, alpha=True)
    try:
        image.pixels.foreach_set((picture.astype(np.float32) / 255).ravel())
        image.filepath_raw, image.file_format = str(path), "PNG"
        image.save()
    except RuntimeError as error:
        raise OSError(f"cannot write {path}: {error}") from error
    finally:
        bpy.data.images.remove(image)
