"""`certified/bounds.py`: the functions of a ray and a triangle, their bounds, and t's interval."""

from __future__ import annotations

import numpy as np
from reference_tracer.certified.bounds import Fractions, FromPoint, Parallel, plane_fractions
from reference_tracer.tracer.camera import Rays

from .record import Inputs, Kept, Record, named

FIRST = np.zeros(1, np.intp)  # the row of the one triangle
CORNERS = "ax ay az", "bx by bz", "cx cy cz"
_TRIANGLE = dict(ax=-1.1, ay=-0.9, az=-5.2, bx=1.3, by=-0.8, bz=-5.7, cx=0.2, cy=1.4, cz=-4.9)
_RAY = dict(ox=0.11, oy=0.07, oz=0.3, dx=0.01, dy=-0.02, dz=-1.0)
_REACH = dict(rx=0.5, ry=0.4, rz=1.0)
_BOX = dict(lx=-0.5, ly=-0.6, lz=0.2, hx=0.5, hy=0.7, hz=0.4)
_PLANE = dict(px=0.3, py=0.2, pz=-9.0, nx=0.1, ny=0.2, nz=0.97)


def rays(v: Inputs, shared: str = "") -> Rays:
    """Rays, in columns but for what they share: the origin `o`, or the direction `d`."""
    vectors = ((v.shared if k == shared else v.vector)(f"{k}x {k}y {k}z") for k in "od")
    return Rays(*vectors, one_origin=shared == "o", one_direction=shared == "d")


def from_point(v: Inputs) -> FromPoint:
    return FromPoint(v.shared("ox oy oz"), v.shared("rx ry rz"), v.matrix(*CORNERS))


def parallel(v: Inputs) -> Parallel:
    ends = v.shared("lx ly lz"), v.shared("hx hy hz")
    return Parallel(v.shared("dx dy dz"), *ends, v.matrix(*CORNERS))


def _edges(prepared: FromPoint | Parallel, v: Inputs, shared: str) -> Kept:
    edges, error = prepared.edges(v.rows, rays(v, shared))
    return *edges, error


def _numbers(found: Fractions) -> Kept:
    return found.numerator, found.numerator_error, found.denominator, found.denominator_error


def _interval(v: Inputs) -> Kept:
    return Fractions(*(v.one(name) for name in ("T", "ET", "D", "ED"))).interval()


def _edge_theorems(prefix: str) -> dict[str, str]:
    return named(prefix, "ab bc ca error", f"Forms.{prefix}_e")


def _theorems(prefix: str) -> dict[str, str]:
    top, bottom = (named(prefix, f"{k} {k}_error", f"Forms.{prefix}_{k}") for k in "TD")
    return top | bottom


RECORDS = (
    Record(
        "from_point",
        "bounds.FromPoint.edges",
        _TRIANGLE | _RAY | _REACH,
        lambda v: _edges(from_point(v), v, "o"),
        _edge_theorems("from_point"),
    ),
    Record(
        "from_point",
        "bounds.FromPoint.fractions",
        _TRIANGLE | _RAY | _REACH,
        lambda v: _numbers(from_point(v).fractions(v.rows, rays(v, "o"))),
        _theorems("from_point"),
    ),
    Record(
        "parallel",
        "bounds.Parallel.edges",
        _TRIANGLE | _RAY | _BOX,
        lambda v: _edges(parallel(v), v, "d"),
        _edge_theorems("parallel"),
    ),
    Record(
        "parallel",
        "bounds.Parallel.fractions",
        _TRIANGLE | _RAY | _BOX,
        lambda v: _numbers(parallel(v).fractions(v.rows, rays(v, "d"))),
        _theorems("parallel"),
    ),
    Record(
        "plane",
        "bounds.plane_fractions",
        _PLANE | _RAY,
        lambda v: _numbers(plane_fractions(rays(v), v.shared("px py pz"), v.shared("nx ny nz"))),
        _theorems("plane"),
    ),
    Record(
        "interval",
        "bounds.Fractions.interval",
        dict(T=5.0, ET=1e-15, D=2.0, ED=1e-15),
        _interval,
        named("interval", "low high", "Pairs.interval_right"),
    ),
)
