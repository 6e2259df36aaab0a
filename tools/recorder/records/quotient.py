"""`certified/quotient.py`: t, rounded once; by stages, whose numbers are variables of the next."""

from __future__ import annotations

from types import SimpleNamespace
from unittest import mock

from reference_tracer.certified import quotient
from reference_tracer.certified.quotient import Quotients
from reference_tracer.tracer.camera import Rays

from .bounds import CORNERS
from .record import Inputs, Kept, Record, locals_of, named

_TRIANGLE = dict(ax=-1.1, ay=-0.9, az=-5.2, bx=1.3, by=-0.8, bz=-5.7, cx=0.2, cy=1.4, cz=-4.9)
_ORIGIN, _DIRECTION = dict(ox=0.11, oy=0.07, oz=0.3), dict(dx=0.01, dy=-0.02, dz=-1.0)
_OWN_ORIGIN = dict(qx=0.12, qy=0.3, qz=0.3)
_POWERS = tuple(2.0**k for k in range(-3, 4))
_UNIT = dict(unit=_POWERS)
_POINT = dict(px=0.5, py=0.25, pz=-3.0)
_HALVES = dict(hx=3.0, hy=-2.0, hz=5.0, lx=1e-9, ly=-2e-9, lz=3e-9)  # of a normal
_T, _D = dict(T1=-5.0, T2=1e-12, ET=1e-25), dict(D1=-2.0, D2=1e-12, ED=1e-25)
# What a table has below n in halves: T, D and e, as far as the rays share them.
_REST = {
    "from_point": dict(**_T, ED=1e-25),
    "parallel": _T | _D,
    "alone": dict(size=64.0) | _POINT,
}
_SIDES = dict(ux=1.5, uy=-2.5, uz=0.3, vx=0.7, vy=1.1, vz=-3.3)
_SIDES |= {f"{k[0]}2{k[1]}": v * 2.0**-54 for k, v in _SIDES.items()}
_NORMAL = dict(nx=3.0, ny=-2.0, nz=5.0, n2x=1e-16, n2y=-2e-16, n2z=3e-16)
_V = dict(vx=0.3, vy=-0.7, vz=0.9)
_LOW = dict(v2x=1e-17, v2y=-2e-17, v2z=1e-18)
_NOTES = {
    "from_point": "rays from one point",
    "parallel": "parallel rays",
    "alone": "rays that share nothing",
}


def _columns(case: str) -> list[str]:
    return [*_HALVES, *_REST[case]]


def _dot(v: Inputs, has_low: bool) -> Kept:
    normal = v.vector(" ".join(_HALVES))
    rest = v.vector("v2x v2y v2z") if has_low else 0.0
    return quotient._dot(v.vector("vx vy vz"), rest, v.one("unit"), normal)


def _cross(v: Inputs) -> Kept:
    first = v.vector("ux uy uz"), v.vector("u2x u2y u2z")
    (high, low), size = quotient._cross(first, (v.vector("vx vy vz"), v.vector("v2x v2y v2z")))
    return *high, *low, size


def _quotient(v: Inputs) -> Kept:
    over, under = ([v.one(name) for name in names] for names in (_T, _D))
    return quotient._quotient(over, under)


def _unit(v: Inputs) -> Kept:
    """Of several rays it is the same of the largest components: here there is one."""
    origins = v.shared("qx qy qz" if "qx" in v else "ox oy oz")
    own = Quotients(Rays(origins, v.vector("dx dy dz"), one_origin=True), 1)
    return [own._unit]


def _triangle(v: Inputs) -> Kept:
    """The values handed on of a triangle: its normal as high + low, and M."""
    kept = []
    rays = Rays(v.shared("ox oy oz"), v.vector("dx dy dz"), one_origin=True)
    with mock.patch.object(Quotients, "_enter", lambda *some: kept.append(some)):
        Quotients.of(rays, v.matrix(*CORNERS))
    [(_, _, _, (high, low), size)] = kept
    return *high, *low, size


def _prepared(v: Inputs, case: str) -> Quotients:
    out = Quotients.__new__(Quotients)
    out._one_origin, out._one_direction = case == "from_point", case == "parallel"
    out._origin = v.shared("ox oy oz") if "ox" in v else None
    out._direction = v.shared("dx dy dz") if "dx" in v else None
    out._unit = v.shared_one("unit") if "unit" in v else None
    return out


def _table(v: Inputs, case: str) -> Kept:
    """The normal and M are variables: `_cross` of two sides is recorded by itself."""
    own, columns = _prepared(v, case), _columns(case)
    table = quotient.np.empty((len(columns), v.columns))
    normal = v.vector("nx ny nz"), v.vector("n2x n2y n2z")
    own._enter(table, v.vector("px py pz"), normal, v.one("M"))
    return table


def _meet(v: Inputs, case: str) -> Kept:
    """The arguments of `_quotient`, which is recorded by itself."""
    own = _prepared(v, case)
    own._table = v.vector(" ".join(_columns(case)))
    origins = {"from_point": "", "parallel": "qx qy qz", "alone": "ox oy oz"}[case]
    direction = own._direction if case == "parallel" else v.vector("dx dy dz")
    rays = SimpleNamespace(origins=v.vector(origins) if origins else None, directions=direction)
    with locals_of(quotient._quotient) as local:
        own.meet(rays, v.rows)
    return *local["numerator"], *local["denominator"]


def _simple(name: str, function: str, values: dict, call, theorem: str, **options) -> Record:
    """Return a record with one theorem for all results: the endings of their names, if several."""
    theorems = named(name, options.pop("ends", ""), theorem) or {name: theorem}
    return Record(name, f"quotient.{function}", values, call, theorems, **options)


def _cases():
    given = {
        "from_point": (_ORIGIN, dict(unit=1.0)),
        "parallel": (_ORIGIN | _DIRECTION, dict(unit=1.0)),
        "alone": ({}, {}),
    }
    for case, (shared, unit) in given.items():
        yield _simple(
            f"table_{case}",
            "Quotients._enter",
            _NORMAL | _POINT | dict(M=32.0) | shared | unit,
            lambda v, case=case: _table(v, case),
            f"QuotientBinary.binary_{case}",
            ends=" ".join(_columns(case)),
            note=_NOTES[case],
            domain=_UNIT | dict(M=_POWERS),
        )
        rays = {
            "from_point": _DIRECTION,
            "parallel": _ORIGIN | _OWN_ORIGIN,
            "alone": _ORIGIN | _DIRECTION,
        }[case]
        yield _simple(
            f"meet_{case}",
            "Quotients.meet",
            _HALVES | _REST[case] | rays | unit,
            lambda v, case=case: _meet(v, case),
            f"QuotientBinary.binary_{case}",
            ends=" ".join((*_T, *_D)),
            note=_NOTES[case],
            domain=_UNIT,
        )


_HIGH_LOW, _NORMAL_ENDS = "high low", "x y z low_x low_y low_z M"

RECORDS = (
    _simple(
        "two_sum",
        "two_sum",
        dict(a=1.0, b=1e-20),
        lambda v: quotient.two_sum(v.one("a"), v.one("b")),
        "Digits.two_sum_exact",
        ends=_HIGH_LOW,
    ),
    _simple(
        "halves",
        "halves",
        dict(v=0.7, unit=1.0),
        lambda v: quotient.halves(v.one("v"), v.one("unit")),
        "Digits.halves_exact",
        ends=_HIGH_LOW,
        domain=_UNIT,
    ),
    _simple(
        "highest",
        "highest",
        dict(a=0.7),
        lambda v: [quotient.highest(v.one("a"))],
        "Digits.highest_digits",
    ),
    _simple(
        "power_above",
        "power_above",
        _V,
        lambda v: [quotient.power_above(v.vector("vx vy vz"))],
        "CrossProduct.power_above_spec",
    ),
    _simple(
        "product_error",
        "_error",
        dict(unit=1.0, size=4.0),
        lambda v: [quotient._error(v.one("unit"), v.one("size"))],
        "Quotient.dot_known",
    ),
    _simple(
        "product",
        "_dot",
        _V | _LOW | _HALVES | dict(unit=1.0),
        lambda v: _dot(v, True),
        "ScalarProduct.dot_near",
        ends=_HIGH_LOW,
        note="of a sum of two floats",
        domain=_UNIT,
    ),
    _simple(
        "product_of_one",
        "_dot",
        _V | _HALVES | dict(unit=1.0),
        lambda v: _dot(v, False),
        "ScalarProduct.dot_near",
        ends=_HIGH_LOW,
        note="of one float",
        domain=_UNIT,
    ),
    _simple("cross", "_cross", _SIDES, _cross, "CrossProduct.cross_known", ends=_NORMAL_ENDS),
    _simple(
        "normal",
        "Quotients.of",
        _TRIANGLE | _ORIGIN | _DIRECTION,
        _triangle,
        "CrossProduct.cross_known",
        ends=_NORMAL_ENDS,
        note="a triangle",
    ),
    _simple(
        "unit_from_point",
        "Quotients",
        _ORIGIN | _DIRECTION,
        _unit,
        "CrossProduct.power_above_spec",
        note=_NOTES["from_point"],
    ),
    *_cases(),
    _simple(
        "quotient",
        "_quotient",
        _T | _D,
        _quotient,
        "Ziv.quotient_correct",
        ends="t sure",
    ),
)
