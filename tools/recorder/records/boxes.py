"""`sweep/boxes.py`: what is out of view, and where on the film."""

from __future__ import annotations

from types import SimpleNamespace
from unittest import mock

import numpy as np
from reference_tracer.certified.sweep import boxes
from reference_tracer.certified.sweep.boxes import InstanceBoxes
from reference_tracer.certified.sweep.film import Film
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE, Projection

from . import film
from .camera import MATRIX, PIXELS, REGION
from .film import BOUNDS, DOMAIN, PLACE
from .record import BY_HAND, Inputs, Kept, Record, named, numpy_with

_ENDS = ("low_x", "low_y", "minus_high_x", "minus_high_y")
_FIELDS = dict(p=320.0, q=240.0, w=2.0, depth=2.0) | dict.fromkeys(_ENDS, -100.0)
_CORNERS = {f"{k}{n}": value + n for k, value in _FIELDS.items() for n in range(8)}
_AHEAD = {f"ahead{n}": True for n in range(8)}
_BOX = dict(width=640.0, height=480.0, clip_start=0.1, clip_end=100.0, weight=1e-14, size=4.0)
_MESH = dict(lx=-1.0, ly=-2.0, lz=-3.0, hx=1.5, hy=2.5, hz=3.5)


def _instance(v: Inputs, projection: Projection) -> Kept:
    """The box's eight corners on the film are variables: `Film.enter` is recorded by itself."""
    own = film.of(v, projection, "place", "weight", "ray_error", "depth_error")
    own.camera.region = region(v)

    def of_corners(name: str):
        return v.vector(" ".join(f"{name}{n}" for n in range(8)))[:, 0]

    def enter(_, vertices, first, world) -> None:
        for name in ("p", "q", "w", "depth", "ahead"):
            getattr(vertices, name)[:] = of_corners(name)
        for k, name in enumerate(_ENDS):
            vertices.box[:, k] = of_corners(name)

    with (
        film.python(boxes),
        mock.patch.object(Film, "enter", enter),
        mock.patch.object(
            boxes, "_corners_with_room", lambda _: (np.zeros((3, 8, 1)), v.one("size"))
        ),
        numpy_with(boxes, nan_to_num=lambda depth: depth),  # it only sorts
    ):
        found = InstanceBoxes.of(None, own)
    return found.in_view, *found.low, *found.high, found.nearest


def region(v: Inputs) -> SimpleNamespace:
    ends = {k: f"region_{k[0]}{'_end' * (k[1] == '1')}" for k in ("x0", "x1", "y0", "y1")}
    return SimpleNamespace(**{k: v.scalar(name) for k, name in ends.items()})


def _corners(v: Inputs) -> Kept:
    """The corners of a mesh's box in world space, and the size of the numbers they are made of."""
    matrix = [v.stacked([v.one(f"m{i}{k}") for k in range(4)]) for i in range(3)]
    bounds = [v.vector(names).reshape(-1) for names in ("lx ly lz", "hx hy hz")]
    scene = SimpleNamespace(
        instance_bounds=[end[:, None] for end in bounds],
        instance_matrices=v.stacked(matrix),
    )
    corners, size = boxes._corners(scene)
    return *(corners[k, n] for k in range(3) for n in range(8)), size


RECORDS = (
    *(
        Record(
            f"instance_{name}",
            "boxes.InstanceBoxes.of",
            _CORNERS | _AHEAD | _BOX | BOUNDS | REGION | PLACE,
            lambda v, of=of: _instance(v, of),
            named(f"instance_{name}", "in_view low_x low_y high_x high_y nearest", BY_HAND),
            of.name,
            DOMAIN
            | dict.fromkeys(REGION, PIXELS)
            | {f"{k}{n}": PIXELS for k in _ENDS for n in range(8)},
        )
        for name, of in (("perspective", PERSPECTIVE), ("parallel", ORTHOGRAPHIC))
    ),
    Record(
        "box",
        "boxes._corners",
        MATRIX | _MESH,
        _corners,
        {f"box_corner_{n}_{k}": BY_HAND for k in "xyz" for n in range(8)} | {"box_size": BY_HAND},
        "the box of a mesh",
    ),
)
