"""Not modelled: something is drawn there that the tracer does not model, as the manifest says."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...scene import Camera
from ...tracer.camera import film_of
from ...tracer.progress import Work
from ..cause import Cause
from .open_pixels import OpenPixels


def in_its_place(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that the box of a feature may cover."""
    for number, feature in enumerate(pixels.case.manifest.unmodelled):
        if feature.bounds is not None and not feature.everywhere and pixels.open.any():
            inside = pixels.open & covered(pixels.case.scene.camera, feature.bounds)
            pixels.settle(inside, Cause.NOT_MODELLED, float(number))
            yield 0.0


def everywhere(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels that a feature may change wherever they are."""
    for number, feature in enumerate(pixels.case.manifest.unmodelled):
        if feature.everywhere:
            allowed = pixels.open
            if feature.recolours:  # light does not put another object there
                allowed = allowed & ~pixels.picture.other_object(pixels.frame.instance_index)
            pixels.settle(allowed, Cause.NOT_MODELLED, float(number))
            yield 0.0


def covered(camera: Camera, bounds: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which pixels of the camera's region a world-space box (2, 3) may cover, (h, w)."""
    r = camera.region
    corners = np.array(np.meshgrid(*bounds.T)).reshape(3, 8)
    px, py, depth = film_of(camera, corners)
    out = np.zeros((r.height, r.width), bool)
    if depth.max() < camera.clip_start or depth.min() > camera.clip_end:
        return out
    if not camera.projection.is_parallel and depth.min() <= camera.clip_start:
        return ~out  # around the eye: anywhere
    x0, x1 = int(max(np.floor(px.min()) - r.x0, 0)), int(np.ceil(min(px.max(), r.x1)) - r.x0)
    y0, y1 = int(max(np.floor(py.min()) - r.y0, 0)), int(np.ceil(min(py.max(), r.y1)) - r.y0)
    out[y0 : max(y1, 0), x0 : max(x1, 0)] = True
    return out
