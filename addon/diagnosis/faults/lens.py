"""Faults of the lens: the part of the film that each pixel covers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from ...camera_files.frame import intrinsics
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Region, ViewWindow
from ...tracer.camera import pixel_size
from .fault import Example, Fault, Option, options, ways, with_option
from .film import SENSOR

Change = Callable[[Camera], Camera | None]


def _scaled(x: float, y: float, camera: Camera) -> Camera:
    """Scale the view window about the axis."""
    return replace(camera, window=camera.window.scaled(x, y))


def _about_centre(camera: Camera, x: float, y: float) -> Camera:
    """Scale the view window about its own centre."""
    return replace(camera, window=camera.window.about(camera.window.centre, x, y))


def _aspect(camera: Camera) -> float:
    """Return the aspect ratio of the view window, width / height."""
    width, height = camera.window.size
    return width / height


def _fits(power: float, shifted: bool) -> Change:
    """Return a function that fits the lens to the other side, with the shift scaled or kept."""

    def change(camera: Camera) -> Camera | None:
        factor = _aspect(camera) ** power
        if not camera.projection.is_linear or factor == 1:  # a panorama has no sensor to fit
            return None
        if shifted:
            return _scaled(factor, factor, camera)
        return _about_centre(camera, factor, factor) if any(camera.window.centre) else None

    return change


def _shifts(of: Callable[[Camera, float, float], tuple[float, float]]) -> Change:
    """Return a function that moves the centre of the view window; None if it stays."""

    def change(camera: Camera) -> Camera | None:
        own = camera.window.centre
        other = of(camera, *own)
        if np.allclose(own, other, rtol=1e-9, atol=0):
            return None
        return replace(camera, window=camera.window.about(other))

    return change


def _square(by_width: bool, shifted: bool) -> Change:
    """Return a function that makes pixels square, with their own width or height.

    The window's distance from the axis is in pixels, too, or is kept.
    """

    def change(camera: Camera) -> Camera | None:
        width, height = pixel_size(camera)
        if np.isclose(width, height, rtol=1e-6):
            return None
        x, y = (1, width / height) if by_width else (height / width, 1)
        return _scaled(x, y, camera) if shifted else _about_centre(camera, x, y)

    return change


def _spanned(across: bool, up: bool) -> Callable[[Camera], Camera | None]:
    """Return a function that spans the view from the first pixel's centre to the last one's."""

    def change(camera: Camera) -> Camera | None:
        w, h = camera.width, camera.height
        if not camera.projection.is_linear or min(w, h) < 2:
            return None
        x, y = (w / (w - 1) if across else 1, h / (h - 1) if up else 1)
        return _about_centre(camera, x, y)

    return change


def _in_length(factor: Callable[[Camera], float]) -> Change:
    """Return a function that multiplies both shifts, as with another unit of length."""
    return _shifts(lambda camera, x, y: (factor(camera) * x, factor(camera) * y))


def _lengths(camera: Camera) -> tuple[float, float]:
    """Return the width and the height of the picture in pixels' widths."""
    width, height = pixel_size(camera)
    return camera.width, camera.height * height / width


def _orthographic(factor: Callable[[Camera], float]) -> Change:
    def change(camera: Camera) -> Camera | None:
        if camera.projection is not ORTHOGRAPHIC or factor(camera) == 1:
            return None
        return _scaled(factor(camera), factor(camera), camera)

    return change


def _part(scale: float, top: bool) -> Callable[[Camera], Camera]:
    """Return a function that crops the view to `scale` of it, at the lower or upper left."""

    def change(camera: Camera) -> Camera:
        w = camera.window
        width, height = (scale * length for length in w.size)
        bottom = w.top - height if top else w.bottom
        return replace(camera, window=ViewWindow(w.left, w.left + width, bottom, bottom + height))

    return change


def _whole_view(camera: Camera) -> Camera | None:
    """Render the whole view into the border's region."""
    r = camera.region
    if (r.width, r.height) == (camera.width, camera.height):
        return None
    whole = Region(0, 0, r.width, r.height)
    return replace(camera, width=r.width, height=r.height, region=whole)


def _other_border(camera: Camera) -> Camera | None:
    """Count the rows of the border's region from the top."""
    r = camera.region
    rows = camera.height - r.y1, camera.height - r.y0
    if rows == (r.y0, r.y1):
        return None
    return replace(camera, region=Region(r.x0, rows[0], r.x1, rows[1]))


def _of_lens(fx: float, fy: float, cx: float, cy: float, width: float, height: float) -> ViewWindow:
    """Return the view window of K's numbers in a picture of a size, all in pixels."""
    return ViewWindow(-cx / fx, (width - cx) / fx, (cy - height) / fy, cy / fy)


def _of_lenses(of: Callable[..., ViewWindow]) -> Change:
    """Return a function that gives a camera another lens: `of` fx, fy, cx, cy, width, height."""

    def change(camera: Camera) -> Camera | None:
        if not camera.projection.is_linear:
            return None
        return replace(camera, window=of(*intrinsics(camera), camera.width, camera.height))

    return change


_EXCHANGED = options(
    # The principal point is measured from the middle of a picture with its sides exchanged; or the
    # picture has its sides exchanged, and is stretched to the scene's.
    _of_lenses(
        lambda fx, fy, cx, cy, w, h: _of_lens(fx, fy, cx - (w - h) / 2, cy + (w - h) / 2, w, h)
    ),
    _of_lenses(lambda fx, fy, cx, cy, w, h: _of_lens(fx, fy, cx, cy, h, w)),
)
_DIVIDED = options(
    _of_lenses(lambda fx, fy, cx, cy, w, h: _of_lens(fx / w, fy / h, cx / w, cy / h, w, h))
)

PARTS = (0.25, 0.5, 0.75, 2.0, 4.0)  # sizes for which a percentage of the resolution is tried

_FIT = options(*(_fits(power, shifted) for power in (1, -1) for shifted in (True, False)))
_LEFT_OUT = ways(
    ("", _shifts(lambda camera, x, y: (0.0, 0.0))),
    (" across", _shifts(lambda camera, x, y: (0.0, y))),
    (" up", _shifts(lambda camera, x, y: (x, 0.0))),
)
_SIGN = options(
    _shifts(lambda camera, x, y: (-x, -y)),
    _shifts(lambda camera, x, y: (-x, y)),
    _shifts(lambda camera, x, y: (x, -y)),
)
_UNIT = options(
    _shifts(lambda camera, x, y: (x, y / _aspect(camera))),
    _shifts(lambda camera, x, y: (x * _aspect(camera), y)),
    _shifts(lambda camera, x, y: (x / _aspect(camera), y)),
    _shifts(lambda camera, x, y: (x, y * _aspect(camera))),
    _shifts(lambda camera, x, y: (x / _aspect(camera), y / _aspect(camera))),
    _shifts(lambda camera, x, y: (x * _aspect(camera), y * _aspect(camera))),
    _shifts(lambda camera, x, y: (x / 2, y / 2)),
    _shifts(lambda camera, x, y: (2 * x, 2 * y)),
)
_LENGTH = options(
    *(
        _in_length(partial(factor, power=power))
        for power in (-1, 1)
        for factor in (
            lambda camera, power: SENSOR**power,
            lambda camera, power: max(_lengths(camera)) ** power,
            lambda camera, power: min(_lengths(camera)) ** power,
        )
    )
)
_SQUARE = options(
    *(_square(by_width, shifted) for shifted in (True, False) for by_width in (True, False))
)
_SPANNED = options(_spanned(True, True), _spanned(True, False), _spanned(False, True))
_PERCENTAGE = options(*(_part(scale, top) for scale in PARTS for top in (True, False)))
_SCALE = options(
    _orthographic(_aspect),
    _orthographic(lambda camera: 1 / _aspect(camera)),
    _orthographic(lambda camera: 0.5),
    _orthographic(lambda camera: 2.0),
)
_BORDER = options(_whole_view, _other_border)


LENS_FAULTS: tuple[Fault[Option], ...] = (
    Fault(
        "sensor_fit",
        "the lens is fitted to the other side of the picture (sensor fit)",
        "The exporter takes the sensor's width for the picture's width in every case, "
        "which is wrong for portraits.",
        "with sensor fit Auto, the sensor's width spans the longer side of the picture, pixel "
        "aspect included",
        *_FIT,
        examples=(
            Example("sensor_fit", "the lens fitted to the picture's other side", with_option(0)),
        ),
        witness="mitsuba-renderer/mitsuba-blender#25",
    ),
    Fault(
        "shift_left_out",
        "the camera's shift{words} is left out",
        "The renderer's camera has no shift, or the exporter doesn't write it.",
        "add shift X and Y",
        *_LEFT_OUT,
        words=" across, or up, alone",
        witness="prman-pixar/RenderManForBlender#16",
    ),
    Fault(
        "shift_sign",
        "the camera's shift has the wrong sign",
        "A principal point moves against the shift in x, and with it in y, since its y counts "
        "from the top.",
        "a positive shift X shows more of what is to the right, a positive shift Y more of the top",
        *_SIGN,
        witness="vvvv/VL.OpenCV#3",
    ),
    Fault(
        "shift_unit",
        "the camera's shift is in another unit",
        "Each shift is multiplied by its own side of the picture, which is right for square "
        "pictures only.",
        "both shifts are in lengths of the side that the sensor is fitted to",
        *_UNIT,
        witness="mitsuba-renderer/mitsuba-blender#32",
    ),
    Fault(
        "shift_length",
        f"the camera's shift is taken for millimetres (of a sensor {SENSOR:g} mm wide) or pixels, "
        "or these for a shift",
        "Other programs give the offset of the film in millimetres or inches, or as a principal"
        " point in pixels.",
        "a shift is in lengths of the side that the sensor is fitted to: divide millimetres by the "
        "sensor's width, pixels by the picture's",
        *_LENGTH,
        witness="xavier150/Blender-For-UnrealEngine-Addons#130",
    ),
    Fault(
        "last_pixel",
        "the picture is spanned from the first pixel's centre to the last one's: by width - 1 and "
        "height - 1",
        "`numpy.linspace(-1, 1, width)` puts the outer pixels' centres on the edge of the film.",
        "the edge of the view is the edge of the outer pixels: u = (i + 1/2) / width",
        *_SPANNED,
        examples=(
            Example("last_pixel", "width - 1 and height - 1 in place of both", with_option(0)),
        ),
        witness="mmatl/pyrender#54",
    ),
    Fault(
        "pixel_aspect_left_out",
        "the pixel aspect is left out: pixels are taken for squares",
        "The renderer has square pixels only, or the exporter heeds the resolution alone.",
        "a pixel is pixel aspect Y / X as high as it is wide",
        *_SQUARE,
        witness="ImageEngine/cortex#330",
    ),
    Fault(
        "resolution_percentage",
        "the camera is made for another resolution than the picture's (resolution percentage)",
        "In Blender `resolution_x` and `resolution_y` are the size before the percentage is "
        "applied.",
        "take the width and height times the resolution's percentage, also in the principal point",
        *_PERCENTAGE,
        witness="lunadigital/btoa#19",
    ),
    Fault(
        "sides_exchanged",
        "the picture's width and height are exchanged",
        "Shapes of arrays are (height, width), sizes of pictures (width, height).",
        "K's first row is of the width, its second of the height",
        *_EXCHANGED,
        witness="ApolloAuto/apollo#4211",
    ),
    Fault(
        "k_divided",
        "K is divided by the picture's width and height",
        "Kubric and neural renderers have K of a picture of 1 x 1, OpenCV in pixels.",
        "multiply K's first row by the width, its second by the height",
        *_DIVIDED,
        witness="donydchen/mvsplat#28",
    ),
    Fault(
        "ortho_scale",
        "the orthographic scale is taken for another length of the picture",
        "Blender's scale is the whole longer side; glTF's xmag and ymag are half of the width "
        "and half of the height.",
        "it is the whole width or height of the picture, whichever is longer (sensor fit Auto)",
        *_SCALE,
        witness="lunadigital/btoa#175",
    ),
    Fault(
        "border",
        "the render border is not the part of the picture that is shown",
        "Blender counts a border's rows from the lowest, image files from the topmost. "
        "Or the whole view is rendered at the border's size.",
        "a border's rows count from the lowest, and its pixels are those of the whole picture",
        *_BORDER,
        witness="GPUOpen-LibrariesAndSDKs/BlenderUSDHydraAddon#74",
    ),
)
