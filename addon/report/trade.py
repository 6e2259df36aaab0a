"""Shows a trade: as a table, as `tradeoff.json`, and as plots of time against error."""

from __future__ import annotations

import math
import textwrap
from pathlib import Path
from typing import Any

from ..methods import MEASURED, Method
from ..study.trade import COLUMNS, Column, Trade, TradeRow
from ..tracer.settings import Precision
from . import plots
from .folders import finite, replacing, write_json
from .tables import columns

SCHEMA = "reference_tracer.tradeoff/1"
TABLE, JSON, PLOT = "tradeoff.txt", "tradeoff.json", "tradeoff.svg"

_NOTE = """
* no other row beats it, as far as the rounds agree on which is faster: beside wrong
  pixels, in time and wrong pixels, of the same size; beside coverage, in time and
  coverage, of all. Coverage is the root mean square of RGBA's difference from
  {k} x {k} rays a pixel at the largest size.
"""


def table(trade: Trade) -> str:
    """Return the rows and the advice as text; a star marks what no other row beats."""
    cells = text_cells(trade)
    lines = columns([cells["head"], *cells["rows"]], left=(0, 1, 2))
    return "\n".join([*lines, _NOTE.format(k=trade.converged), trade.advice])


def text_cells(trade: Trade) -> dict[str, list[Any]]:
    """Return the head of the table, and the cells of each row."""
    return {
        "head": ["method", "precision", "picture", *(c.head for c in COLUMNS)],
        "rows": [
            [Method(r.method).record.words, r.precision, r.size, *(c.shown(r) for c in COLUMNS)]
            for r in trade.rows
        ],
    }


def to_dict(trade: Trade) -> dict[str, object]:
    """Return what `tradeoff.json` holds."""
    return {
        "schema": SCHEMA,
        "scene": trade.scene,
        "advice": trade.advice,
        "converged_samples": trade.converged,
        "units": {c.name: c.unit for c in COLUMNS if c.unit},
        "rows": [_row(r) for r in trade.rows],
    }


def _row(r: TradeRow) -> dict[str, object]:
    held = vars(r) | {"fastest": r.fastest, "slowest": r.slowest, "best": r.best}
    del held["rounds"]
    return {name: finite(v) if isinstance(v, float) else v for name, v in held.items()}


def write(directory: str | Path, trade: Trade) -> None:
    """Write `tradeoff.txt`, `tradeoff.json` and `tradeoff.svg`, all or none, in a folder.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    with replacing(Path(directory), (TABLE, PLOT, JSON)) as new:
        (new / TABLE).write_text(table(trade) + "\n", encoding="utf-8")
        write_json(new / JSON, to_dict(trade))
        (new / PLOT).write_text(picture(trade), encoding="utf-8")


def picture(trade: Trade) -> str:
    """Return the plot, an SVG.

    Above, the wrong pixels of the methods side by side; below, the coverage error of all rows. In
    both a line joins the rows that no other beats.
    """
    headline = textwrap.fill(f"{trade.scene}: {trade.advice}", 100)
    first, k = trade.whole[0], trade.converged
    pixels, coverage = (c for c in COLUMNS if c.best)
    drawn = plots.text((20, 80), headline, 26)
    drawn += _against(
        f"Time against wrong pixels: {first.width} × {first.height} pixels, one ray each",
        210,
        pixels,
        trade.whole,
    )
    drawn += _against(
        f"Time against coverage error: RMS of RGBA, against {k} × {k} rays a pixel",
        650,
        coverage,
        [r for r in trade.rows if math.isfinite(r.coverage_error)],
    )
    entries = {m.record.words: plots.mark((0, 0), 13, m.record.color) for m in MEASURED}
    entries |= {p: plots.mark((0, 0), 13, plots.GREY, p == "float32") for p in Precision}
    entries["no other beats these"] = plots.line([(-16, 0), (16, 0)], plots.INK, 4)
    drawn += plots.legend(entries, plots.HEIGHT - 30)
    title = "Time against wrong pixels, and time against coverage error, of every method"
    return plots.picture(plots.WIDTH, plots.HEIGHT, title, trade.advice, drawn)


def _against(title: str, top: float, error: Column, rows: list[TradeRow]) -> str:
    """Draw time against an error; the rows without one stand below the others, at "none"."""
    found = [getattr(r, error.name) for r in rows if getattr(r, error.name)]
    least = min(found, default=1.0)
    most = max(found, default=least)
    most = max(most, 10 * least)
    none = 0.5 * least * (least / most) ** 0.1  # far enough below for its word
    ticks = dict(plots.logarithmic(least, most).ticks)
    if len(found) < len(rows):
        ticks[none] = "none"
    up = plots.Scale(0.8 * none, 1.4 * most, ticks, log=True)
    fastest, slowest = min(r.fastest for r in rows), max(r.slowest for r in rows)
    along = plots.logarithmic(0.9 * fastest, 1.1 * slowest)
    axes = plots.Axes(190, top, 1690, 280, along, up)
    out = axes.drawn(title, "seconds; a bar is from the fastest round to the slowest", error.head)
    best = []
    for r in rows:
        y = getattr(r, error.name) or none
        bar = axes.at(r.fastest, y), axes.at(r.slowest, y)
        out += plots.line(bar, Method(r.method).record.color, 4, opacity=0.4)
        out += plots.chart(axes, [_mark(r, y, getattr(r, error.best))])
        if getattr(r, error.best):
            best.append(axes.at(r.seconds, y))
    return out + plots.line(sorted(best), plots.INK, 4)


def _mark(r: TradeRow, y: float, best: bool) -> plots.Series:
    said = ", ".join(f"{c.head} {c.show(r)}" for c in COLUMNS)
    return plots.Series(
        Method(r.method).record.color,
        [(r.seconds, y, f"{Method(r.method).record.words}, {r.precision}, {r.size}: {said}")],
        hollow=r.precision == Precision.FLOAT32,
        radius=14 if best else 9,
    )
