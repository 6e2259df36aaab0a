"""`certified/bounds.py`: the functions of a ray and a triangle, their bounds, and t's interval."""

from __future__ import annotations

import numpy as np
from reference_tracer.certified.bounds import Fractions, FromPoint, Parallel, plane_fractions
from reference_tracer.tracer.camera import Rays

from .record import Inputs, Kept, Record

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


def _shared(prefix: str) -> str:
    return {"from_point": "o", "parallel": "d"}[prefix]


def _edges(prefix: str, prepared: FromPoint | Parallel, v: Inputs) -> Kept:
    edges, error = prepared.edges(v.rows, rays(v, _shared(prefix)))
    names = f"{prefix}_ab", f"{prefix}_bc", f"{prefix}_ca"
    return dict(zip(names, edges, strict=True)) | {f"{prefix}_error": error}


def fractions_of(prefix: str, found: Fractions) -> Kept:
    return {
        f"{prefix}_T": found.numerator,
        f"{prefix}_T_error": found.numerator_error,
        f"{prefix}_D": found.denominator,
        f"{prefix}_D_error": found.denominator_error,
    }


def _fractions(prefix: str, prepared: FromPoint | Parallel, v: Inputs) -> Kept:
    return fractions_of(prefix, prepared.fractions(v.rows, rays(v, _shared(prefix))))


def _interval(v: Inputs) -> Kept:
    low, high = Fractions(*(v.one(name) for name in ("T", "ET", "D", "ED"))).interval()
    return {"interval_low": low, "interval_high": high}


def _theorems(prefix: str) -> dict[str, str]:
    names = {"e": "ab bc ca error", "T": "T T_error", "D": "D D_error"}
    return {
        f"{prefix}_{name}": f"Forms.{prefix}_{of}"
        for of, results in names.items()
        for name in results.split()
    }


RECORDS = (
    Record(
        "from_point",
        "bounds.FromPoint.edges",
        _TRIANGLE | _RAY | _REACH,
        lambda v: _edges("from_point", from_point(v), v),
        _theorems("from_point"),
    ),
    Record(
        "from_point",
        "bounds.FromPoint.fractions",
        _TRIANGLE | _RAY | _REACH,
        lambda v: _fractions("from_point", from_point(v), v),
        _theorems("from_point"),
    ),
    Record(
        "parallel",
        "bounds.Parallel.edges",
        _TRIANGLE | _RAY | _BOX,
        lambda v: _edges("parallel", parallel(v), v),
        _theorems("parallel"),
    ),
    Record(
        "parallel",
        "bounds.Parallel.fractions",
        _TRIANGLE | _RAY | _BOX,
        lambda v: _fractions("parallel", parallel(v), v),
        _theorems("parallel"),
    ),
    Record(
        "plane",
        "bounds.plane_fractions",
        _PLANE | _RAY,
        lambda v: fractions_of(
            "plane", plane_fractions(rays(v), v.shared("px py pz"), v.shared("nx ny nz"))
        ),
        _theorems("plane"),
    ),
    Record(
        "interval",
        "bounds.Fractions.interval",
        dict(T=5.0, ET=1e-15, D=2.0, ED=1e-15),
        _interval,
        {"interval_low": "Pairs.interval_right", "interval_high": "Pairs.interval_right"},
    ),
)
