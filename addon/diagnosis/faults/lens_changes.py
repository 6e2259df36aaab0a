"""Changes of a camera by a mistaken lens, sensor, shift or resolution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...camera_files.frame import intrinsics
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Region, ViewWindow
from ...tracer.camera import pixel_size

Change = Callable[[Camera], Camera | None]


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


def fits(power: float, shifted: bool) -> Change:
    """Return a function that fits the lens to the other side, with the shift scaled or kept."""

    def change(camera: Camera) -> Camera | None:
        factor = aspect(camera) ** power
        if not camera.projection.is_linear or factor == 1:  # a panorama has no sensor to fit
            return None
        if shifted:
            return scaled(factor, factor, camera)
        return about_centre(camera, factor, factor) if any(camera.window.centre) else None

    return change


def powers(length: Callable[[Camera], float], x: float, y: float) -> Change:
    """Return a function that multiplies the shifts by powers of a length; None if they stay."""

    def change(camera: Camera) -> Camera | None:
        return times(length(camera) ** x, length(camera) ** y)(camera)

    return change


def times(x: float, y: float) -> Change:
    """Return a function that multiplies the shifts, across and up; None if they stay."""

    def change(camera: Camera) -> Camera | None:
        own = camera.window.centre
        other = x * own[0], y * own[1]
        if np.allclose(own, other, rtol=1e-9, atol=0):
            return None
        return replace(camera, window=camera.window.about(other))

    return change


def square(by_width: bool, shifted: bool) -> Change:
    """Return a function that makes pixels square, with their own width or height.

    The window's distance from the axis is in pixels, too, or is kept.
    """

    def change(camera: Camera) -> Camera | None:
        width, height = pixel_size(camera)
        if np.isclose(width, height, rtol=1e-6):
            return None
        x, y = (1, width / height) if by_width else (height / width, 1)
        return scaled(x, y, camera) if shifted else about_centre(camera, x, y)

    return change


def spanned(across: bool, up: bool) -> Callable[[Camera], Camera | None]:
    """Return a function that spans the view from the first pixel's centre to the last one's."""

    def change(camera: Camera) -> Camera | None:
        w, h = camera.width, camera.height
        if not camera.projection.is_linear or min(w, h) < 2:
            return None
        x, y = (w / (w - 1) if across else 1, h / (h - 1) if up else 1)
        return about_centre(camera, x, y)

    return change


def lengths(camera: Camera) -> tuple[float, float]:
    """Return the width and the height of the picture in pixels' widths."""
    width, height = pixel_size(camera)
    return camera.width, camera.height * height / width


def orthographic(factor: Callable[[Camera], float]) -> Change:
    """Return a function that scales the view of an orthographic camera by a factor of it."""

    def change(camera: Camera) -> Camera | None:
        if camera.projection is not ORTHOGRAPHIC or factor(camera) == 1:
            return None
        return scaled(factor(camera), factor(camera), camera)

    return change


def part(scale: float, top: bool) -> Callable[[Camera], Camera]:
    """Return a function that crops the view to `scale` of it, at the lower or upper left."""

    def change(camera: Camera) -> Camera:
        w = camera.window
        width, height = (scale * length for length in w.size)
        bottom = w.top - height if top else w.bottom
        return replace(camera, window=ViewWindow(w.left, w.left + width, bottom, bottom + height))

    return change


def whole_view(camera: Camera) -> Camera | None:
    """Render the whole view into the border's region."""
    r = camera.region
    if (r.width, r.height) == (camera.width, camera.height):
        return None
    whole = Region(0, 0, r.width, r.height)
    return replace(camera, width=r.width, height=r.height, region=whole)


def other_border(camera: Camera) -> Camera | None:
    """Count the rows of the border's region from the top."""
    r = camera.region
    rows = camera.height - r.y1, camera.height - r.y0
    if rows == (r.y0, r.y1):
        return None
    return replace(camera, region=Region(r.x0, rows[0], r.x1, rows[1]))


def of_lens(fx: float, fy: float, cx: float, cy: float, width: float, height: float) -> ViewWindow:
    """Return the view window of K's numbers in a picture of a size, all in pixels."""
    return ViewWindow(-cx / fx, (width - cx) / fx, (cy - height) / fy, cy / fy)


def of_lenses(of: Callable[..., ViewWindow]) -> Change:
    """Return a function that gives a camera another lens: `of` fx, fy, cx, cy, width, height."""

    def change(camera: Camera) -> Camera | None:
        if not camera.projection.is_linear:
            return None
        return replace(camera, window=of(*intrinsics(camera), camera.width, camera.height))

    return change
