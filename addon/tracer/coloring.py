"""The colourings of a picture: what a pixel shows of the surface that its ray hits.

All but the object's own colour show the shape, without a light. Their functions take the scene, n
rays, their hits, and the depths of the nearest and the farthest hit of the picture. They return
colours as a screen shows them, (n, 3) or (n, 1) from 0 to 1.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from ..arrays import Colors
from ..files.images import curve_undone
from ..scene import Scene
from .camera import Rays
from .hits import NOTHING, Hits
from .shading import colors, near_1, normals
from .vector import dot

BACK = 1.0, 0.4, 0.4  # factors of a back's grey: reddish, as in Blender's Face Orientation overlay
FARTHEST = 0.1  # grey of the farthest hit, so that it does not look like a hole

Depths = tuple[float, float]
Shade = Callable[[Scene, Rays, Hits, Depths], NDArray[np.float64]]


def normal(scene: Scene, rays: Rays, hits: Hits, depths: Depths) -> NDArray[np.float64]:
    """Return (n + 1) / 2 for the geometric unit normals n in world space, as normal maps do."""
    return (normals(scene, hits) + 1) / 2


def facing(scene: Scene, rays: Rays, hits: Hits, depths: Depths) -> NDArray[np.float64]:
    """Return |cos| of the angle between ray and normal: grey for fronts, reddish for backs."""
    d = near_1(rays.directions)
    cosine = dot(normals(scene, hits).T, d / np.sqrt(dot(d, d)))[:, None]
    return np.abs(cosine) * np.where(cosine > 0, BACK, 1.0)


def depth(scene: Scene, rays: Rays, hits: Hits, depths: Depths) -> NDArray[np.float64]:
    """Return a grey that is linear in the depth: 1 for the nearest hit, `FARTHEST` for the last."""
    t, near, far = (np.multiply(v, 0.25) for v in (hits.t, *depths))  # no difference overflows
    share = (np.clip(t, near, far) - near) / max(far - near, np.finfo(float).tiny)
    return 1 - (1 - FARTHEST) * share[:, None]


_SHADES: dict[str, Shade] = {shade.__name__: shade for shade in (normal, facing, depth)}


class Color(StrEnum):
    """A colouring, by its name in options and files."""

    OBJECT = "object"  # the surface's own colour, which comparisons compare
    NORMAL = "normal"
    FACING = "facing"
    DEPTH = "depth"

    def of(self, scene: Scene, depths: Depths, rays: Callable[[], Rays], hits: Hits) -> Colors:
        """Return the colours of n rays, (n, 4) linear RGBA; the background is the scene's."""
        out = colors(scene, hits)
        if shade := _SHADES.get(self):
            hit = np.flatnonzero(hits.instance != NOTHING)
            shown = shade(scene, rays().take(hit), hits.take(hit), depths)
            out[hit, :3] = curve_undone(shown)
        return out
