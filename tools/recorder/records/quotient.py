"""`certified/quotient.py`: t, rounded once; by stages, whose numbers are variables of the next."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.certified import quotient
from reference_tracer.tracer.certified.quotient import Quotients

from .bounds import CORNERS, FIRST
from .record import Inputs, Kept, Record, locals_of

_TRIANGLE = dict(ax=-1.1, ay=-0.9, az=-5.2, bx=1.3, by=-0.8, bz=-5.7, cx=0.2, cy=1.4, cz=-4.9)
_O, _D = "ox oy oz", "dx dy dz"
_ORIGIN, _DIRECTION = dict(ox=0.11, oy=0.07, oz=0.3), dict(dx=0.01, dy=-0.02, dz=-1.0)
_POWERS = tuple(2.0**k for k in range(-3, 4))
_HALVES = "hx hy hz", "lx ly lz"  # of a normal
_NORMAL = dict(hx=3.0, hy=-2.0, hz=5.0, lx=1e-9, ly=-2e-9, lz=3e-9)
# A table's columns: n in halves, then T, D and e as far as the rays share them.
_ROWS = {
    "from_point": ("T1", "T2", "ET", "ED"),
    "parallel": ("T1", "T2", "ET", "D1", "D2", "ED"),
    "alone": ("size", "px", "py", "pz"),
}
_REST = dict(T1=-5.0, T2=1e-12, ET=1e-20, D1=-2.0, D2=1e-12, ED=1e-20)
_REST |= dict(size=64.0, px=0.5, py=0.25, pz=-3.0)


class _Many:
    """Rays that do not share what they have: one of them, and that there are others."""

    def __init__(self, one) -> None:
        self._one = one
        self.shape = (3, 2)

    def __getitem__(self, index):
        return self._one[index]


def _pair(v: Inputs, high: str, low: str):
    return v.vector(high), v.vector(low)


def _named(names: str, values) -> Kept:
    return dict(zip(names.split(), values, strict=True))


def _two_sum(v: Inputs) -> Kept:
    return _named("two_sum_high two_sum_low", quotient.two_sum(v.one("a"), v.one("b")))


def _halves(v: Inputs) -> Kept:
    return _named("halves_high halves_low", quotient.halves(v.one("v"), v.one("unit")))


def _dot(v: Inputs, prefix: str, rest) -> Kept:
    normal = v.stacked([*map(v.one, " ".join(_HALVES).split())])
    found = quotient._dot(v.vector("vx vy vz"), rest, v.one("unit"), normal)
    return _named(f"{prefix}_high {prefix}_low", found)


def _cross(v: Inputs) -> Kept:
    first, second = _pair(v, "ux uy uz", "u2x u2y u2z"), _pair(v, "vx vy vz", "v2x v2y v2z")
    (high, low), size = quotient._cross(first, second)
    names = "cross_x cross_y cross_z", "cross_low_x cross_low_y cross_low_z"
    return _named(names[0], high) | _named(names[1], low) | {"cross_size": size}


def _quotient(v: Inputs) -> Kept:
    over, under = ([v.one(f"{k}{of}") for k in names] for of, names in _PAIRS)
    t, sure = quotient._quotient(over, under)
    return {"quotient_t": t, "quotient_sure": sure}


_PAIRS = (("", ("T1", "T2", "ET")), ("", ("D1", "D2", "ED")))


def _prepared(v: Inputs, case: str) -> Quotients:
    """The bounds of the rays' components are those of one: `unit` is recorded by itself."""
    origins = v.vector(_O) if "ox" in v else np.zeros((3, 1))
    directions = v.vector(_D) if "dx" in v else np.zeros((3, 1))
    out = Quotients.__new__(Quotients)
    out._one_origin, out._one_direction = case == "from_point", case == "parallel"
    out._origin, out._direction = origins, directions
    out._unit = v.one("unit") if "unit" in v else None
    return out


def _table(v: Inputs, case: str) -> Kept:
    """A triangle's normal and M are variables: `_cross` of the two sides is recorded by itself."""
    own, rows = _prepared(v, case), 12 if case == "parallel" else 10
    table = _empty(v, (rows, 1))
    own._enter(table, v.vector("px py pz"), _pair(v, "nx ny nz", "n2x n2y n2z"), v.one("M"))
    names = (*" ".join(_HALVES).split(), *_ROWS[case])
    return {f"table_{case}_{name}": row for name, row in zip(names, table, strict=True)}


def _empty(v: Inputs, shape: tuple[int, ...]):
    return quotient.np.empty(shape)


def _meet(v: Inputs, case: str) -> Kept:
    own = _prepared(v, case)
    names = (*" ".join(_HALVES).split(), *_ROWS[case])
    own._table = v.stacked([v.one(name) for name in names])
    origins = v.vector("qx qy qz" if "qx" in v else _O) if case != "from_point" else None
    rays = Rays(origins, v.vector(_D) if case != "parallel" else None)
    with locals_of(quotient._quotient) as local:
        t, sure = own.meet(rays, FIRST)
    over, under = local["numerator"], local["denominator"]
    parts = dict(zip(("T1", "T2", "ET", "D1", "D2", "ED"), (*over, *under), strict=True))
    prefix = f"meet_{case}"
    # What `_quotient` is called with; it is recorded by itself.
    return {f"{prefix}_{name}": value for name, value in parts.items()}


def _triangle(v: Inputs) -> Kept:
    """What `Quotients.of` hands on of a triangle: its normal as high + low, and M."""
    own, kept = _prepared(v, "alone"), {}

    def enter(table, point, normal, error):
        kept.update(zip(("high", "low", "M"), (*normal, error), strict=True))

    class Own(Quotients):
        def __init__(self, rays, count) -> None:
            self._table = np.zeros((10, count))

        def _enter(self, table, point, normal, error) -> None:
            enter(table, point, normal, error)

    del own
    Own.of(None, v.matrix(*CORNERS))
    names = "normal_x normal_y normal_z", "normal_low_x normal_low_y normal_low_z"
    return _named(names[0], kept["high"]) | _named(names[1], kept["low"]) | {"normal_M": kept["M"]}


def _unit(v: Inputs) -> Kept:
    return {"power_above": quotient.power_above(v.vector("vx vy vz"))}


def _error(v: Inputs) -> Kept:
    return {"quotient_error": quotient._error(v.one("unit"), v.one("size"))}


_ARM = dict(vx=0.3, vy=-0.7, vz=0.9, unit=1.0)
_SIDES = dict(ux=1.5, uy=-2.5, uz=0.3, vx=0.7, vy=1.1, vz=-3.3)
_SIDES |= {f"{k[0]}2{k[1]}": v * 2.0**-54 for k, v in _SIDES.items()}
