"""Shows a trade: as a table, as `tradeoff.json`, and as a page that plots time against error."""

from __future__ import annotations

import math
import textwrap
from pathlib import Path
from typing import Any

from ..methods import MEASURED, Method
from ..study.trade import COLUMNS, Column, Trade, TradeRow
from ..tracer.settings import Precision
from .folders import finite, write_all
from .plots import GREY, INK, Entry, Panel, Plot, Scale, Series
from .tables import columns
from .templates import alone

SCHEMA = "reference_tracer.tradeoff/1"
TABLE, JSON, PLOT = "tradeoff.txt", "tradeoff.json", "tradeoff.html"

_BEST = Series(INK, radius=0, width=4)  # the line through what no other row beats

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
    """Write `tradeoff.txt`, `tradeoff.json` and `tradeoff.html`, all or none, in a folder.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    texts = {TABLE: f"{table(trade)}\n", PLOT: page(trade)}
    write_all(Path(directory), {**texts, JSON: to_dict(trade)})


def page(trade: Trade) -> str:
    """Return the page of the plot."""
    return alone(f"Reference Tracer: {trade.scene}", plots=[plot(trade)])


def plot(trade: Trade) -> Plot:
    """Return the plot.

    Above, the wrong pixels of the methods side by side; below, the coverage error of all rows. In
    both a line joins the rows that no other beats.
    """
    first, k = trade.whole[0], trade.converged
    pixels, coverage = (c for c in COLUMNS if c.best)
    above = _against(
        f"Time against wrong pixels: {first.width} × {first.height} pixels, one ray each",
        pixels,
        trade.whole,
    )
    below = _against(
        f"Time against coverage error: RMS of RGBA, against {k} × {k} rays a pixel",
        coverage,
        [r for r in trade.rows if math.isfinite(r.coverage_error)],
    )
    legend = [Entry(m.record.words, Series(m.record.color, radius=13)) for m in MEASURED]
    legend += [Entry(p, Series(GREY, (), p is Precision.FLOAT32, 13)) for p in Precision]
    legend.append(Entry("no other beats these", _BEST))
    title = "Time against wrong pixels, and time against coverage error, of every method"
    heading = textwrap.fill(f"{trade.scene}: {trade.advice}", 100)
    return Plot(title, trade.advice, [above, below], legend, heading)


def _against(title: str, error: Column, rows: list[TradeRow]) -> Panel:
    """Plot time against an error; the rows without one stand below the others, at "none"."""
    found = [getattr(r, error.name) for r in rows if getattr(r, error.name)]
    least = min(found, default=1.0)
    most = max(found, default=least)
    most = max(most, 10 * least)
    none = 0.5 * least * (least / most) ** 0.1  # far enough below for its word
    named = [(none, "none")] if len(found) < len(rows) else []
    up = Scale(0.8 * none, 1.4 * most, "log", named, least)
    fastest, slowest = min(r.fastest for r in rows), max(r.slowest for r in rows)
    series: list[Series] = []
    best = []
    for r in rows:
        y = getattr(r, error.name) or none
        color = Method(r.method).record.color
        bar = [(r.fastest, y, ""), (r.slowest, y, "")]
        series.append(Series(color, bar, radius=0, width=4, opacity=0.4))
        series.append(_mark(r, y, getattr(r, error.best)))
        if getattr(r, error.best):
            best.append((r.seconds, y, ""))
    series.append(_BEST._replace(points=sorted(best)))
    along = "seconds; a bar is from the fastest round to the slowest"
    x = Scale(0.9 * fastest, 1.1 * slowest, "log")
    return Panel(title, along, error.head, x, up, series)


def _mark(r: TradeRow, y: float, best: bool) -> Series:
    said = ", ".join(f"{c.head} {c.show(r)}" for c in COLUMNS)
    return Series(
        Method(r.method).record.color,
        [(r.seconds, y, f"{Method(r.method).record.words}, {r.precision}, {r.size}: {said}")],
        hollow=r.precision == Precision.FLOAT32,
        radius=14 if best else 9,
    )
