"""Students' mistakes with a camera that are more than one sign, letter or term."""

from __future__ import annotations

from ..programs import Slip

_TAN = "(sin {0} / cos {0})"
SLIPS = (
    Slip(
        "half_pixel_missing",
        "the ray goes through a pixel's corner: its centre is at column + ½, row + ½",
        {
            "across": "column − ½ columns + shift_x longer",
            "upward": "row − ½ rows + shift_y longer",
        },
    ),
    Slip(
        "middle_off_by_a_half",
        "the picture's middle is taken to be at (columns − 1) / 2: where centres are at column + ½ "
        "it is at columns / 2",
        {
            "across": "column + ½ − ½ (columns − 1) + shift_x longer",
            "upward": "row + ½ − ½ (rows − 1) + shift_y longer",
        },
    ),
    Slip(
        "rows_from_the_top",
        "rows are counted from the top: row 0 is the lowest",
        {"upward": "½ rows − row − ½ + shift_y longer"},
    ),
    Slip(
        "mirrored",
        "columns are counted from the right: column 0 is the first on the left",
        {"across": "½ columns − column − ½ + shift_x longer"},
    ),
    Slip(
        "columns_and_rows_exchanged",
        "column and row are exchanged: a pixel is (column, row)",
        {
            "across": "row + ½ − ½ columns + shift_x longer",
            "upward": "column + ½ − ½ rows + shift_y longer",
        },
    ),
    Slip(
        "looks_backward",
        "the ray goes along +z of the camera: it looks along −z",
        {"d": "perspective (u right + v up) + back"},
    ),
    Slip(
        "position_added_to_direction",
        "the direction is moved by the camera's position: a direction has no place (w = 0)",
        {"d": "perspective (u right + v up) − back + e"},
    ),
    Slip(
        "position_ignored",
        "the camera's position is ignored: every ray begins at the world's origin",
        {"o": "orthographic (u right + v up)"},
    ),
    Slip(
        "matrix_transposed",
        "the matrix is transposed: the camera's axes are its columns, not its rows",
        {
            "d": "perspective (u row_x + v row_y) − row_z",
            "o": "e + orthographic (u row_x + v row_y)",
        },
    ),
    Slip(
        "matrix_ignored",
        "the camera's axes are ignored: a ray is in the camera's own space until it is turned",
        {
            "d": "perspective (u axis_x + v axis_y) − axis_z",
            "o": "e + orthographic (u axis_x + v axis_y)",
        },
    ),
    Slip(
        "shift_reversed",
        "the shifts have the wrong sign: the window moves as the shift says",
        {
            "across": "column + ½ − ½ columns − shift_x longer",
            "upward": "row + ½ − ½ rows − shift_y longer",
        },
    ),
    Slip(
        "shift_ignored",
        "the shifts are ignored",
        {"across": "column + ½ − ½ columns", "upward": "row + ½ − ½ rows"},
    ),
    Slip(
        "shift_by_own_side",
        "shift_x is of the picture's width and shift_y of its height: both are of the longer side",
        {
            "across": "column + ½ − ½ columns + shift_x columns",
            "upward": "row + ½ − ½ rows + shift_y rows",
        },
    ),
    Slip(
        "shift_in_pixels",
        "the shifts are taken for pixels: they are of the picture's longer side",
        {
            "across": "column + ½ − ½ columns + shift_x",
            "upward": "row + ½ − ½ rows + shift_y",
        },
    ),
    *(
        Slip(
            f"fit_{name}",
            f"the sensor is fitted to the picture's {side}: it is fitted to the longer side",
            {"pixel": f"w / {letter}"},
        )
        for name, side, letter in (
            ("width", "width", "columns"),
            ("height", "height", "rows"),
            ("shorter", "shorter side", "shorter"),
        )
    ),
    Slip(
        "stretched",
        "both sides of the picture are as long, in space: pixels are square",
        {"u": "across (w / columns)", "v": "upward (w / rows)"},
    ),
    Slip(
        "half_width",
        "half the sensor's width is taken for all of it, as the tangent of half the angle gives it",
        {"w": "perspective ½ (sensor / lens) + orthographic scale"},
    ),
    Slip(
        "twice_the_width",
        "the sensor's width is taken for half of the picture's",
        {"w": "perspective 2 (sensor / lens) + orthographic scale"},
    ),
    Slip(
        "degrees",
        "an angle in degrees is given to the tangent, which takes radians",
        {"w": f"perspective 2 {_TAN.format('half_degrees')} + orthographic scale"},
    ),
    Slip(
        "whole_angle",
        "the tangent is of the whole angle of view: it must be of half of it",
        {"w": f"perspective 2 {_TAN.format('whole_angle')} + orthographic scale"},
    ),
    Slip(
        "scale_is_half",
        "the orthographic scale is the picture's whole width, not half of it",
        {"w": "perspective (sensor / lens) + orthographic 2 scale"},
    ),
    Slip(
        "always_perspective",
        "every camera is taken for a perspective one",
        {"w": "sensor / lens", "d": "u right + v up − back", "o": "e"},
    ),
    Slip(
        "always_orthographic",
        "every camera is taken for an orthographic one",
        {"w": "scale", "d": "−back", "o": "e + u right + v up"},
    ),
    Slip(
        "fan_of_an_orthographic_camera",
        "the rays of an orthographic camera spread: they are parallel to its axis",
        {"d": "u right + v up − back"},
    ),
)
