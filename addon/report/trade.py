"""A `Trade` -> a table, `tradeoff.json`, and the plot of time against error.

The plot shows time against wrong pixels, and time against coverage error.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..methods import MEASURED, Method
from ..study.trade import Trade, TradeRow
from ..tracer.settings import Precision
from . import plots
from .folders import finite, replacing, write_json
from .tables import STUDIES, columns

SCHEMA = "reference_tracer.tradeoff/1"
TABLE, JSON, PLOT = "tradeoff.txt", "tradeoff.json", "tradeoff.svg"

_SAID = STUDIES["tradeoff"]
_HEAD = (
    *("method", "precision", "seconds", "(min - max)"),
    *("wrong pixels  ", "t error, m", "MiB", "coverage  "),
)
_NAME = 25.0  # size of a name's letters
# Where a name may be, in pixels from what it names; the first that is free.
_PLACES = [(x, y) for y in (0, 27, -27, 54, -54) for x in (27, -27)]


def table(trade: Trade) -> str:
    """Return the rows as text, a block for each size; a star marks those that no other beats."""
    counts = [(f"{r.wrong_pixels:,}", f"({r.wrong_pixels / r.pixels:.2%})") for r in trade.rows]
    blocks: dict[str, list[list[str]]] = {}
    for r, wrong in zip(trade.rows, columns(counts, left=(), gap=" "), strict=True):
        rays = "one ray" if r.samples == 1 else f"{r.samples} x {r.samples} rays"
        title = f"{r.width} x {r.height} pixels, {rays} each"
        blocks.setdefault(title, []).append(_cells(r, wrong))
    lines = [line for title, rows in blocks.items() for line in ("", title, *rows)]
    note = _SAID["note"].format(k=trade.converged)
    return "\n".join([*columns([_HEAD, *lines], left=(0, 1, 3), gap=" "), note, trade.advice])


def _cells(r: TradeRow, wrong: str) -> list[str]:
    pixels, coverage = (" *" if best else "  " for best in (r.best_pixels, r.best_coverage))
    t_error = "-" if r.largest_t_error is None else f"{r.largest_t_error:.1e}"
    return [
        *(r.method, r.precision, f"{r.seconds:.4f}", f"({r.fastest:.4f} - {r.slowest:.4f})"),
        *(wrong + pixels, t_error, f"{r.peak_bytes / 2**20:.1f}"),
        f"{r.coverage_error:.4f}{coverage}",
    ]


def to_dict(trade: Trade) -> dict[str, Any]:
    """Return what `tradeoff.json` holds."""
    return {
        "schema": SCHEMA,
        "scene": trade.scene,
        "advice": trade.advice,
        "converged_samples": trade.converged,
        "units": _SAID["units"],
        "rows": [_row(r) for r in trade.rows],
    }


def _row(r: TradeRow) -> dict[str, Any]:
    held = vars(r) | {"fastest": r.fastest, "slowest": r.slowest, "best": r.best}
    del held["rounds"]
    return held | {n: finite(held[n]) for n in ("largest_t_error", "coverage_error")}


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
        (new / PLOT).write_text(pictures(trade)["tradeoff"], encoding="utf-8")


def pictures(trade: Trade) -> dict[str, str]:
    """Return the name and the SVG of the one picture that there is.

    Wrong pixels are those of the methods side by side, coverage errors those of all rows. A line
    joins what no other row beats.
    """
    said, room = f"{trade.scene or 'Trade'}: {trade.advice}", plots.WIDTH - 40
    headlines = ("\n".join(textwrap.wrap(said, letters)) for letters in range(104, 0, -1))
    headline = next(lines for lines in headlines if plots.width_of(lines, 28) <= room)
    height = 35 * (1 + headline.count("\n"))
    top = 130 + height
    entries = {m.record.words: plots.mark((0, 0), 13, m.record.color) for m in MEASURED}
    entries |= {p: plots.mark((0, 0), 13, plots.GREY, p == "float32") for p in Precision}
    entries["no other beats these"] = plots.line([(-16, 0), (16, 0)], plots.INK, 4)
    inside = plots.text((20, 15 + height / 2), headline, 28)
    inside += _wrong_pixels(trade, (155, top, 790, plots.HEIGHT - 155 - top))
    inside += _coverage(trade, (1105, top, 770, plots.HEIGHT - 155 - top))
    inside += plots.legend(entries, plots.HEIGHT - 30)
    title = "Time against wrong pixels, and time against coverage error, of every method"
    return {"tradeoff": plots.picture(plots.WIDTH, plots.HEIGHT, title, trade.advice, inside)}


def _wrong_pixels(trade: Trade, box: tuple[float, ...]) -> str:
    """Draw the methods side by side; those without a wrong pixel in a band, one below the other."""
    rows, (_, _, width, height) = trade.whole, box
    right = sorted((r for r in rows if not r.wrong_pixels), key=lambda r: r.seconds)
    top = max(10.0, 4.0 * max(r.wrong_pixels for r in rows))
    share = 34 * (len(right) + 1) / height  # of the height that the band has
    low = top ** (share / (share - 1))
    ticks = {low**0.55: "none", **{10**k: f"{10**k:,}" for k in range(int(np.log10(top)) + 1)}}
    places = (low ** np.linspace(0.1, 1, len(right) + 2))[1:-1].tolist()
    points = list(zip(right, places, strict=True))
    points += [(r, r.wrong_pixels) for r in rows if r.wrong_pixels]
    fastest, slowest = min(r.fastest for r in rows), max(r.slowest for r in rows)
    log = slowest > 10 * fastest
    start, end = 0.8 * fastest if log else 0.0, 1.1 * slowest
    named = [(r, y) for r, y in points if r.best_pixels or not r.wrong_pixels]
    for r, _ in named:  # room for its name
        part = 1 - min(0.8, (plots.width_of(_name(r), _NAME) + 40) / width)
        end = max(end, start * (r.slowest / start) ** (1 / part) if log else r.slowest / part)
    x = plots.logarithmic(start, end) if log else plots.linear(start, end)
    axes = plots.Axes(*box, x, plots.Scale(low, top, ticks, log=True))
    title = f"Time against wrong pixels\n{rows[0].width} × {rows[0].height} pixels, one ray each"
    (left, edge), (_, bottom) = axes.at(start, low**0.1), axes.at(start, low)
    out = plots.cell(left, edge, width, bottom - edge, "#e6f2e6")
    x_label = "seconds; the bar is from the fastest round to the slowest"
    out += axes.drawn(title, x_label, "wrong pixels")
    for r, y in points:
        bar = axes.at(r.fastest, y), axes.at(r.slowest, y)
        out += plots.line(bar, Method(r.method).record.color, 4, opacity=0.4)
    names = {_name(r): axes.at(r.slowest, y) for r, y in named}
    return out + _points(axes, points, "best_pixels", names)


def _name(r: TradeRow) -> str:
    count = f": {r.wrong_pixels:,}" if r.wrong_pixels else ""
    return f"{Method(r.method).record.words}, {r.precision}{count}{', proven' * (r.method == 'certified')}"


def _coverage(trade: Trade, box: tuple[float, ...]) -> str:
    """Draw all rows."""
    points = [(r, r.coverage_error) for r in trade.rows if np.isfinite(r.coverage_error)]
    points.sort(key=lambda p: (p[0].seconds, p[1]))
    least, most = min(y for _, y in points), max(y for _, y in points)
    y = (
        plots.logarithmic(0.75 * least, 1.3 * most)
        if least
        else plots.linear(-0.1 * most, 1.1 * most or 1)
    )
    x = plots.logarithmic(0.85 * points[0][0].seconds, 1.25 * points[-1][0].seconds)
    axes, k = plots.Axes(*box, x, y), trade.converged
    title = f"Time against coverage error\nheld against {k} × {k} rays a pixel"
    best = [(r, y) for r, y in reversed(points) if r.best_coverage]
    names = {_size(r): axes.at(r.seconds, y) for r, y in best}  # each beside its fastest row
    drawn = axes.drawn(title, "seconds", "root mean square of RGBA")
    return drawn + _points(axes, points, "best_coverage", names)


def _size(r: TradeRow) -> str:
    rays = f", {r.samples} × {r.samples} rays" if r.samples > 1 else ""
    return f"{r.width} × {r.height}{rays}"


def _points(
    axes: plots.Axes, points: list[tuple[TradeRow, float]], best: str, names: dict[str, plots.Place]
) -> str:
    """Draw rows, names, and the line of the rows that no other beats; `best` is their field."""
    places = [(getattr(r, best), axes.at(r.seconds, y), r) for r, y in points]
    front = sorted(at for is_best, at, _ in places if is_best)
    out = plots.line(front, plots.INK, 4)
    for is_best, at, r in sorted(places, key=lambda p: p[0]):
        wrong = f"{r.wrong_pixels:,} wrong pixels, coverage error {r.coverage_error:.4g}"
        title = f"{Method(r.method).record.words}, {r.precision}, {_size(r)}: {r.seconds:.4g} s, {wrong}"
        size, alpha = (14, 1.0) if is_best else (9, 0.7)
        color, hollow = Method(r.method).record.color, r.precision == "float32"
        out += plots.mark(at, size, color, hollow, title, opacity=alpha)
    on_line = np.linspace(front[:-1], front[1:], 9).reshape(-1, 2).tolist()
    return out + _named(axes, names, [*(at for _, at, _ in places), *on_line])


def _named(axes: plots.Axes, names: dict[str, plots.Place], points: list[plots.Place]) -> str:
    """Write names beside their points; leave out a name that would cover another."""
    right, bottom = axes.left + axes.width, axes.top + axes.height
    out, taken, half = "", [], 0.6 * _NAME
    for words, (x, y) in names.items():
        wide = plots.width_of(words, _NAME)
        starts = [(x + dx - wide * (dx < 0), y + dy) for dx, dy in _PLACES]
        boxes = [(left, y - half, left + wide, y + half) for left, y in starts]
        boxes = [b for b in boxes if axes.left < b[0] and b[2] < right and b[3] < bottom]
        free = [b for b in boxes if not _over(b, taken)]
        if free:
            box = min(free, key=lambda box: _over(box, [(*p, *p) for p in points]))
            taken.append(box)
            at, anchor = (box[0], "start") if box[0] > x else (box[2], "end")
            out += plots.text((at, box[1] + half), words, _NAME, anchor=anchor)
    return out


def _over(box: Sequence[float], others: list[tuple[float, ...]]) -> int:
    """Return how many others a box covers."""
    left, top, right, bottom = box
    return sum(left < o[2] and o[0] < right and top < o[3] and o[1] < bottom for o in others)
