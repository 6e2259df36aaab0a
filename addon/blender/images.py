"""Arrays -> images in Blender, and back; its texts and areas."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
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
    spaces = (area.spaces.active for area in areas(context, "IMAGE_EDITOR"))
    if space := next((s for s in spaces if s.mode == "VIEW"), None):
        space.image = image


def read(path: Path, colorspace: str = "") -> NDArray[np.float32]:
    """Return a picture's file as Blender reads it, in a colour space: (h, w, 4), row 0 below."""
    image = bpy.data.images.load(str(path))
    try:
        if colorspace:
            image.colorspace_settings.name = colorspace
        width, height = image.size
        pixels = np.empty(width * height * 4, np.float32)
        image.pixels.foreach_get(pixels)
        return pixels.reshape(height, width, 4)
    finally:
        bpy.data.images.remove(image)


def set_format(render: Any, file_format: str, color_mode: str, color_depth: str) -> None:
    """Set what files a `bpy.types.RenderSettings` writes."""
    settings = render.image_settings
    if hasattr(settings, "media_type"):  # from 5.0 on
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode = file_format, color_mode
    settings.color_depth = color_depth


def show_text(context: Any, name: str, content: str) -> Any:
    """Put a text into ours of this name, made where it is not there, and show it if it can be.

    One that the user has saved to a file is theirs, and is left as it is.
    """
    text = next((t for t in bpy.data.texts if t.get(MARK) == name), None)
    if text and text.filepath:
        del text[MARK]
        text = None
    if text is None:
        text = bpy.data.texts.new(name)
        text[MARK] = name
    text.from_string(content)
    if area := next(areas(context, "TEXT_EDITOR"), None):
        area.spaces.active.text = text
        area.spaces.active.top = 0
    return text


def areas(context: Any, kind: str) -> Iterator[Any]:
    """Yield the areas of a type that the context's window shows; without a window, none."""
    for area in context.window.screen.areas if context.window else ():
        if area.type == kind:
            yield area


def redraw(context: Any) -> None:
    """Have the context's window drawn again, where there is one."""
    for area in context.window.screen.areas if context.window else ():
        area.tag_redraw()
