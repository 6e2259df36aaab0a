"""`certified/ladder.py` and `order.py`: what the bounds decide."""

from __future__ import annotations

from types import SimpleNamespace
from unittest import mock

import numpy as np
from reference_tracer.certified import ladder, order
from reference_tracer.tracer.camera import Rays

from .record import Inputs, Kept, Record, locals_of, named

_EDGES = dict(e1=0.5, e2=0.25, e3=0.75, error=1e-15)
_RANGE = dict(low=2.0, high=2.5, end=100.0, sure=True)
_TABLE = dict(base=0.25, v1=0.5, v2=-0.75, v3=0.125, sign=1.0)
_SIGN = {"sign": (-1.0, 1.0)}
_RAY = dict(ox=0.11, oy=0.07, oz=0.3, o0x=-0.5, o0y=-0.4, o0z=0.25, dx=0.01, dy=-0.02, dz=-1.0)


def _sides(v: Inputs) -> Kept:
    edges = v.vector("e1 e2 e3"), v.one("error")
    prepared = SimpleNamespace(edges=lambda row, rays: edges)
    sure, _ = ladder.sides(prepared, v.rows, None)
    return v.chosen(0), sure


def _in_range(v: Inputs) -> Kept:
    fractions = SimpleNamespace(interval=lambda: (v.one("low"), v.one("high")))
    ends = v.scalar("start"), v.scalar("end")
    return ladder.in_range(fractions, v.one("sure"), *ends)


def _order(v: Inputs, shared: bool) -> Kept:
    """Integers make the table (`order._difference`): here its numbers are variables."""
    many = np.zeros((3, 2))  # (3, 1) is shared by all rays
    directions = v.vector("dx dy dz") if shared else many
    origin = v.vector("ox oy oz")
    around = Rays(v.shared("o0x o0y o0z") if shared else _Several(v.shared("o0x o0y o0z")), many)
    table = tuple(v.scalar(name) for name in ("base", "v1", "v2", "v3", "sign"))
    with (
        mock.patch.object(order, "_difference", lambda *_: table),
        locals_of(order.order_of) as found,
    ):
        out = order.order_of(around, Rays(origin, directions), None, 0 * v.rows, 0 * v.rows)
    return out, found["value"], found["error"], found["known"]


class _Several:
    """Origins, of which the first is asked for."""

    shape = (3, 2)

    def __init__(self, first) -> None:
        self._first = first

    def __getitem__(self, _):
        return self._first


def _order_theorems(prefix: str) -> dict[str, str]:
    theorem = "CodeOrder.code_order_right"
    return {prefix: theorem} | named(prefix, "value error known", theorem)


_RANGE_RESULTS = "low high outside doubt"
RECORDS = (
    Record(
        "sides",
        "ladder.sides",
        _EDGES,
        _sides,
        {"sides_possible": "Pairs.sides_impossible_right", "sides_sure": "Pairs.sides_sure_right"},
    ),
    Record(
        "in_range",
        "ladder.in_range",
        _RANGE | {"start": 0.5},
        _in_range,
        named("in_range", _RANGE_RESULTS, "CodeRange.in_range_is"),
        "start not negative",
    ),
    Record(
        "in_range_behind",
        "ladder.in_range",
        _RANGE | {"start": -0.5},
        _in_range,
        named("in_range_behind", _RANGE_RESULTS, "CodeRange.in_range_behind_is"),
        "start negative",
    ),
    Record(
        "order_from_point",
        "order.order_of",
        _TABLE | _RAY,
        lambda v: _order(v, True),
        _order_theorems("order_from_point"),
        "rays from one point",
        _SIGN,
    ),
    Record(
        "order_parallel",
        "order.order_of",
        _TABLE | _RAY,
        lambda v: _order(v, False),
        _order_theorems("order_parallel"),
        "parallel rays",
        _SIGN,
    ),
)
