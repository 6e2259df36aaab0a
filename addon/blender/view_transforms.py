"""Blender's view transforms as functions of a colour, for pictures that went through one.

Blender itself transforms the colours that a traced scene can show, by saving a picture of them: a
constant colour has no others. A scene with colours between corners has more, and gets none.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..compare.picture import Curve
from ..images import curve_undone
from ..scene import Scene
from . import images
from .temporary import temporary_scene

COMMON = ("Filmic", "AgX", "Khronos PBR Neutral", "Standard")
MOST = 4096  # colours


def view_transforms(user: Any, scene: Scene) -> tuple[Curve, ...]:
    """Return the scene's own view transform, then the common ones that this Blender has.

    Parameters
    ----------
    user : bpy.types.Scene
        The user's, which stays as it is.
    scene : Scene
        What was exported of it.
    """
    rows = [scene.color_table, [scene.background], *([p.color] for p in scene.planes)]
    table = np.unique(np.concatenate(rows)[:, :3], axis=0)
    if len(table) > MOST or any(m.corner_colors is not None for m in scene.meshes):
        return ()
    with temporary_scene(user) as tmp:
        return tuple(
            Curve(f"the view transform {name}", _looked_up(table, shown))
            for name, shown in _shown(tmp, table)
        )


def _shown(tmp: Any, table: NDArray[np.float32]) -> Iterator[tuple[str, NDArray[np.float64]]]:
    """Yield names and what becomes of the colours (n, 3), linear as sRGB's curve is undone."""
    view = tmp.view_settings
    own = view.view_transform
    plain = (view.exposure, view.gamma, view.look) == (0.0, 1.0, "None")
    more = f" with exposure {view.exposure:+.3g}, gamma {view.gamma:.3g}, look '{view.look}'"
    yield f"'{own}'" + ("" if plain else more), _saved(tmp, table)
    view.look, view.exposure, view.gamma = "None", 0.0, 1.0
    for name in COMMON:
        try:
            view.view_transform = name
        except TypeError:  # this Blender does not have it
            continue
        if not (plain and name == own):
            yield f"'{name}'", _saved(tmp, table)


def _saved(tmp: Any, table: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return colours (n, 3) as Blender writes them to a PNG of 16 bits, sRGB's curve undone."""
    image = bpy.data.images.new("Reference Tracer Colours", len(table), 1, float_buffer=True)
    try:
        opaque = np.ones((len(table), 1), np.float32)
        image.pixels.foreach_set(np.hstack((table, opaque)).ravel())
        tmp.render.dither_intensity = 0.0
        images.set_format(tmp.render, "PNG", "RGB", "16")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "colours.png"
            image.save_render(str(path), scene=tmp)
            return curve_undone(images.read(path, "Non-Color")[0, :, :3].astype(np.float64))
    finally:
        bpy.data.images.remove(image)


def _looked_up(table: NDArray[np.float32], shown: NDArray[np.float64]) -> Any:
    """Return the transform that gives each colour of a table (n, 3) what is shown of it."""

    def transform(color: NDArray[np.float64]) -> NDArray[np.float64]:
        flat = color.reshape(-1, 3)
        found, index = np.unique(flat, axis=0, return_inverse=True)
        nearest = [int(np.abs(table - c).sum(axis=1).argmin()) for c in found]
        return shown[nearest][index.reshape(-1)].reshape(color.shape)

    return transform
