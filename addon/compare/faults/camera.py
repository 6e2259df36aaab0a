"""Faults of the camera: where it stands, how it is turned, and what of the film each pixel sees."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Region, ViewWindow
from ...tracer.camera import pixel_size
from .fault import Example, Fault, of_camera, options, with_values
from .film import FOCAL, OFFSET, ROLL, fitting

Change = Callable[[Camera], Camera | None]

# World space with Y up, as many formats have it, from Blender's with Z up.
_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


def window(camera: Camera, x: float, y: float, centre: tuple[float, float]) -> Camera:
    """Return the camera with its view window scaled by (x, y), and moved to a centre."""
    w = camera.window
    half_x, half_y = x * (w.right - w.left) / 2, y * (w.top - w.bottom) / 2
    cx, cy = centre
    made = ViewWindow(cx - half_x, cx + half_x, cy - half_y, cy + half_y)
    return replace(camera, window=made)


def centre(camera: Camera) -> tuple[float, float]:
    """Return the centre of the view window."""
    w = camera.window
    return (w.left + w.right) / 2, (w.bottom + w.top) / 2


def _scaled(x: float, y: float, camera: Camera) -> Camera:
    """Scale the view window, and its distance from the axis, too."""
    cx, cy = centre(camera)
    return window(camera, x, y, (x * cx, y * cy))


def _aspect(camera: Camera) -> float:
    """Return the width of the view window in heights."""
    w = camera.window
    return (w.right - w.left) / (w.top - w.bottom)


def _fits(power: float, shifted: bool) -> Change:
    """Return what fits the lens to the other side of the picture; the shift goes with it or not."""

    def change(camera: Camera) -> Camera | None:
        factor = _aspect(camera) ** power
        if not camera.projection.is_linear or factor == 1:  # a panorama has no sensor to fit
            return None
        return _scaled(factor, factor, camera) if shifted else _about_centre(camera, factor)

    return change


def _about_centre(camera: Camera, factor: float) -> Camera | None:
    """Scale the view window about its own centre; None if that is the axis."""
    own = centre(camera)
    return window(camera, factor, factor, own) if any(own) else None


def _shifts(of: Callable[[Camera, float, float], tuple[float, float]]) -> Change:
    """Return what gives the view window another centre; None where it has none to get wrong."""

    def change(camera: Camera) -> Camera | None:
        own = centre(camera)
        other = of(camera, *own)
        return None if np.allclose(own, other, rtol=1e-9, atol=0) else window(camera, 1, 1, other)

    return change


def _square(by_width: bool) -> Change:
    """Return what takes pixels for squares, as wide or as high as they are."""

    def change(camera: Camera) -> Camera | None:
        width, height = pixel_size(camera)
        if np.isclose(width, height, rtol=1e-6):
            return None
        return (
            _scaled(1, width / height, camera) if by_width else _scaled(height / width, 1, camera)
        )

    return change


def _axes(change: Callable[[Array], Array], at_origin: bool = False) -> Callable[[Camera], Camera]:
    """Return what changes the axes of the camera, the columns of a (3, 3) matrix."""

    def changed(camera: Camera) -> Camera:
        matrix = camera.world_from_camera.copy()
        matrix[:3, :3] = change(matrix[:3, :3])
        if at_origin:
            matrix[:3, 3] = 0
        return replace(camera, world_from_camera=matrix)

    return changed


def _matrix(change: Callable[[Array], Array]) -> Callable[[Camera], Camera]:
    """Return what changes the whole matrix of the camera, (4, 4)."""
    return lambda camera: replace(camera, world_from_camera=change(camera.world_from_camera))


def _turned_world(rotation: Array, position: bool) -> Callable[[Camera], Camera]:
    """Return what turns the camera as if the world had other axes; its position, too, or not."""

    def change(matrix: Array) -> Array:
        turned = rotation @ matrix
        if not position:
            turned[:3, 3] = matrix[:3, 3]
        return turned

    return _matrix(change)


def flipped(camera: Camera, axis: int) -> Camera:
    """Return the camera that sees the picture mirrored along an axis, 0 or 1."""
    w = camera.window
    signs = np.ones(3)
    signs[axis] = -1
    sides = (
        (-w.right, -w.left, w.bottom, w.top) if axis == 0 else (w.left, w.right, -w.top, -w.bottom)
    )
    turned = _axes(lambda axes: axes * signs)(camera)
    return replace(turned, window=ViewWindow(*sides))


def _orthographic(factor: Callable[[Camera], float]) -> Change:
    def change(camera: Camera) -> Camera | None:
        if camera.projection is not ORTHOGRAPHIC or factor(camera) == 1:
            return None
        return _scaled(factor(camera), factor(camera), camera)

    return change


def _part(scale: float, top: bool) -> Callable[[Camera], Camera]:
    """Return what sees the lower left of the picture, or the upper left, `scale` of its size."""

    def change(camera: Camera) -> Camera:
        w = camera.window
        half_x, half_y = scale * (w.right - w.left) / 2, scale * (w.top - w.bottom) / 2
        y = w.top - half_y if top else w.bottom + half_y
        return window(camera, scale, scale, (w.left + half_x, y))

    return change


def _whole_view(camera: Camera) -> Camera | None:
    """See the whole view in the pixels of the border's region."""
    r = camera.region
    if (r.width, r.height) == (camera.width, camera.height):
        return None
    whole = Region(0, 0, r.width, r.height)
    return replace(camera, width=r.width, height=r.height, region=whole)


def _other_border(camera: Camera) -> Camera | None:
    """See the border's region counted from the other side: its rows from the top."""
    r = camera.region
    rows = camera.height - r.y1, camera.height - r.y0
    if rows == (r.y0, r.y1):
        return None
    return replace(camera, region=Region(r.x0, rows[0], r.x1, rows[1]))


_OFFSET, _FOCAL, _ROLL = (fitting(family) for family in (OFFSET, FOCAL, ROLL))
PARTS = (0.25, 0.5, 0.75, 2.0, 4.0)  # sizes for which a percentage of the resolution is tried

_FIT = options(*(_fits(power, shifted) for power in (1, -1) for shifted in (True, False)))
_LEFT_OUT = options(_shifts(lambda camera, x, y: (0.0, 0.0)))
_SIGN = options(
    _shifts(lambda camera, x, y: (-x, -y)),
    _shifts(lambda camera, x, y: (-x, y)),
    _shifts(lambda camera, x, y: (x, -y)),
)
_UNIT = options(
    _shifts(lambda camera, x, y: (x, y / _aspect(camera))),
    _shifts(lambda camera, x, y: (x * _aspect(camera), y)),
    _shifts(lambda camera, x, y: (x / _aspect(camera), y / _aspect(camera))),
    _shifts(lambda camera, x, y: (x * _aspect(camera), y * _aspect(camera))),
    _shifts(lambda camera, x, y: (x / 2, y / 2)),
    _shifts(lambda camera, x, y: (2 * x, 2 * y)),
)
_SQUARE = options(_square(True), _square(False))
_PERCENTAGE = options(*(_part(scale, top) for scale in PARTS for top in (True, False)))
_MIRRORED_X = options(_axes(lambda axes: axes * (-1, 1, 1)), lambda camera: flipped(camera, 0))
_MIRRORED_Y = options(_axes(lambda axes: axes * (1, -1, 1)))
_TRANSPOSED = options(_axes(np.transpose), _axes(np.transpose, at_origin=True))
_INVERTED = options(_matrix(np.linalg.inv))
_TURNED = options(
    *(_turned_world(r, position) for r in (_Y_UP, _Y_UP.T) for position in (True, False))
)
_BACKWARDS = options(
    _axes(lambda axes: axes * (1, 1, -1)),
    _axes(lambda axes: axes * (-1, 1, -1)),
    _axes(lambda axes: axes * (1, -1, -1)),
)
_SCALE = options(
    _orthographic(_aspect),
    _orthographic(lambda camera: 1 / _aspect(camera)),
    _orthographic(lambda camera: 0.5),
    _orthographic(lambda camera: 2.0),
)
_BORDER = options(_whole_view, _other_border)

CAMERA_FAULTS = (
    Fault(
        "pixel_offset",
        "{words}: ({dx:+.3f}, {dy:+.3f}) px",
        "move the film position of every ray by that: pixel (i, j) has its centre at "
        "(i + 1/2, j + 1/2), and the principal point is at half of the width and the height",
        of_camera(OFFSET.camera),
        _OFFSET[0],
        ("dx", "dy"),
        refine=_OFFSET[1],
        effort=1,
        examples=(
            Example("half_pixel", "rays through the pixels' corners", with_values(0.5, 0.5)),
            Example("one_pixel", "the camera off by a pixel to the right", with_values(1.0, 0.0)),
        ),
    ),
    Fault(
        "mirrored_x",
        "the picture is mirrored left to right",
        "check the sign of the camera's right axis, or of x on the film",
        *_MIRRORED_X,
        examples=(Example("mirrored_x", "the camera mirrored left to right", with_values(0)),),
    ),
    Fault(
        "mirrored_y",
        "the camera is mirrored upside down",
        "check the sign of the camera's up axis, or of y on the film",
        *_MIRRORED_Y,
        examples=(Example("mirrored_y", "the camera mirrored upside down", with_values(0)),),
    ),
    Fault(
        "sensor_fit",
        "the lens is fitted to the other side of the picture (sensor fit)",
        "with sensor fit Auto, the sensor's width spans the longer side of the picture, pixel "
        "aspect included",
        *_FIT,
        examples=(
            Example("sensor_fit", "the lens fitted to the picture's other side", with_values(0)),
        ),
    ),
    Fault(
        "matrix_transposed",
        "the camera's rotation is transposed",
        "the axes right, up and backward are the columns of world_from_camera",
        *_TRANSPOSED,
        examples=(Example("camera_transposed", "the camera's rotation inverted", with_values(0)),),
    ),
    Fault(
        "matrix_inverted",
        "the camera's matrix is inverted: world from camera is taken for camera from world",
        "invert the view matrix once, not twice or never",
        *_INVERTED,
    ),
    Fault(
        "focal_length",
        "the focal length is {percent:+.4g} % off: {words}",
        "check the lens' unit, the sensor's width, and whether an angle is the whole one or half, "
        "of the width or of the height",
        of_camera(FOCAL.camera),
        _FOCAL[0],
        ("percent",),
        refine=_FOCAL[1],
        effort=1,
    ),
    Fault(
        "roll",
        "the camera is rolled by {degrees:+.3f} degrees about its axis",
        "turn it back; a positive angle turns the picture's content clockwise",
        of_camera(ROLL.camera),
        _ROLL[0],
        ("degrees",),
        refine=_ROLL[1],
        effort=1,
    ),
    Fault("shift_left_out", "the camera's shift is left out", "add shift X and Y", *_LEFT_OUT),
    Fault(
        "shift_sign",
        "the camera's shift has the wrong sign",
        "a positive shift X shows more of what is to the right, a positive shift Y more of the top",
        *_SIGN,
    ),
    Fault(
        "shift_unit",
        "the camera's shift is in another unit",
        "both shifts are in lengths of the side that the sensor is fitted to",
        *_UNIT,
    ),
    Fault(
        "pixel_aspect_left_out",
        "the pixel aspect is left out: pixels are taken for squares",
        "a pixel is pixel aspect Y / X as high as it is wide",
        *_SQUARE,
    ),
    Fault(
        "resolution_percentage",
        "the camera is made for another resolution than the picture's (resolution percentage)",
        "take the width and height times the resolution's percentage, also in the principal point",
        *_PERCENTAGE,
    ),
    Fault(
        "y_up",
        "the camera is placed in a world with Y up, the meshes in one with Z up (or reversed)",
        "convert both, or none",
        *_TURNED,
    ),
    Fault(
        "forward",
        "the camera looks along +Z in place of -Z",
        "Blender's cameras look along their own -Z, with +Y up",
        *_BACKWARDS,
    ),
    Fault(
        "ortho_scale",
        "the orthographic scale is taken for another length of the picture",
        "it is the whole width or height of the picture, whichever is longer (sensor fit Auto)",
        *_SCALE,
    ),
    Fault(
        "border",
        "the render border is not the part of the picture that is shown",
        "a border's rows count from the lowest, and its pixels are those of the whole picture",
        *_BORDER,
    ),
)
