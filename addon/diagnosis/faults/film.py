"""Families of cameras in the same place: an offset on the film, focal lengths."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...projections import ORTHOGRAPHIC
from ...scene import Camera
from ...tracer.camera import pixel_size
from ..evidence import Evidence
from .fault import Values
from .fitting import Family

SENSOR = 36.0  # millimetres: the width that Blender's cameras have unless it is changed
STEP = 4.0  # pixels that the picture's corners move from one start to the next


def offset(camera: Camera, dx: float, dy: float) -> Camera:
    """Return the camera with its rays offset on the film by (dx, dy) pixels."""
    width, height = pixel_size(camera)
    return replace(camera, window=camera.window.moved(dx * width, dy * height))


def _zoomed(camera: Camera, percent: float) -> Camera | None:
    """Return the camera with another focal length, or orthographic scale; panoramas have none."""
    return _stretched(camera, percent, percent)


def _stretched(camera: Camera, x: float, y: float) -> Camera | None:
    """Return the camera with its focal lengths across and up changed by percent."""
    across, up = 1 + x / 100, 1 + y / 100
    if not camera.projection.is_linear or min(across, up) <= 0:
        return None
    return replace(camera, window=camera.window.scaled(1 / across, 1 / up))


def _cropped(camera: Camera, percent: float, dx: float, dy: float) -> Camera | None:
    """Return the camera with another focal length, offset by (dx, dy) pixels besides."""
    zoomed = _zoomed(camera, percent)
    return zoomed and offset(zoomed, dx, dy)


def radius(evidence: Evidence) -> float:
    """Return the distance from the picture's centre to its corners, in pixels."""
    region = evidence.case.scene.camera.region
    return float(np.hypot(region.width, region.height)) / 2


def _zooms(evidence: Evidence) -> Iterator[Values]:
    for factor in np.exp(np.arange(-np.log(4), np.log(4), STEP / radius(evidence))):
        yield (100 * float(factor) - 100,)


def _beside(camera: Camera, dx: float, dy: float) -> str:
    """Say where the rays pass; of an orthographic camera, also where it would stand."""
    words = "the camera's rays pass beside the pixels' centres"
    if abs(dx) == abs(dy) == 0.5:
        words = "the camera's rays pass the pixels' corners, not their centres"
    if camera.projection is ORTHOGRAPHIC:
        right, up = np.multiply(pixel_size(camera), (dx, dy))
        words += (
            f", or it is moved by {right:+.4g} m to its right and {up:+.4g} m upwards, which looks "
            "the same"
        )
    return words


def _focal(camera: Camera, percent: float) -> str:
    """Say what the focal length is, for a sensor of Blender's own width; or an orthographic scale.

    An orthographic camera has no focal length.
    """
    shows = f"the picture shows {'less' if percent > 0 else 'more'} than it should"
    if camera.projection is ORTHOGRAPHIC:
        right = max(camera.window.size)
        other = right / (1 + percent / 100)
        return (
            f"everything is {percent:+.4g} % off in size: the orthographic scale is {other:.4g} m, "
            f"not {right:.4g}; {shows}"
        )
    own = SENSOR / camera.window.size[0]
    millimetres = (
        f"{own * (1 + percent / 100):.4g} mm, not {own:.4g}, of a sensor {SENSOR:g} mm wide"
    )
    return f"the focal length is {percent:+.4g} % off: {millimetres}; {shows}"


OFFSET = Family(offset, lambda evidence: np.eye(2), _beside)
FOCAL = Family(_zoomed, lambda evidence: 100 * np.eye(1) / radius(evidence), _focal, _zooms)
FOCALS = Family(_stretched, lambda evidence: 100 * np.eye(2) / radius(evidence))
CROPPED = Family(_cropped, lambda evidence: np.diag((100 / radius(evidence), 1.0, 1.0)))
