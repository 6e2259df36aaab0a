"""A ray and an infinite plane: where they meet."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator
from reference_tracer.arrays import Floats
from reference_tracer.derivation.formulas import PLANE as LISTED

from ..form import Field, Form
from ..programs import Letters, Part, Program, Slip, unit
from .subject import Groups, Subject
from .triangle import RAYS

SEED = 20261126
EACH = 40  # cases of a group

PARTS = Part("t", ("t",), 1), Part("point", ("x",), 3)
_T = LISTED["t"].right
_SLIPS = (
    Slip(
        "t_is_distance",
        "t is the distance from the origin, in metres: x = o + t d wants it in lengths of d (has d "
        "been normalised?)",
        {"t": f"({_T}) length", "x": "o + (t / length) d"},
    ),
    Slip(
        "back_missed",
        "a plane is hit only if n points towards the ray's origin: d · n may have either sign, a "
        "plane has two sides",
        conditions={"t > 0": ("t > 0", "d · n < 0")},
    ),
    Slip(
        "front_missed",
        "a plane is hit only if n points away from the ray's origin: d · n may have either sign, a "
        "plane has two sides",
        conditions={"t > 0": ("t > 0", "d · n > 0")},
    ),
    Slip("point_not_moved", "the point is o + d, not o + t d", {"x": "o + d"}),
)
TEXTBOOK = Program.of({"t": _T, "x": LISTED["x"].right}, ("t > 0",), ("o p", "n d"), PARTS, _SLIPS)
# The plane as x · n = h.
FROM_ORIGIN = Program.of(
    {"h": "p · n", "t": "(h − o · n) / (d · n)", "x": "o + t d"},
    ("t > 0",),
    ("o p", "n d"),
    PARTS,
    (
        Slip(
            "h_of_unit_normal",
            "p · n is divided by the length of n, and o · n and d · n are not: n is not normalised",
            {"h": "(p · n) / size"},
        ),
    ),
)


def letters(origins: Floats, directions: Floats, points: Floats, normals: Floats) -> Letters:
    """Return the letters of n rays and planes, (n, 3) float64 each."""
    values = {"o": origins.T, "d": directions.T, "p": points.T, "n": normals.T}
    lengths = {
        "length": np.linalg.norm(directions, axis=1),
        "size": np.linalg.norm(normals, axis=1),
    }
    return Letters(values | lengths, (len(origins),))


def cases() -> Groups:
    """Return what is asked, in groups; the same each time."""
    rng = np.random.default_rng(SEED)
    o, d, p, n = front = _towards(rng, 0.6)
    beside = _integers(rng)
    return {
        "front": front,
        "back": (o, d, p, -n),
        "whole": _whole(rng),
        "grazing": _towards(rng, 300.0),
        "tiny": tuple(a * 2.0**-20 for a in front),
        "huge": (o * 2.0**20, d, p * 2.0**20, n),
        "behind": (o, -d, p, n),
        "parallel": beside,
        "inside": (beside[2], *beside[1:]),
    }


Planes = tuple[Floats, Floats, Floats, Floats]  # origins, directions, points, normals


def _towards(rng: Generator, slant: float) -> Planes:
    """Return rays towards planes that their normals point to; a large slant makes them graze."""
    n = unit(rng.normal(size=(EACH, 3)))
    along = unit(np.cross(n, rng.normal(size=(EACH, 3))))
    length, speed, size = 2.0 ** rng.uniform(-2, 2, (3, EACH, 1))
    point = rng.normal(size=(EACH, 3)) * 3
    away = (n + slant * along) / max(1.0, slant)
    inside = np.cross(n, rng.normal(size=(EACH, 3)))
    return point + length * away, -speed * away, point + inside, size * n


def _whole(rng: Generator) -> Planes:
    """Return rays and planes of which every product, sum and quotient is a float."""
    axis = rng.integers(0, 3, EACH)
    n, d = np.zeros((EACH, 3)), rng.integers(-3, 4, (EACH, 3)).astype(float)
    rows, sign = np.arange(EACH), rng.choice((-1.0, 1.0), EACH)
    n[rows, axis] = 2.0 ** rng.integers(-2, 3, EACH) * sign
    d[rows, axis] = 2.0 ** rng.integers(-2, 3, EACH) * rng.choice((-1.0, 1.0), EACH)
    point, other = rng.integers(-8, 9, (2, EACH, 3)).astype(float)
    other[rows, axis] = point[rows, axis]
    return point - 4 * d, d, other, n


def _integers(rng: Generator) -> Planes:
    """Return rays of integers along planes across an axis, beside them.

    d . n is exactly 0 in every formula, also where d or n is normalised first.
    """
    rows, axis = np.arange(EACH), rng.integers(0, 3, EACH)
    n, d = np.zeros((EACH, 3)), rng.integers(1, 9, (EACH, 3)).astype(float)
    n[rows, axis] = rng.integers(1, 9, EACH) * rng.choice((-1, 1), EACH)
    d[rows, axis] = 0
    point = rng.integers(-8, 9, (EACH, 3)).astype(float)
    return point + n, d, point, n


PLANE = Subject(
    name="plane",
    title="ray/plane tests",
    form=Form(
        "intersect_plane",
        (*RAYS, Field("points", "px,py,pz", (3,)), Field("normals", "nx,ny,nz", (3,))),
        (Field("t", "t"), Field("hits", "x,y,z", (3,))),
    ),
    programs=(TEXTBOOK, FROM_ORIGIN),
    weights={"hit": 0.4, "t": 0.3, "point": 0.3},
    groups={
        "front": "ordinary hits, n pointing towards the ray's origin",
        "back": "the same with -n",
        "whole": "hits in integers: nothing is rounded",
        "grazing": "rays that meet their plane at less than a degree",
        "tiny": "the first ones with all numbers 2^-20 times as large",
        "huge": "the first ones, 2^20 times as far",
        "behind": "planes behind the ray's origin",
        "parallel": "rays beside a plane, parallel to it",
        "inside": "rays in their plane, which are parallel to it, too",
    },
    letters=letters,
    asked=cases,
    whole=("whole", "parallel", "inside"),
)
