"""Changes of a camera by a mistaken lens, sensor, shift or resolution; None if there is none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...camera_files.frame import intrinsics
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Region, ViewWindow
from ...tracer.camera import pixel_size


def scaled(x: float, y: float, camera: Camera) -> Camera:
    """Scale the view window about the axis."""
    return replace(camera, window=camera.window.scaled(x, y))


def about_centre(camera: Camera, x: float, y: float) -> Camera:
    """Scale the view window about its own centre."""
    return replace(camera, window=camera.window.about(camera.window.centre, x, y))


def aspect(camera: Camera) -> float:
    """Return the aspect ratio of the view window, width / height."""
    width, height = camera.window.size
    return width / height


def fits(power: float, shifted: bool, camera: Camera) -> Camera | None:
    """Fit the lens to the other side, with the shift scaled or kept; a panorama has no sensor."""
    factor = aspect(camera) ** power
    if not camera.projection.is_linear:
        return None
    if shifted:
        return scaled(factor, factor, camera)
    return about_centre(camera, factor, factor) if any(camera.window.centre) else None


def powers(length: Callable[[Camera], float], x: float, y: float, camera: Camera) -> Camera:
    """Multiply the shifts by powers of a length."""
    return times(length(camera) ** x, length(camera) ** y, camera)


def times(x: float, y: float, camera: Camera) -> Camera:
    """Multiply the shifts, across and up."""
    across, up = camera.window.centre
    return replace(camera, window=camera.window.about((x * across, y * up)))


def square(by_width: bool, shifted: bool, camera: Camera) -> Camera | None:
    """Make pixels square, with their own width or height.

    The window's distance from the axis is in pixels, too, or is kept.
    """
    width, height = pixel_size(camera)
    if np.isclose(width, height, rtol=1e-6):
        return None
    x, y = (1, width / height) if by_width else (height / width, 1)
    return scaled(x, y, camera) if shifted else about_centre(camera, x, y)


def spanned(across: bool, up: bool, camera: Camera) -> Camera | None:
    """Span the view from the first pixel's centre to the last one's."""
    w, h = camera.width, camera.height
    if not camera.projection.is_linear or min(w, h) < 2:
        return None
    return about_centre(camera, w / (w - 1) if across else 1, h / (h - 1) if up else 1)


def lengths(camera: Camera) -> tuple[float, float]:
    """Return the width and the height of the picture in pixels' widths."""
    width, height = pixel_size(camera)
    return camera.width, camera.height * height / width


def orthographic(factor: Callable[[Camera], float], camera: Camera) -> Camera | None:
    """Scale the view of an orthographic camera by a factor of it."""
    if camera.projection is not ORTHOGRAPHIC:
        return None
    return scaled(factor(camera), factor(camera), camera)


def part(scale: float, top: bool, camera: Camera) -> Camera:
    """Crop the view to `scale` of it, at the lower or upper left."""
    w = camera.window
    width, height = (scale * length for length in w.size)
    bottom = w.top - height if top else w.bottom
    return replace(camera, window=ViewWindow(w.left, w.left + width, bottom, bottom + height))


def whole_view(camera: Camera) -> Camera:
    """Render the whole view into the border's region."""
    r = camera.region
    whole = Region(0, 0, r.width, r.height)
    return replace(camera, width=r.width, height=r.height, region=whole)


def other_border(camera: Camera) -> Camera:
    """Count the rows of the border's region from the top."""
    r = camera.region
    return replace(camera, region=Region(r.x0, camera.height - r.y1, r.x1, camera.height - r.y0))


def of_lenses(of: Callable[..., ViewWindow], camera: Camera) -> Camera | None:
    """Give a camera another lens: `of` fx, fy, cx, cy, width, height."""
    if not camera.projection.is_linear:
        return None
    return replace(camera, window=of(*intrinsics(camera), camera.width, camera.height))
