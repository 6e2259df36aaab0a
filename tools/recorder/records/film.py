"""`sweep/film.py`: where vertices are on the film, and the bounds on that."""

from __future__ import annotations

import builtins
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from unittest import mock

import numpy as np
from reference_tracer.certified.sweep import film
from reference_tracer.certified.sweep.film import Film
from reference_tracer.certified.sweep.vertices import Vertices
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE, Projection

from ..arrays import holds, most
from .record import Inputs, Kept, Record, locals_of, named

WINDOW = dict(left=-0.5, right=0.5, bottom=-0.4, top=0.4, width=640.0, height=480.0)
PLACE = dict(ox=0.5, oy=-0.25, oz=1.5)
DUAL = dict(
    **dict(right_x=1.0, right_y=0.125, right_z=-0.125, up_x=-0.125, up_y=1.0, up_z=0.25),
    **dict(depth_x=0.125, depth_y=-0.25, depth_z=-1.0),
)
AXES = dict(
    **dict(rx=1.0, ry=0.1, rz=-0.1, ux=-0.1, uy=0.9, uz=0.2, fx=0.05, fy=-0.1, fz=-1.0),
)
BOUNDS = dict(c0=1e-12, c1=1e-13, ray_error=1e-14, d0=1e-14, d1=1e-15)
_ENTER = (
    WINDOW | PLACE | DUAL | BOUNDS | dict(dx=0.125, dy=-0.25, vx=0.75, vy=0.5, vz=-2.0)
) | dict(weight=1e-14, clip_start=0.1)
_SIZES = tuple(map(float, range(1, 4096)))
# A scene has no camera without a picture or a window (`scene.Camera`): Python's `max` meets no NaN.
_LOW, _HIGH = (-0.5, -1.5, -3e10, 0.1), (0.5, 1.25, 2e12, 0.2)
DOMAIN = dict(width=_SIZES, height=_SIZES, left=_LOW, right=_HIGH, bottom=_LOW, top=_HIGH)
# The theorem of a perspective and of an orthographic camera.
_PROVEN = {
    "place": ("Perspective.vertex_near", "Orthographic.vertex_near'"),
    "position": ("FilmCode.perspective_enter", "FilmCode.parallel_enter"),
    "nearest": ("Perspective.nearest_seen", "Orthographic.nearest_seen'"),
    "ahead": ("FilmCode.ahead_code", "FilmCode.ahead_code'"),
    "box": ("Perspective.box_holds", "Orthographic.box_holds'"),
    "ray_error": ("FilmCode.ray_error_code", "FilmCode.ray_error_code'"),
}
# What a vertex gets, in its order, with what proves it.
_RESULTS = (
    ("place", "p q w depth size"),
    ("position", "x y"),
    ("nearest", "nearest"),
    ("ahead", "ahead"),
    ("place", "finite"),
    ("box", "lowest_x lowest_y minus_highest_x minus_highest_y margin"),
)
_FIELDS = ("p", "q", "w", "depth", "size", "x", "y", "nearest", "ahead", "finite")


def camera(v: Inputs, projection: Projection) -> SimpleNamespace:
    """A camera of those variables that there are."""
    vectors = dict(origin="ox oy oz", right="rx ry rz", up="ux uy uz", forward="fx fy fz")
    known = {k: v.shared(n).reshape(-1) for k, n in vectors.items() if n.split()[0] in v}
    window = ("left", "right", "bottom", "top")
    known["window"] = SimpleNamespace(**{k: v.scalar(k) for k in window if k in v})
    known |= {k: v.scalar(k) for k in ("width", "height", "clip_start", "clip_end") if k in v}
    return SimpleNamespace(projection=projection, **known)


@contextmanager
def python(module) -> Iterator[None]:
    """Let a module's `max` and `float` of recorded numbers be recorded."""

    def largest(*values, **options):
        return most(*values) if holds(values) else builtins.max(*values, **options)

    def same(value):
        return value if holds(value) else builtins.float(value)

    with (
        mock.patch.object(module, "max", largest, create=True),
        mock.patch.object(module, "float", same, create=True),
    ):
        yield


def of(v: Inputs, projection: Projection, *known: str) -> Film:
    """A film, some of whose numbers are variables; it is sound."""
    out = Film(camera(v, projection), *(v.scalar(k) if k in v else 0.0 for k in ("dx", "dy")))
    numbers = {
        "place": lambda: (v.scalar("c0"), v.scalar("c1")),
        "depth_error": lambda: (v.scalar("d0"), v.scalar("d1")),
        "weight": lambda: 0.0 if projection.shares_direction else v.scalar("weight"),
        "ray_error": lambda: v.scalar("ray_error"),
        "dual": lambda: v.stacked(
            [v.shared(f"{row}_x {row}_y {row}_z").reshape(-1) for row in ("right", "up", "depth")]
        ),
    }
    out.__dict__.update({k: numbers[k]() for k in known}, is_sound=True)
    return out


def _enter(v: Inputs, projection: Projection) -> Kept:
    own = of(v, projection, "dual", "place", "weight", "ray_error", "depth_error")
    with python(film), locals_of(Film._enter_positions) as local:
        vertices = Vertices.empty(v.columns, np.int32)
        own.enter(vertices, 0, v.vector("vx vy vz"))
    fields = (getattr(vertices, name) for name in _FIELDS)
    return *fields, *(vertices.box[:, k] for k in range(4)), local["margin"]


def _of_film(
    find: Callable[[Film, Inputs], Kept], projection: Projection, *known: str
) -> Callable[[Inputs], Kept]:
    def call(v: Inputs) -> Kept:
        with python(film):
            if "spread" not in v:
                return find(of(v, projection, *known), v)
            with mock.patch.object(Film, "_spread", property(lambda _: v.scalar("spread"))):
                return find(of(v, projection, *known), v)

    return call


def _pairs() -> Iterator[Record]:
    """Records of what differs between the projections."""
    for name, of in (("perspective", PERSPECTIVE), ("parallel", ORTHOGRAPHIC)):
        prefix = f"film_{name}"
        yield Record(
            prefix,
            "film.Film.enter",
            {k: v for k, v in _ENTER.items() if not (of.shares_direction and k == "weight")},
            lambda v, of=of: _enter(v, of),
            {
                f"{prefix}_{k}": _PROVEN[what][of.shares_direction]
                for what, names in _RESULTS
                for k in names.split()
            },
            of.name,
            DOMAIN,
        )
        reach = dict(spread=4.5) | WINDOW
        yield Record(
            f"film_ray_error_{name}",
            "film.Film.ray_error",
            reach | AXES | (PLACE if of.shares_direction else {}),
            _of_film(lambda f, _: [f.ray_error], of),
            {f"film_ray_error_{name}": _PROVEN["ray_error"][of.shares_direction]},
            of.name,
            DOMAIN,
        )
        yield Record(
            f"film_place_{name}",
            "film.Film.place",
            reach | dict(ray_error=1e-14),
            _of_film(lambda f, _: f.place, of, "ray_error"),
            named(f"film_place_{name}", "constant slope", _PROVEN["place"][of.shares_direction]),
            of.name,
            DOMAIN,
        )


RECORDS = (
    *_pairs(),
    Record(
        "film_spread",
        "film.Film._spread",
        DUAL,
        _of_film(lambda f, _: [f._spread], PERSPECTIVE, "dual"),
        {"film_spread": "FilmCode.spread_near"},
    ),
    Record(
        "film_weight",
        "film.Film.weight",
        dict(spread=4.5),
        _of_film(lambda f, _: [f.weight], PERSPECTIVE),
        {"film_weight": "Bounds.weight_holds"},
    ),
    Record(
        "film_depth_error",
        "film.Film.depth_error",
        dict(spread=4.5, ray_error=1e-14),
        _of_film(lambda f, _: f.depth_error, ORTHOGRAPHIC, "ray_error"),
        named("film_depth_error", "constant slope", "FilmCode.depth_error_code"),
    ),
)
