"""Faults of the lens: the part of the film that each pixel covers."""

from __future__ import annotations

from functools import partial
from itertools import product

from ...camera_files.frame import of_lens
from .fault import Example, Fault, Option, options, ways, with_option
from .film import SENSOR
from .lens_changes import (
    aspect,
    fits,
    lengths,
    of_lenses,
    orthographic,
    other_border,
    part,
    powers,
    spanned,
    square,
    times,
    whole_view,
)

_EXCHANGED = options(
    # The principal point is measured from the middle of a picture with its sides exchanged; or the
    # picture has its sides exchanged, and is stretched to the scene's.
    partial(
        of_lenses,
        lambda fx, fy, cx, cy, w, h: of_lens(fx, fy, cx - (w - h) / 2, cy + (w - h) / 2, w, h),
    ),
    partial(of_lenses, lambda fx, fy, cx, cy, w, h: of_lens(fx, fy, cx, cy, h, w)),
)
_DIVIDED = options(
    partial(of_lenses, lambda fx, fy, cx, cy, w, h: of_lens(fx / w, fy / h, cx / w, cy / h, w, h))
)

PARTS = (0.25, 0.5, 0.75, 2.0, 4.0)  # sizes for which a percentage of the resolution is tried

_FIT = options(*(partial(fits, power, shifted) for power in (1, -1) for shifted in (True, False)))
_LEFT_OUT = ways(
    ("", partial(times, 0, 0)), (" across", partial(times, 0, 1)), (" up", partial(times, 1, 0))
)
_SIGN = options(partial(times, -1, -1), partial(times, -1, 1), partial(times, 1, -1))
_UNIT = options(
    *(partial(powers, aspect, x, y) for x, y in product((-1, 0, 1), repeat=2) if x + y),
    partial(times, 0.5, 0.5),
    partial(times, 2, 2),
)
_LENGTH = options(
    *(
        partial(powers, length, power, power)
        for power in (-1, 1)
        for length in (
            lambda camera: SENSOR,
            lambda camera: max(lengths(camera)),
            lambda camera: min(lengths(camera)),
        )
    )
)
_SQUARE = options(
    *(partial(square, by_width, shifted) for shifted in (True, False) for by_width in (True, False))
)
_SPANNED = options(
    partial(spanned, True, True), partial(spanned, True, False), partial(spanned, False, True)
)
_PERCENTAGE = options(*(partial(part, scale, top) for scale in PARTS for top in (True, False)))
_SCALE = options(
    partial(orthographic, aspect),
    partial(orthographic, lambda camera: 1 / aspect(camera)),
    partial(orthographic, lambda camera: 0.5),
    partial(orthographic, lambda camera: 2.0),
)
_BORDER = options(whole_view, other_border)


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
