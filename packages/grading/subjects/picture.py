"""A whole picture of a small scene: which object each pixel shows.

The program is the camera's, then the triangle's, then the nearest hit: see these.
"""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.random import Generator
from reference_tracer.arrays import Floats

from ..form import Arrays, Field, Form
from ..programs import Letters, Part, Program, Slip
from . import camera
from .nearest import CHOICE_SLIPS, TRIANGLE_SLIPS
from .subject import Groups, Subject
from .triangle import CONDITIONS, CORNERS, FORMULAS

SEED = 20261126
LONGER, SHORTER = 24, 16  # pixels of a picture's sides
PIXELS = LONGER * SHORTER
OBJECTS = 6  # of a scene, one triangle each
NOTHING = -1.0  # what a pixel shows where nothing is hit

PARTS = (Part("pixels", ("shown",), 1, 1.0),)
TEXTBOOK = Program.of(
    {**camera.FORMULAS, **FORMULAS},
    CONDITIONS,
    (*camera.KINDS, "p₁ p₂ p₃ x o", "n nₛ₁ nₛ₂ nₛ₃"),
    PARTS,
    (
        Slip(
            "upside_down_and_mirrored",
            "the picture is turned by half: pixel 0 is the lowest on the left",
            {
                "across": "½ columns − column − ½ + shift_x longer",
                "upward": "½ rows − row − ½ + shift_y longer",
            },
        ),
        *camera.TEXTBOOK.slips,
        *CHOICE_SLIPS,
        *TRIANGLE_SLIPS,
    ),
    "nearest",
)


def letters(*given: Floats) -> Letters:
    """Return the letters of the pixels of n pictures.

    Parameters
    ----------
    *given : arrays
        Those of `camera.CAMERAS`, and triangles (n, k, 3, 3).
    """
    *cameras, triangles = given
    count = len(triangles)
    of_pixel = np.repeat(np.arange(count), PIXELS)
    columns = cameras[0][of_pixel, 0]
    number = np.tile(np.arange(PIXELS), count)
    pixel = np.stack((number % columns, number // columns), axis=1)
    own = camera.letters(pixel, *(array[of_pixel] for array in cameras))
    corners = dict(zip(CORNERS, triangles[of_pixel].transpose(2, 3, 0, 1), strict=True))
    values = {name: value[..., None] for name, value in own.values.items()}
    return Letters(values | corners, (count * PIXELS, triangles.shape[1]))


def rows(objects: Floats) -> Floats:
    """Return pictures (n, pixels) as a row for each pixel; what is no object is nothing."""
    flat = objects.reshape(-1, 1)
    return np.where(flat >= 0, flat, np.inf)


def cases() -> Groups:
    """Return what is asked, in groups; the same each time."""
    rng = np.random.default_rng(SEED)
    return {name: _picture(rng, name) for name in camera.GROUPS}


def _picture(rng: Generator, name: str) -> Arrays:
    """Return one picture of a group: a camera, and triangles spread over what it sees.

    The farthest covers half of the picture and reaches far beyond; one lies behind the camera.
    """
    is_upright = "portrait" in name or name == "orthographic_shifted"
    resolution = np.array([SHORTER, LONGER] if is_upright else [LONGER, SHORTER], float)
    orthographic, lens, sensor, scale, shifts, matrix = camera.some_cameras(rng, name, 1)
    shifts = shifts / 2
    width = scale if orthographic[0] else sensor / lens
    window = width / LONGER * resolution  # on the film, at depth 1 in perspective
    order = rng.permutation(OBJECTS)
    depth = np.where(order == 0, -4, 4 + 1.5 * order)
    places = np.array([*product((-0.3, 0, 0.3), (-0.25, 0.25))])
    places = places[:, ::-1] if is_upright else places
    middle = (places + rng.uniform(-0.08, 0.08, (OBJECTS, 2))) * window
    radius = rng.uniform(0.25, 0.4, OBJECTS) * window.max()
    turn = 2 * np.pi * rng.random(OBJECTS)
    far = order == OBJECTS - 1
    radius[far] = 20 * window.max()
    edge = _at(turn + np.pi / 3)
    middle[far] = -radius[far] / 2 * edge[far]
    around = turn[:, None] + 2 * np.pi / 3 * np.arange(3) * rng.choice((-1, 1), (OBJECTS, 1))
    flat = _at(around) * radius[:, None, None]
    flat += middle[:, None] + shifts[0] * width
    depths = depth[:, None] + rng.uniform(-0.4, 0.4, (OBJECTS, 3))
    flat *= 1 if orthographic[0] else np.abs(depths)[..., None]
    local = np.concatenate((flat, -depths[..., None]), axis=2)
    triangles = local @ matrix[0, :, :3].T + matrix[0, :, 3]
    return (resolution[None], orthographic, lens, sensor, scale, shifts, matrix, triangles[None])


def _at(angles: Floats) -> Floats:
    """Return points of the circle of radius 1, (..., 2)."""
    return np.stack((np.cos(angles), np.sin(angles)), axis=-1)


PICTURE = Subject(
    name="picture",
    title="pictures",
    form=Form(
        "picture",
        (
            *camera.CAMERAS,
            Field("triangles", "p1x,p1y,p1z,p2x,p2y,p2z,p3x,p3y,p3z of each", (OBJECTS, 3, 3)),
        ),
        (Field("objects", f"the objects of {PIXELS} pixels", (PIXELS,)),),
    ),
    programs=(TEXTBOOK,),
    weights={"pixels": 1.0},
    groups=camera.GROUPS,
    letters=letters,
    asked=cases,
    rows=rows,
)
