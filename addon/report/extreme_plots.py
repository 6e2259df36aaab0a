"""Draws numerical stability: where methods break, and the sweeps."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np

from ..methods import MEASURED, Method
from ..study.extremes import BreakingPoint, ExtremesRow, breaking_points, written
from ..study.scenarios.sweeps import BY_NAME
from ..tracer.settings import Precision
from . import plots
from .tables import percent

BREAKING = "Where each method breaks: the first scale at which a ray is missed or wrong"
_EARLY = "the first scale at which rays are lost: dark where it is early"
_HOLDS = "at no scale is a ray lost. (ulp: the distance from one float64 number to the next.)"
_DOUBLED = (
    "no ray is lost, but at some scale a ray crosses more triangles than there are. "
    "A + in other cells: that, too"
)
_LOST = "Rays that are missed or see the wrong surface"
_NESTED = (
    "Lines that cover one another are drawn one inside the other. The literal textbook is left "
    "out: it loses rays from the first scale of nearly all."
)
# The methods of the sweeps: the literal textbook loses half of all rays and would hide the others.
SWEPT = tuple(m for m in MEASURED if m is not Method.TEXTBOOK_LITERAL)
ACROSS = 4  # sweeps beside one another
NEVER = "#d9eedd"  # of a cell where nothing goes wrong
DOUBLED = "#d5e0f0"  # where no ray is lost, but some cross too many triangles
_INKS = {NEVER: "#3d7a4a", DOUBLED: "#3a5687"}
_RAMP = (255, 248, 190), (253, 190, 84), (226, 48, 34), (126, 0, 38)  # from few to all, in sRGB
# Of lines that cover one another, each shows inside the one before: width, radius of its marks.
_THIN: dict[Method, tuple[float, float]] = {
    method: (10 * 0.6**k, 9 * 0.75**k) for k, method in enumerate(SWEPT)
}


def breaking_picture(rows: Sequence[ExtremesRow]) -> str:
    """Return a table in colour: the first scale of each sweep at which a method loses a ray.

    The later in the sweep, the paler. A plus marks methods that cross too many triangles somewhere.
    """
    points, sweeps = breaking_points(rows), by_scenario(rows)
    columns = list(dict.fromkeys((p.method, p.precision) for p in points))
    left, top, high = 660, 150, 50
    wide, below = (plots.WIDTH - left - 10) / len(columns), top + high * len(sweeps)
    out = plots.text((20, 32), BREAKING, 30)
    for k, (method, precision) in enumerate(columns):
        x, words = left + (k + 0.5) * wide, Method(method).record.words
        words = words.replace(" ", "\n").replace("–", "–\n")
        out += plots.text((x, 96), words, 19, anchor="middle", font_weight="bold")
        out += plots.text((x, 135), precision, 18, plots.GREY, "middle")
    for y, (name, sweep) in zip(range(top, below, high), sweeps.items(), strict=True):
        out += plots.text((15, y + high / 2), _title(name), 22)
        out += plots.text((left - 15, y + high / 2), scale_of(name), 18, plots.GREY, "end")
        for p in (p for p in points if p.scenario == name):
            x = left + wide * columns.index((p.method, p.precision))
            said = _point(p, list(dict.fromkeys(r.scale for r in sweep)))
            out += _cell((x + 3, y + 2, wide - 6, high - 4), *said)
    key = ("1e5", _color(0.3), _EARLY), ("never", NEVER, _HOLDS), ("never +", DOUBLED, _DOUBLED)
    for y, (words, color, meaning) in zip(range(below + 20, below + 130, 34), key, strict=False):
        out += _cell((15, y, 100, 29), words, color, _INKS.get(color, plots.INK), 19)
        out += plots.text((130, y + 14.5), meaning, 19, plots.GREY)
    return plots.picture(plots.WIDTH, below + 130, BREAKING, _EARLY, out)


def _point(point: BreakingPoint, sweep: list[float]) -> tuple[str, str, str]:
    """Return what a cell says, its colour and that of its words."""
    words, color = "never", NEVER if point.doubled is None else DOUBLED
    ink = _INKS[color]
    if point.lost is not None:
        late = sweep.index(point.lost) / max(1, len(sweep) - 1)
        words, color = written(point.lost), _color(0.85 - 0.8 * late)
        ink = plots.INK if late > 0.3 else "white"
    return words + " +" * (point.doubled is not None), color, ink


def _cell(box: plots.Box, words: str, color: str, ink: str, size: float = 22) -> str:
    x, y, width, height = box
    middle = x + width / 2, y + height / 2
    return plots.cell(*box, color) + plots.text(middle, words, size, ink, "middle")


def by_scenario(rows: Sequence[ExtremesRow]) -> dict[str, list[ExtremesRow]]:
    """Return the rows of each sweep."""
    sweeps: dict[str, list[ExtremesRow]] = {}
    for row in rows:
        sweeps.setdefault(row.scenario, []).append(row)
    return sweeps


def scale_of(scenario: str) -> str:
    """Return what a scenario's scale means, and its unit; nothing for one of a user's own."""
    return BY_NAME[scenario].scale_and_unit if scenario in BY_NAME else ""


def _title(scenario: str) -> str:
    return BY_NAME[scenario].title if scenario in BY_NAME else scenario


def _color(share: float) -> str:
    """Return a colour from pale yellow to dark red, sRGB."""
    at = np.linspace(0, 1, len(_RAMP))
    r, g, b = (round(float(np.interp(share, at, part))) for part in zip(*_RAMP, strict=True))
    return f"#{r:02x}{g:02x}{b:02x}"


def sweeps_picture(sweeps: Sequence[Sequence[ExtremesRow]], page: str = "") -> str:
    """Return small multiples: of each scenario the share of lost rays over the scale."""
    wide, high = plots.WIDTH / ACROSS, 360
    height = 170 + high * -(-len(sweeps) // ACROSS)
    title = f"{_LOST}{page and f' ({page})'}"
    out = plots.text((20, 28), title, 27) + plots.text((20, 66), _NESTED, 19, plots.GREY)
    for k, rows in enumerate(sweeps):
        left, top = wide * (k % ACROSS) + 85, high * (k // ACROSS) + 155
        out += _sweep((left, top, wide - 115, high - 160), rows)
    entries = {m.record.words: _series(m, Precision.FLOAT64).sample for m in SWEPT}
    entries |= {
        p: plots.Series(plots.GREY, (), p is Precision.FLOAT32, 6, 4).sample for p in Precision
    }
    out += plots.legend(entries, height - 30)
    return plots.picture(plots.WIDTH, height, title, _NESTED, out)


def _series(
    method: Method, precision: Precision, points: Sequence[tuple[float, float, str]] = ()
) -> plots.Series:
    width, radius = _THIN[method]
    return plots.Series(method.record.color, points, precision is Precision.FLOAT32, radius, width)


def _steps(scales: Sequence[float]) -> plots.Scale:
    """Return scales as steps, each as wide as the next."""
    return plots.Scale(-0.5, len(scales) - 0.5, {k: written(s) for k, s in enumerate(scales)})


def _sweep(box: plots.Box, rows: Sequence[ExtremesRow]) -> str:
    """Draw one scenario."""
    name, scales = rows[0].scenario, list(dict.fromkeys(r.scale for r in rows))
    shown = [r for r in rows if r.method in SWEPT]
    percents = plots.Scale(0, 100, {v: f"{v} %" for v in (0, 50, 100)})
    axes = plots.Axes(*box, _steps(scales), percents)
    out = axes.drawn(_title(name), scale_of(name), small=True)
    for method, p in product(SWEPT, Precision):
        said = f"{method.record.words}, {p}, "
        points = [
            (
                scales.index(r.scale),
                100 * r.share,
                f"{said}{written(r.scale)}: {percent(r.share)} %",
            )
            for r in shown
            if (r.method, r.precision) == (method, p)
        ]
        out += plots.chart(axes, [_series(method, p, points)])
    if not any(r.lost for r in shown):
        most = max(r.doubled / r.rays for r in shown)
        note = "no ray is lost"
        note += f"\nup to {100 * most:.0f} %\ncross too many triangles" if most else ""
        out += plots.text((box[0] + box[2] / 2, box[1] + box[3] / 2), note, 19, anchor="middle")
    return out
