"""A pixel and a camera: the ray through the pixel's centre, in perspective or orthographic.

The camera is Blender's: a matrix with the axes x (right), y (up) and z (backward) and the position
as its columns, a lens and a sensor in millimetres or an orthographic scale in metres, shifts in
lengths of the picture's longer side. Both projections are one program: `perspective` and
`orthographic` are 1 or 0.
"""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from reference_tracer.arrays import Floats

from ..form import Arrays, Field, Form, side_by_side
from ..programs import Letters, Part, Program, unit
from .camera_slips import SLIPS
from .subject import Groups, Subject

SEED = 20261126
EACH = 40  # cases of a group
LARGEST = 2000  # pixels of a side

# Direction first: of an orthographic camera all have the same, of a perspective one the origin.
PARTS = Part("direction", ("d",), 3, 1.0, unit=True), Part("origin", ("o",), 3)
FORMULAS = {
    "w": "perspective (sensor / lens) + orthographic scale",
    "pixel": "w / longer",
    "across": "column + ½ − ½ columns + shift_x longer",
    "upward": "row + ½ − ½ rows + shift_y longer",
    "u": "across pixel",
    "v": "upward pixel",
    "d": "perspective (u right + v up) − back",
    "o": "e + orthographic (u right + v up)",
}
KINDS = (
    "columns rows longer shorter",
    "column row",
    "shift_x shift_y",
    "sensor lens scale",
    "right up back",
    "u v",
    "across upward",
    "perspective orthographic",
)
TEXTBOOK = Program.of(FORMULAS, (), KINDS, PARTS, SLIPS)

CAMERAS = (
    Field("resolutions", "columns,rows", (2,)),
    Field("orthographic", "orthographic"),
    Field("lens", "lens"),
    Field("sensor", "sensor"),
    Field("scale", "scale"),
    Field("shifts", "shift_x,shift_y", (2,)),
    Field("matrices", "m11,m12,m13,m14,m21,m22,m23,m24,m31,m32,m33,m34", (3, 4)),
)


def letters(
    pixels: Floats,
    resolutions: Floats,
    orthographic: Floats,
    lens: Floats,
    sensor: Floats,
    scale: Floats,
    shifts: Floats,
    matrices: Floats,
) -> Letters:
    """Return the letters of n pixels, each with its camera.

    Parameters
    ----------
    pixels, resolutions, shifts : (n, 2) float64
    orthographic, lens, sensor, scale : (n,) float64
    matrices : (n, 3, 4) float64
    """
    half = np.arctan(sensor / (2 * lens))
    axes = np.broadcast_to(np.eye(3)[:, :, None], (3, 3, len(pixels)))
    pairs = "column row columns rows shift_x shift_y".split()
    names = "right up back e row_x row_y row_z axis_x axis_y axis_z".split()
    of_matrix = matrices.transpose(2, 1, 0), matrices[:, :, :3].transpose(1, 2, 0)
    values = {
        **dict(zip(pairs, np.hstack((pixels, resolutions, shifts)).T, strict=True)),
        "longer": resolutions.max(axis=1),
        "shorter": resolutions.min(axis=1),
        "perspective": 1 - orthographic,
        "orthographic": orthographic,
        "lens": lens,
        "sensor": sensor,
        "scale": scale,
        "half_degrees": np.degrees(half),
        "whole_angle": 2 * half,
        **dict(zip(names, np.concatenate((*of_matrix, axes)), strict=True)),
    }
    return Letters(values, (len(pixels),))


def rows(directions: Floats, origins: Floats) -> Floats:
    """Return answers as rows of numbers; of a direction the length does not count."""
    return side_by_side(unit(directions), origins)


GROUPS = {
    "perspective": "perspective cameras, pictures that are wider than high",
    "portrait": "perspective cameras, pictures that are higher than wide",
    "shifted": "perspective cameras with shifts, pictures of both kinds",
    "orthographic": "orthographic cameras, pictures that are wider than high",
    "orthographic_portrait": "orthographic cameras, pictures that are higher than wide",
    "orthographic_shifted": "orthographic cameras with shifts, pictures of both kinds",
}


def cases() -> Groups:
    """Return what is asked, in groups; the same each time."""
    rng = np.random.default_rng(SEED)
    groups = {}
    for name in GROUPS:
        sides = np.sort(rng.integers(8, LARGEST, (EACH, 2)), axis=1).astype(float)
        size = sides if "portrait" in name else sides[:, ::-1]
        if "shifted" in name:
            size = rng.permuted(size, axis=1)
        pixel = np.floor(rng.random((EACH, 2)) * size)
        groups[name] = (pixel, size, *some_cameras(rng, name, EACH))
    return groups


def some_cameras(rng: Generator, name: str, count: int) -> Arrays:
    """Return what a camera is given besides its resolution, of a group."""
    shifts = rng.uniform(-0.5, 0.5, (count, 2)) if "shifted" in name else np.zeros((count, 2))
    axes = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    axes *= np.sign(np.linalg.det(axes))[:, None, None]
    position = rng.normal(size=(count, 3, 1)) * 5
    return (
        np.full(count, float("orthographic" in name)),
        rng.uniform(15, 100, count),
        rng.uniform(20, 40, count),
        rng.uniform(1, 12, count),
        shifts,
        np.concatenate((axes, position), axis=2),
    )


CAMERA = Subject(
    name="camera",
    title="camera rays",
    form=Form(
        "camera_ray",
        (Field("pixels", "column,row", (2,)), *CAMERAS),
        (Field("directions", "dx,dy,dz", (3,)), Field("origins", "ox,oy,oz", (3,))),
    ),
    programs=(TEXTBOOK,),
    weights={"direction": 0.5, "origin": 0.5},
    groups=GROUPS,
    letters=letters,
    asked=cases,
    rows=rows,
)
