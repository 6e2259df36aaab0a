"""Blender's own picture of a scene, as an array, by one of its engines.

Everything is set on a temporary copy of the user's scene. What cannot live on a copy is put back:
the preference for the viewport's anti-aliasing and the mark that preferences were changed; and what
`drawings.py` and `cycles.py` set.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...compare.picture import SizeError
from ...scene import Camera, SceneError
from ..versions import set_format
from .judges import Judge
from .temporary import values_kept

# What a picture that can be compared needs: property of the scene, and value.
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


def prepare_scene(scene: Any, like_for_like: bool) -> dict[str, Any]:
    """Set a temporary scene up for a picture that can be compared; return what was set.

    Like for like is flat light, no effect and no anti-aliasing, on a transparent film, raw; the
    source of the colours stays the user's. In either way the picture is one 32-bit EXR.
    """
    for path, value in (_ALWAYS | (_LIKE_FOR_LIKE if like_for_like else {})).items():
        owner, _, name = path.rpartition(".")
        setattr(scene.path_resolve(owner), name, value)
    render, shading = scene.render, scene.display.shading
    set_format(render, "OPEN_EXR", "RGBA", "32")
    render.image_settings.exr_codec = "NONE"  # read at once, and removed
    return {
        "like_for_like": like_for_like,
        "light": shading.light,
        "color_type": shading.color_type,
        "film_transparent": render.film_transparent,
        "view_transform": scene.view_settings.view_transform,
    }


def anti_aliasing(scene: Any, judge: Judge, like_for_like: bool) -> str:
    """Return what smooths the edges of the picture that :func:`picture` makes; 'OFF' for nothing.

    In a window that is the user's preference, whatever the scene says.
    """
    if like_for_like:
        return "OFF"
    if judge.needs_window:
        return bpy.context.preferences.system.viewport_aa
    return scene.display.render_aa


def solid_shading(context: Any) -> Any:
    """Return the solid shading of the 3D view the user is in, else of the window's first one."""
    areas = [context.area, *(context.window.screen.areas if context.window else ())]
    found = (a.spaces.active.shading for a in areas if a and a.type == "VIEW_3D")
    return next((shading for shading in found if shading.type == "SOLID"), None)


def use_view_shading(scene: Any, shading: Any) -> None:
    """Copy a 3D view's own solid shading to a scene, for a picture *as it is*."""
    own = scene.display.shading
    for prop in own.bl_rna.properties:
        if not prop.is_readonly and prop.identifier not in ("type", "rna_type"):
            with suppress(TypeError):  # an enum whose items depend on the others: theirs come first
                setattr(own, prop.identifier, getattr(shading, prop.identifier))


def picture(
    scene: Any, layer: str, judge: Judge, camera: Camera, like_for_like: bool
) -> NDArray[np.float32]:
    """Return Blender's picture of a prepared temporary scene, (h, w, 4).

    Linear RGBA of the camera's region, row 0 at the bottom, alpha premultiplied. The camera says
    which pixels are the picture's: the viewport ignores the render border.

    Raises
    ------
    SceneError, RuntimeError
        If Blender made no picture.
    SizeError
        If it made one of another size.
    """
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "picture")
        with judge.set_up(judge, scene, layer) if like_for_like else nullcontext():
            try:
                if judge.needs_window:
                    _draw_viewport(scene, layer, like_for_like)
                else:
                    scene.render.engine = judge.engine
                    with values_kept():
                        bpy.ops.render.render(scene=scene.name, write_still=True)
            except RuntimeError as error:  # what Blender reports, as that a GPU has no such size
                raise SceneError(f"{judge.name} draws no picture: {error}") from error
        found = list(Path(folder).glob("picture*.exr"))
        if len(found) != 1:
            raise RuntimeError(f"Blender wrote no picture of '{scene.name}' ({judge.name}).")
        pixels = read(found[0])
    r = camera.region
    if judge.needs_window and pixels.shape[:2] == (camera.height, camera.width):
        pixels = pixels[r.y0 : r.y1, r.x0 : r.x1]
    if pixels.shape[:2] != (r.height, r.width):
        raise SizeError(
            f"Blender's picture has {pixels.shape[1]} x {pixels.shape[0]} pixels, the camera's "
            f"region {r.width} x {r.height}."
        )
    return np.ascontiguousarray(pixels)


def _draw_viewport(scene: Any, layer: str, like_for_like: bool) -> None:
    # Adding a window, area or region to the override crashes Blender (4.3, 5.2).
    override = bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[layer])
    with _viewport_aa("OFF") if like_for_like else nullcontext(), override:
        bpy.ops.render.opengl(view_context=False, write_still=True)


@contextmanager
def _viewport_aa(value: str) -> Iterator[None]:
    """Set the preference that alone decides on a window's anti-aliasing, and put it back."""
    preferences = bpy.context.preferences
    before, dirty = preferences.system.viewport_aa, preferences.is_dirty
    preferences.system.viewport_aa = value
    try:
        yield
    finally:
        preferences.system.viewport_aa = before
        preferences.is_dirty = dirty


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
