"""Bounds the two roundings before the proof.

Rays and corners are rounded before they are stored, and the proof is about what is stored.
Unrounded, the camera's own rays, x right + y up + forward for a pixel's centre, and
world_from_object . vertex are fractions, which may be other numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..tracer.camera import dual_axes, pixel_size
from ..tracer.world import reaches

if TYPE_CHECKING:
    from ..scene import Scene

# The roundings on the longest path, and one for the bound itself. A ray has four for x, a product
# and two sums.
_RAY = 8 * 2.0**-53
_CORNER = 5 * 2.0**-53  # a product and three sums
_SLACK = 2.0**-1060  # far above what gradual underflow may lose


class Rounding(NamedTuple):
    """Bounds for a whole picture; lengths are sums over x, y and z."""

    ray: float  # of the error of a direction; for parallel rays, of an origin, in metres
    corner: float  # of the error of a corner, in metres
    pixels: float  # how far from its pixel's centre a ray passes

    def __str__(self) -> str:
        moved = f"rays by at most {self.pixels:.1g} px, corners by at most {self.corner:.1g} m"
        return f"before any test, rounding moves {moved}"


@np.errstate(over="ignore", invalid="ignore")  # what overflows has no bound
def rounding(scene: Scene) -> Rounding:
    """Bound how far rounding moves the rays and corners of a scene."""
    camera = scene.camera
    w = camera.window
    x = abs(w.left) + abs(w.right)
    y = abs(w.bottom) + abs(w.top)
    frame = np.stack((camera.right, camera.up, camera.forward, camera.origin))
    ray = _RAY * camera.projection.terms(x, y, frame) + _SLACK
    aside = np.max((np.abs(dual_axes(camera)) * ray).sum(axis=1))
    pixels = aside * camera.projection.slant(max(x, y)) / min(pixel_size(camera))
    corner = np.max((_CORNER * reaches(scene) + _SLACK).sum(axis=0), initial=0.0)
    return Rounding(float(ray.sum()), float(corner), float(pixels))
