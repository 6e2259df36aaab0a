"""A ray and a small scene: which of its objects is hit first, and where.

An object is a triangle in its own space, with a scale and a position in the world.
"""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from reference_tracer.arrays import Floats

from ..form import Arrays, Field, Form, side_by_side
from ..programs import Letters, Part, Program, Slip, unit
from .subject import Groups, Subject
from .triangle import CONDITIONS, CORNERS, FORMULAS, RAYS
from .triangle import TEXTBOOK as TRIANGLE_TEST

SEED = 20261126
EACH = 40  # cases of a group
OBJECTS = 5  # of a scene

PARTS = Part("t", ("t",), 1), Part("object", ("owner",), 1)
# Those that change which triangle is hit.
TRIANGLE_SLIPS = tuple(s for s in TRIANGLE_TEST.slips if not set(s.formulas) & {"s₂", "‖n‖²"})
CHOICE_SLIPS = (
    Slip(
        "first_hit",
        "the first object of the list that is hit is taken, not the nearest",
        choice="first",
    ),
    Slip(
        "last_hit",
        "the last object of the list that is hit is taken, not the nearest",
        choice="last",
    ),
    Slip(
        "farthest_hit", "the farthest hit is taken: the largest t, not the least", choice="farthest"
    ),
    Slip(
        "nearest_on_either_side",
        "the least |t| is taken, in front or behind: only t > 0 is a hit",
        conditions={"t > 0": ()},
        choice="least",
    ),
)
TEXTBOOK = Program.of(
    {"o": "(o_world − c) / k", "d": "d_world / k", **FORMULAS},
    CONDITIONS,
    ("p₁ p₂ p₃ x o", "n nₛ₁ nₛ₂ nₛ₃ d", "o_world c"),
    PARTS,
    (
        *CHOICE_SLIPS,
        Slip(
            "t_of_the_objects_scale",
            "the ray's direction is not divided by the object's scale: each object has a t of its "
            "own scale, and these cannot be compared",
            {"d": "d_world"},
        ),
        Slip(
            "t_is_distance",
            "t is the distance from the origin, in metres: x = o + t d wants it in lengths of d",
            {"d": "d_world / (k length)"},
        ),
        Slip(
            "scale_ignored", "the objects' scales are ignored", {"o": "o_world − c", "d": "d_world"}
        ),
        Slip("position_ignored", "the objects' positions are ignored", {"o": "o_world / k"}),
        Slip(
            "scaled_before_moved",
            "the ray's origin is divided by the scale before the position is taken off",
            {"o": "o_world / k − c"},
        ),
        *TRIANGLE_SLIPS,
    ),
    "nearest",
)


def letters(
    origins: Floats, directions: Floats, triangles: Floats, scales: Floats, positions: Floats
) -> Letters:
    """Return the letters of n rays, each with its scene of k objects.

    Parameters
    ----------
    origins, directions : (n, 3) float64
    triangles : (n, k, 3, 3) float64
        Scene, object, corner, component.
    scales : (n, k) float64
    positions : (n, k, 3) float64
    """
    values = {
        "o_world": origins.T[:, :, None],
        "d_world": directions.T[:, :, None],
        "length": np.linalg.norm(directions, axis=1)[:, None],
        "k": scales,
        "c": positions.transpose(2, 0, 1),
        **dict(zip(CORNERS, triangles.transpose(2, 3, 0, 1), strict=True)),
    }
    return Letters(values, scales.shape)


def rows(t: Floats, objects: Floats) -> Floats:
    """Return answers as rows of numbers; where nothing is hit, the object says nothing."""
    return side_by_side(t, np.where(np.isfinite(t), objects, 0.0))


GROUPS = {
    "one": "one object of five is hit",
    "several": "several are hit, in any order of the list",
    "scaled": "several are hit that are scaled by 1/8 to 8",
    "behind": "what is nearest lies behind the ray's origin",
    "none": "all are passed by, or lie behind",
    "large": "several are hit that are a hundred times as large",
    "tied": "two objects are one: either is right",
}


def cases() -> Groups:
    """Return what is asked, in groups; the same each time."""
    rng = np.random.default_rng(SEED)
    return {name: _scenes(rng, name) for name in GROUPS}


def _scenes(rng: Generator, name: str) -> Arrays:
    shape = EACH, OBJECTS
    where = np.argsort(rng.random(shape), axis=1)  # a random order in each scene
    t = 2 * 1.25 ** np.argsort(rng.random(shape), axis=1) * rng.uniform(1, 1.1, shape)
    hit = where < {"one": 1, "none": 2}.get(name, 4)
    if name == "behind":
        t = np.where(where == 0, -0.3 * t.min(axis=1, keepdims=True), t)
    if name == "none":
        t = np.where(hit, -t, t)
    s = rng.dirichlet((3, 3, 3), shape) * 0.7 + 0.1
    beside = rng.permuted(rng.choice(((-0.4, 0.6, 0.8), (1.6, -0.3, -0.3)), shape), axis=2)
    s = np.where(hit[..., None], s, beside)
    origin, direction = 3 * rng.normal(size=(EACH, 3)), rng.normal(size=(EACH, 3))
    point = origin[:, None] + t[..., None] * direction[:, None]
    corners = _triangles(rng, direction) * (100.0 if name == "large" else 1.0)
    corners += (point - (s[..., None] * corners).sum(axis=2))[:, :, None]
    spread = 3.0 if name == "scaled" else 0.5
    scale = 2.0 ** rng.uniform(-spread, spread, shape)
    position = rng.normal(size=(*shape, 3)) * 2
    own = (corners - position[:, :, None]) / scale[..., None, None]
    if name == "tied":
        nearest = np.where(hit, t, np.inf).argmin(axis=1)
        other = (nearest + 1 + rng.integers(0, OBJECTS - 1, EACH)) % OBJECTS
        rows = np.arange(EACH)
        for array in (own, scale, position):
            array[rows, other] = array[rows, nearest]
    return origin, direction, own, scale, position


def _triangles(rng: Generator, direction: Floats) -> Floats:
    """Return triangles (n, k, 3, 3) about the origin that face a direction (n, 3), or turn away."""
    normal = unit(unit(direction)[:, None] + 0.4 * rng.normal(size=(EACH, OBJECTS, 3)))
    first = unit(np.cross(normal, rng.normal(size=normal.shape)))
    second = np.cross(normal, first) * rng.choice((-1, 1), (EACH, OBJECTS, 1))
    angles = 2 * np.pi * (np.arange(3) / 3 + rng.uniform(-0.1, 0.1, (EACH, OBJECTS, 3)))
    across = np.cos(angles)[..., None] * first[:, :, None]
    return across + np.sin(angles)[..., None] * second[:, :, None]


SCENES = (
    Field("triangles", "p1x,p1y,p1z,p2x,p2y,p2z,p3x,p3y,p3z of each object", (OBJECTS, 3, 3)),
    Field("scales", "scale of each object", (OBJECTS,)),
    Field("positions", "x,y,z of each object", (OBJECTS, 3)),
)
NEAREST = Subject(
    name="nearest",
    title="nearest hits",
    form=Form("nearest_hit", (*RAYS, *SCENES), (Field("t", "t"), Field("objects", "object"))),
    programs=(TEXTBOOK,),
    weights={"object": 0.6, "t": 0.4},
    groups=GROUPS,
    letters=letters,
    asked=cases,
    rows=rows,
)
