"""What a pixel shows of the surface that its ray meets: a record each, and its function.

All but the object's own colour show the shape: they are constant shading by what the tracer finds,
without a light. Their functions take the scene, n rays, their hits, and the depths of the nearest
and the farthest hit of the picture; they return what a screen shows, (n, 3) or (n, 1) from 0 to 1.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from ..images import curve_undone
from ..scene import Scene
from .camera import Rays
from .hits import NOTHING, Hits
from .shading import colors, near_1, normals
from .vector import dot

BACK = 1.0, 0.4, 0.4  # of the grey of a back: reddish, as in Blender's overlay Face Orientation
FARTHEST = 0.1  # grey of the farthest hit, so that it is no hole

Depths = tuple[float, float]
Shade = Callable[[Scene, Rays, Hits, Depths], NDArray[np.float64]]


def normal(scene: Scene, rays: Rays, hits: Hits, depths: Depths) -> NDArray[np.float64]:
    """Return (n + 1) / 2 of the geometric unit normals in world space, as normal maps have it."""
    return (normals(scene, hits) + 1) / 2


def facing(scene: Scene, rays: Rays, hits: Hits, depths: Depths) -> NDArray[np.float64]:
    """Return |cos| of the angle between ray and normal, grey on a front, reddish on a back."""
    d = near_1(rays.directions)
    cosine = dot(normals(scene, hits).T, d / np.sqrt(dot(d, d)))[:, None]
    return np.abs(cosine) * np.where(cosine > 0, BACK, 1.0)


def depth(scene: Scene, rays: Rays, hits: Hits, depths: Depths) -> NDArray[np.float64]:
    """Return a grey that falls evenly with the depth, from 1 at the nearest to `FARTHEST`."""
    t, near, far = (np.multiply(v, 0.25) for v in (hits.t, *depths))  # no difference overflows
    share = (np.clip(t, near, far) - near) / max(far - near, np.finfo(float).tiny)
    return 1 - (1 - FARTHEST) * share[:, None]


_SHADES: dict[str, Shade] = {shade.__name__: shade for shade in (normal, facing, depth)}


class Color(StrEnum):
    """What a pixel shows of a surface, by its name in options and files."""

    OBJECT = "object"  # its own colour, which every comparison is about
    NORMAL = "normal"
    FACING = "facing"
    DEPTH = "depth"

    def of(self, scene: Scene, depths: Depths, rays: Callable, hits: Hits) -> NDArray[np.float32]:
        """Return what each ray shows, (n, 4) linear RGBA; the background is the scene's."""
        out = colors(scene, hits)
        if shade := _SHADES.get(self):
            hit = np.flatnonzero(hits.instance != NOTHING)
            shown = shade(scene, rays().take(hit), hits.take(hit), depths)
            out[hit, :3] = curve_undone(shown)
        return out
