"""Reads pictures that are open in Blender, as files are read: an image, and the Render Result."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bpy.types import Image, Scene

from ...arrays import Colors, by_runs
from ...files.exr import MissingLibraryError
from ...files.images import EIGHT_BITS, PictureFile, StoredPicture, decoded, open_picture
from ...scene import SceneError
from ..values import values_restored
from ..versions import LAYERS, set_format
from .rendered import engine_of_result, result_image

_READ = (".png", ".exr")  # as files: what Blender makes of 16 bits, and who wrote it, is lost else
_KINDS = "FILE", "GENERATED"
# In the header of an EXR of all layers: their names, and what Cycles notes for each. (Not every
# Blender brings a library that reads it.)
_LAYER = re.compile(rb"\0([^\0]+)\.Combined\.R\0")
_OF_CYCLES = re.compile(rb"cycles\.[^\0]+\.samples\0string\0")
# Of an image's file, each after those that it depends on: a format brings its own space.
_SETTINGS = (
    "media_type",
    "file_format",
    "color_mode",
    "color_depth",
    "exr_codec",
    "views_format",
    "linear_colorspace_settings.name",
)


@dataclass(frozen=True)
class Held(PictureFile):
    """The pixels that Blender holds of an image."""

    image: Image
    engine: str = ""  # this and the remarks as `StoredPicture` has them
    remarks: tuple[str, ...] = ()
    rendered_by: str = ""  # Blender's name of the engine, of a Render Result, where it is known

    def read(self) -> StoredPicture:
        """Read the pixels: floats are linear, bytes have sRGB's curve and a straight alpha."""
        image = self.image
        color = pixels_of(image)
        opaque = image.channels < 4 or image.alpha_mode == "NONE"
        if image.is_float:
            return StoredPicture(color, 0, opaque, self.remarks, self.engine)
        color = by_runs(lambda some: decoded(some).astype(np.float32), color.reshape(-1, 4))
        return StoredPicture(color.reshape(self.height, self.width, 4), EIGHT_BITS, opaque)


def pixels_of(image: Any) -> Colors:
    """Return what Blender holds of an image, (h, w, 4), row 0 below."""
    width, height = image.size
    pixels = np.empty((height, width, 4), np.float32)
    image.pixels.foreach_get(pixels.reshape(-1))
    return pixels


def image_file(image: Image) -> PictureFile:
    """Return an image of Blender's, by its file where it shows no more than that.

    Raises
    ------
    SceneError
        If it has no pixels that could be compared, saying why.
    OSError
        If its file is damaged.
    """
    if image is None:
        raise SceneError("There is no image to compare with: choose one below Compare With.")
    name = f"Image '{image.name}'"
    if image.source not in _KINDS:
        raise SceneError(f"{name} is a {image.source.lower()}: save the one picture of it.")
    path = Path(bpy.path.abspath(image.filepath, library=image.library))
    if image.source == "FILE" and not image.is_dirty and not image.packed_file:
        if not path.is_file():
            raise SceneError(f"{name} has no file '{path}': find it, or choose another image.")
        if path.suffix.lower() in _READ:
            with suppress(MissingLibraryError):  # of an EXR: not every Blender brings it
                return open_picture(path)
    width, height = image.size
    if not width * height:
        raise SceneError(f"{name} has no pixels: load it again, or choose another one.")
    space: Any = image.colorspace_settings.name
    if not image.is_float and space != "sRGB":
        raise SceneError(
            f"{name} has 8 bits a channel in the colour space '{space}': what it shows is known of "
            "sRGB. Save it as a float image, or set its Color Space to sRGB if it is that."
        )
    return Held(Path(image.name), width, height, image)


@contextmanager
def render_result(scene: Scene, layer: str) -> Iterator[Held]:
    """Give a scene's Render Result as a file, for a while: its pixels cannot be read otherwise.

    It says so where it may show more, or less, than the view layer that is compared.

    Raises
    ------
    SceneError
        If there is none, or it is stereo.
    """
    image = result_image()
    settings: Any = scene.render.image_settings
    kept = [(settings, name) for name in _SETTINGS]
    if settings.color_management != "OVERRIDE":
        kept.pop()  # its own space, which is not used then
    with tempfile.TemporaryDirectory() as folder, values_restored(kept):
        path = Path(folder) / "Render Result.exr"
        # Its own colour management stays: switching that off and on has Blender overwrite it. The
        # format makes its linear space the scene's.
        set_format(scene.render, "OPEN_EXR", "RGBA", "32")
        settings.views_format = "INDIVIDUAL"
        try:
            if image is None:
                raise RuntimeError("nothing was rendered")
            image.save_render(str(path), scene=scene)
            loaded: Any = bpy.data.images.load(str(path))
        except RuntimeError as error:
            why = f"has no Render Result: render it first ({error})"
            if any(Path(folder).iterdir()):  # a file for each view
                why = "has a stereo Render Result: switch off Stereoscopy, and render again"
            raise SceneError(f"Scene '{scene.name}' {why}.") from error
        width, height = loaded.size
        try:
            made = _header_of_layers(image, scene, path.with_stem("Layers"))
            # Without a view layer, the picture was composed of none.
            is_rendered = not set(_LAYER.findall(made)) <= {b"Composite"}
            engine = "cycles" if _OF_CYCLES.search(made) else "other"
            rendered_by = engine if engine == "cycles" else engine_of_result(scene)
            remarks = tuple(_remarks(scene, layer, is_rendered))
            known = rendered_by if is_rendered else ""
            yield Held(Path(image.name), width, height, loaded, engine, remarks, known)
        finally:
            bpy.data.images.remove(loaded)


def _header_of_layers(image: Image, scene: Scene, path: Path) -> bytes:
    """Return how a file of all layers of a scene's Render Result begins: with their names."""
    set_format(scene.render, LAYERS, "RGBA", "16")
    scene.render.image_settings.exr_codec = "NONE"  # the quickest
    image.save_render(str(path), scene=scene)
    with path.open("rb") as file:
        return file.read(1 << 16)


def _remarks(scene: Scene, layer: str, is_rendered: bool) -> Iterator[str]:
    """Say what a scene's Render Result shows beside a view layer, as far as its settings tell.

    Of several view layers that are rendered, the first is the picture.
    """
    if not is_rendered:
        yield "no engine rendered it, but a 3D view (View > Render) or the Sequencer drew it"
    rendered = [v.name for v in scene.view_layers if v.use]
    if not scene.render.use_single_layer and rendered and rendered[0] != layer:
        yield f"it shows the view layer '{rendered[0]}', and '{layer}' was traced"
    if scene.render.use_stamp:
        yield "metadata is burned into it"
