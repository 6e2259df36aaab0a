"""`camera.py`, `candidates.py` and `vector.py`: rays, and the box of pixels of a triangle."""

from __future__ import annotations

from types import SimpleNamespace
from unittest import mock

import numpy as np
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE, Projection
from reference_tracer.tracer import camera, candidates, vector

from .bounds import CORNERS
from .film import AXES, DOMAIN, DUAL, PLACE, WINDOW
from .film import camera as camera_of
from .record import BY_HAND, Inputs, Kept, Record, named

PIXELS = tuple(map(float, range(-64, 65)))
REGION = dict(region_x=3.0, region_y=4.0, region_x_end=600.0, region_y_end=400.0)
_BOX = (
    dict(ax=-1.1, ay=-0.9, az=-5.2, bx=1.3, by=-0.8, bz=-5.7, cx=0.2, cy=1.4, cz=-4.9)
    | WINDOW
    | PLACE
    | DUAL
    | REGION
    | dict(reach=0.5, clip_start=0.1, clip_end=100.0)
)
MATRIX = {f"m{i}{k}": 0.5 + 0.25 * i - 0.125 * k for i in range(3) for k in range(4)}


def _rays(v: Inputs, projection: Projection) -> Kept:
    found = camera.camera_rays(camera_of(v, projection), v.one("px"), v.one("py"))
    return *found.origins, *found.directions


def _positions(v: Inputs) -> Kept:
    """Of the first pixel of a region: which one it is, is counted in integers."""
    tile = SimpleNamespace(width=640, x0=v.scalar("region_x"), y0=v.scalar("region_y"))
    first = np.zeros(v.columns, np.int32)
    return camera.film_positions(tile, v.scalar("dx"), v.scalar("dy"), first)


def _dual(v: Inputs) -> Kept:
    dual = camera.dual_axes(camera_of(v, PERSPECTIVE))
    return (dual[i, n] for i in range(3) for n in range(3))


def _dual_axes(v: Inputs):
    """In place of `dual_axes`, which is recorded by itself."""
    rows = [v.shared(f"{row}_x {row}_y {row}_z").reshape(-1) for row in ("right", "up", "depth")]
    return mock.patch.object(camera, "dual_axes", lambda _: v.stacked(rows))


def _project(v: Inputs) -> Kept:
    with _dual_axes(v):
        found = camera.project(camera_of(v, PERSPECTIVE), v.vector("vx vy vz"))
    return (row for rows in found for row in rows)


def _pixel_bounds(v: Inputs, projection: Projection) -> Kept:
    own = camera_of(v, projection)
    ends = {k: v.scalar(f"region_{k[0]}{'_end' * (k[1] == '1')}") for k in ("x0", "x1", "y0", "y1")}
    own.region = SimpleNamespace(**ends)
    with _dual_axes(v), mock.patch.object(candidates, "has_sound_axes", lambda _: True):
        return candidates.pixel_bounds(own, v.matrix(*CORNERS), v.scalar("reach"))


def _transform(v: Inputs) -> Kept:
    rows = [[v.scalar(f"m{i}{k}") for k in range(4)] for i in range(3)]
    matrix = v.stacked([v.stacked(row) for row in rows])
    return vector.transform_points(matrix, v.vector("vx vy vz"))


_PROJECTIONS = (("perspective", PERSPECTIVE), ("parallel", ORTHOGRAPHIC))
_VECTORS = "origin_x origin_y origin_z direction_x direction_y direction_z"

RECORDS = (
    *(
        Record(
            f"ray_{name}",
            "camera.camera_rays",
            WINDOW | AXES | PLACE | dict(px=100.5, py=99.5),
            lambda v, of=of: _rays(v, of),
            named(f"ray_{name}", _VECTORS, f"FilmCode.{name}_ray"),
            of.name,
            DOMAIN,
        )
        for name, of in _PROJECTIONS
    ),
    Record(
        "film_position",
        "camera.film_positions",
        dict(region_x=3.0, region_y=4.0, dx=0.125, dy=-0.25),
        _positions,
        named("film_position", "x y", "FilmCode.position_x"),
        domain=dict(region_x=PIXELS, region_y=PIXELS),
    ),
    Record(
        "dual",
        "camera.dual_axes",
        AXES,
        _dual,
        named("dual", " ".join(DUAL), "FilmCode.dual_rows"),
    ),
    Record(
        "project",
        "camera.project",
        PLACE | DUAL | dict(vx=0.75, vy=0.5, vz=-2.0),
        _project,
        named("project", "right up depth", BY_HAND)
        | named("project_magnitude", "right up depth", BY_HAND),
    ),
    *(
        Record(
            f"pixel_bounds_{name}",
            "candidates.pixel_bounds",
            _BOX,
            lambda v, of=of: _pixel_bounds(v, of),
            named(f"pixel_bounds_{name}", "x0 x1 y0 y1", BY_HAND),
            of.name,
            DOMAIN | dict.fromkeys(REGION, PIXELS),
        )
        for name, of in _PROJECTIONS
    ),
    Record(
        "transform",
        "vector.transform_points",
        MATRIX | dict(vx=0.75, vy=0.5, vz=-2.0),
        _transform,
        named("transform", "x y z", BY_HAND),
    ),
)
