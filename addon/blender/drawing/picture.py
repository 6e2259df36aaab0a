"""Draws Blender's own picture of a scene by one of its engines, as an array.

Everything is set on a temporary copy of the user's scene, and what cannot be is put back: see
`values.py` and the judges' own files.
"""

from __future__ import annotations

from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from bpy.types import Depsgraph, Scene

from ...arrays import Colors
from ...pictures.source import SizeError
from ...scene import Camera
from ..evaluating import evaluated
from ..reading.pictures import pixels_of
from ..temporary import made_for
from ..turns import Turns
from ..versions import set_format
from .constant_material import constant_colors
from .judge import Judge

# Settings of a picture that can be compared: property of the scene, and value.
_ALWAYS = {
    "render.use_crop_to_border": True,
    "render.use_file_extension": True,
    "render.use_overwrite": True,
    "render.use_placeholder": False,
}
_LIKE_FOR_LIKE = {
    "display.shading.light": "FLAT",
    "display.shading.show_xray": False,
    "display.shading.show_shadows": False,
    "display.shading.show_cavity": False,
    "display.shading.show_object_outline": False,
    "display.shading.show_specular_highlight": False,
    "display.shading.show_backface_culling": False,
    "display.shading.use_dof": False,
    "display.render_aa": "OFF",
    "display.viewport_aa": "OFF",
    "render.film_transparent": True,
    "view_settings.view_transform": "Raw",
    "view_settings.look": "None",
    "view_settings.exposure": 0.0,
    "view_settings.gamma": 1.0,
    "view_settings.use_curve_mapping": False,
}


def prepare_scene(scene: Scene, judge: Judge, like_for_like: bool) -> dict[str, Any]:
    """Set a temporary scene up for a judge's picture to be compared; return what was set.

    Like for like means flat light, no effects, no anti-aliasing, a transparent film and raw
    colours. Where the colours come from stays the user's choice. The picture is one 32-bit EXR,
    like for like or not.
    """
    settings = _ALWAYS | _LIKE_FOR_LIKE | dict(judge.settings) if like_for_like else _ALWAYS
    for path, value in settings.items():
        owner, _, name = path.rpartition(".")
        setattr(scene.path_resolve(owner), name, value)
    render = scene.render
    shading = scene.display.shading
    set_format(render, "OPEN_EXR", "RGBA", "32")
    render.image_settings.exr_codec = "NONE"  # read at once, and removed
    return {
        "like_for_like": like_for_like,
        "light": shading.light,
        "color_type": shading.color_type,
        "film_transparent": render.film_transparent,
        "view_transform": scene.view_settings.view_transform,
    }


def picture(
    scene: Scene,
    judge: Judge,
    camera: Camera,
    depsgraph: Depsgraph,
    like_for_like: bool = True,
    is_last: bool = True,
) -> Turns[Colors]:
    """Have a prepared temporary scene drawn, in work that has its evaluation; return the picture.

    Parameters
    ----------
    scene : bpy.types.Scene
        The temporary scene.
    judge : Judge
        The engine that draws.
    camera : Camera
        Its region says which pixels are the picture's: the viewport ignores the render border.
    depsgraph : bpy.types.Depsgraph
        The evaluation.
    like_for_like : bool
        Whether it is drawn in constant colours.
    is_last : bool
        Whether no other picture is made of this evaluation.

    Returns
    -------
    (h, w, 4) float32
        Linear RGBA of the camera's region, row 0 at the bottom, alpha premultiplied.

    Raises
    ------
    RuntimeError
        If Blender made no picture.
    SizeError
        If it made one of another size.
    """
    with _set_up(judge, scene, depsgraph) if like_for_like else nullcontext():
        yield not is_last
    written = Path(scene.render.filepath)
    found = list(written.parent.glob(f"{written.name}*.exr"))
    if len(found) != 1:
        raise RuntimeError(f"Blender wrote no picture of '{scene.name}' ({judge.name}).")
    pixels = read(scene, found[0])
    found[0].unlink()
    region = camera.region
    if judge.needs_window and pixels.shape[:2] == (camera.height, camera.width):
        pixels = pixels[region.y0 : region.y1, region.x0 : region.x1]
    if pixels.shape[:2] != (region.height, region.width):
        raise SizeError(
            f"Blender's picture has {pixels.shape[1]} x {pixels.shape[0]} pixels, the camera's "
            f"region {region.width} x {region.height}."
        )
    return np.ascontiguousarray(pixels)


def _set_up(judge: Judge, scene: Scene, depsgraph: Depsgraph) -> AbstractContextManager[None]:
    """Have a judge draw an evaluation in constant colours, for a while."""
    if judge.set_up:
        return judge.set_up(scene, depsgraph)
    if not judge.solid:
        constant_colors(scene, depsgraph)
    return nullcontext()


def drawn_once(scene: Scene, judge: Judge, camera: Camera, like_for_like: bool) -> Colors:
    """Have a prepared temporary scene evaluated and drawn; return its :func:`picture`."""

    def turns() -> Turns[Colors]:
        return (yield from picture(scene, judge, camera, (yield False), like_for_like))

    return evaluated(scene, judge, turns())


def read(scene: Scene, path: Path, colorspace: str = "") -> Colors:
    """Return a picture's file as Blender reads it, in a colour space: (h, w, 4), row 0 below.

    It is read for a temporary scene.
    """
    image: Any = made_for(scene, bpy.data.images.load(str(path)))
    if colorspace:
        image.colorspace_settings.name = colorspace
    pixels = pixels_of(image)
    image.buffers_free()
    return pixels
