"""Features of cameras that some conventions cannot say: checked before a file is written."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..projections import ORTHOGRAPHIC
from ..scene import Camera
from ..tracer.camera import pixel_size

# Pixels: what a shift or a pixel's shape may move without being one. Far below what any picture
# shows, and far above the rounding of a window's edges in float64.
_NOTHING = 1e-6
# Of unit axes: how far they may be from right angles. Blender's are float32, and several roundings
# of 6e-8 apart.
ORTHOGONAL = 1e-5


class Feature(NamedTuple):
    """Something that a camera may have."""

    name: str  # as a message names it
    short: str  # as a table's head does
    is_of: Callable[[Camera], bool]


def _is_shifted(camera: Camera) -> bool:
    """Return whether the window's middle is off the axis; a parallel camera is moved instead."""
    off = np.divide(camera.window.centre, pixel_size(camera))
    return camera.projection is not ORTHOGRAPHIC and bool(np.abs(off).max() > _NOTHING)


def _has_oblong_pixels(camera: Camera) -> bool:
    width, height = pixel_size(camera)
    longer = max(camera.width, camera.height)
    return abs(height / width - 1) * longer > _NOTHING


def _is_sheared(camera: Camera) -> bool:
    axes = camera.world_from_camera[:3, :3]
    axes = axes / np.linalg.norm(axes, axis=0)
    return bool(np.abs(axes.T @ axes - np.eye(3)).max() > ORTHOGONAL)


SHIFT = Feature("a lens shift", "shift", _is_shifted)
ASPECT = Feature("a pixel aspect other than 1", "pixel aspect", _has_oblong_pixels)
PARALLEL = Feature(
    "an orthographic projection", "orthographic", lambda c: c.projection is ORTHOGRAPHIC
)
PANORAMA = Feature("a panoramic projection", "panorama", lambda c: not c.projection.is_linear)
MIRRORED = Feature(
    "mirrored axes", "mirrored", lambda c: np.linalg.det(c.world_from_camera[:3, :3]) < 0
)
SHEARED = Feature("axes that are not at right angles (a parent's scale)", "sheared", _is_sheared)

FEATURES = SHIFT, ASPECT, PARALLEL, PANORAMA, MIRRORED, SHEARED
