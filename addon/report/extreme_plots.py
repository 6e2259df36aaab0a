"""Draws numerical stability: of each sweep, the share of the rays that each method loses."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from math import ceil

from ..methods import MEASURED, Method
from ..study.extremes import ExtremesRow, written
from ..study.scenarios.sweeps import BY_NAME
from ..tracer.settings import Precision
from . import plots
from .tables import percent

_LOST = "Rays that are missed or see the wrong surface, as scenes become extreme"
_NESTED = (
    "Lines that cover one another are drawn one inside the other. The literal textbook is left "
    "out: it loses rays from the first scale of nearly all."
)
# The methods of the sweeps: the literal textbook loses half of all rays and would hide the others.
SWEPT = tuple(m for m in MEASURED if m is not Method.TEXTBOOK_LITERAL)
_ACROSS = 4  # sweeps beside one another
_HIGH = 360  # of one, with its title and its numbers
_PERCENTS = plots.Scale(0, 100, {v: f"{v} %" for v in (0, 50, 100)})


def picture(rows: Sequence[ExtremesRow]) -> str:
    """Return small multiples: of each scenario the share of lost rays over the scale."""
    sweeps: dict[str, list[ExtremesRow]] = {}
    for row in rows:
        sweeps.setdefault(row.scenario, []).append(row)
    wide = plots.WIDTH / _ACROSS
    height = 170 + _HIGH * ceil(len(sweeps) / _ACROSS)
    out = plots.text((20, 28), _LOST, 27) + plots.text((20, 66), _NESTED, 19, plots.GREY)
    for k, (name, sweep) in enumerate(sweeps.items()):
        left, top = wide * (k % _ACROSS) + 85, _HIGH * (k // _ACROSS) + 155
        out += _sweep((left, top, wide - 115, _HIGH - 160), name, sweep)
    entries = {m.record.words: _series(m, Precision.FLOAT64).sample for m in SWEPT}
    entries |= {
        p: plots.Series(plots.GREY, (), p is Precision.FLOAT32, 6, 4).sample for p in Precision
    }
    out += plots.legend(entries, height - 30)
    return plots.picture(plots.WIDTH, height, _LOST, _NESTED, out)


def _series(
    method: Method, precision: Precision, points: Sequence[tuple[float, float, str]] = ()
) -> plots.Series:
    """Return a method's line; each is thinner than the one before, so that both are seen."""
    k = SWEPT.index(method)
    radius, width = 10 * 0.6**k, 9 * 0.75**k
    return plots.Series(method.record.color, points, precision is Precision.FLOAT32, width, radius)


def _sweep(box: plots.Box, name: str, rows: Sequence[ExtremesRow]) -> str:
    """Draw one scenario; its scales are steps, each as wide as the next."""
    scales = list(dict.fromkeys(r.scale for r in rows))
    steps = plots.Scale(-0.5, len(scales) - 0.5, {k: written(s) for k, s in enumerate(scales)})
    axes = plots.Axes(*box, steps, _PERCENTS)
    scenario = BY_NAME.get(name)
    title, along = (scenario.title, scenario.scale_and_unit) if scenario else (name, "")
    out = axes.drawn(title, along, small=True)
    for method, p in product(SWEPT, Precision):
        points = [
            (scales.index(r.scale), 100 * r.share, _said(r, method))
            for r in rows
            if (r.method, r.precision) == (method, p)
        ]
        out += plots.chart(axes, [_series(method, p, points)])
    return out


def _said(r: ExtremesRow, method: Method) -> str:
    return f"{method.record.words}, {r.precision}, {written(r.scale)}: {percent(r.share)} %"
