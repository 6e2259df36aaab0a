"""Plots numerical stability: of each sweep, the share of the rays that each method loses."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from ..methods import MEASURED, Method
from ..study.extremes import ExtremesRow, written
from ..study.scenarios.sweeps import BY_NAME
from ..tracer.settings import Precision
from .plots import GREY, Entry, Panel, Plot, Scale, Series
from .tables import percent

_LOST = "Rays that are missed or see the wrong surface, as scenes become extreme"
_NESTED = (
    "Lines that cover one another are drawn one inside the other. The literal textbook is left "
    "out: it loses rays from the first scale of nearly all."
)
# The methods of the sweeps: the literal textbook loses half of all rays and would hide the others.
SWEPT = tuple(m for m in MEASURED if m is not Method.TEXTBOOK_LITERAL)
_PERCENTS = Scale(0, 100, "named", [(v, f"{v} %") for v in (0, 50, 100)])


def plot(rows: Sequence[ExtremesRow]) -> Plot:
    """Return small multiples: of each scenario the share of lost rays over the scale."""
    sweeps: dict[str, list[ExtremesRow]] = {}
    for row in rows:
        sweeps.setdefault(row.scenario, []).append(row)
    legend = [Entry(m.record.words, _series(m, Precision.FLOAT64)) for m in SWEPT]
    legend += [Entry(p, Series(GREY, (), p is Precision.FLOAT32, 6, 4)) for p in Precision]
    panels = [_sweep(name, sweep) for name, sweep in sweeps.items()]
    return Plot(_LOST, _NESTED, panels, legend, heading=_LOST, note=_NESTED, small=True)


def _series(
    method: Method, precision: Precision, points: Sequence[tuple[float, float, str]] = ()
) -> Series:
    """Return a method's line; each is thinner than the one before, so that both are seen."""
    k = SWEPT.index(method)
    radius, width = 10 * 0.6**k, 9 * 0.75**k
    return Series(method.record.color, points, precision is Precision.FLOAT32, width, radius)


def _sweep(name: str, rows: Sequence[ExtremesRow]) -> Panel:
    """Return one scenario; its scales are steps, each as wide as the next."""
    scales = list(dict.fromkeys(r.scale for r in rows))
    named = [(float(k), written(s)) for k, s in enumerate(scales)]
    scenario = BY_NAME.get(name)
    title, along = (scenario.title, scenario.scale_and_unit) if scenario else (name, "")
    series = []
    for method, p in product(SWEPT, Precision):
        points = [
            (scales.index(r.scale), 100 * r.share, _said(r, method))
            for r in rows
            if (r.method, r.precision) == (method, p)
        ]
        series.append(_series(method, p, points))
    steps = Scale(-0.5, len(scales) - 0.5, "named", named)
    return Panel(title, along, "", steps, _PERCENTS, series)


def _said(r: ExtremesRow, method: Method) -> str:
    return f"{method.record.words}, {r.precision}, {written(r.scale)}: {percent(r.share)} %"
