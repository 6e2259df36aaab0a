"""A `Trade` -> a table, `tradeoff.json`, and the plot of time against error.

The plot shows time against wrong pixels, and time against coverage error.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import images
from ..methods import MEASURED, Method
from ..study.trade import Trade, TradeRow
from . import plots
from .folders import finite, replacing, write_json
from .tables import STUDIES, columns

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SCHEMA = "reference_tracer.tradeoff/1"
TABLE, JSON, PLOT = "tradeoff.txt", "tradeoff.json", "tradeoff.png"

_SAID = STUDIES["tradeoff"]
_HEAD = (
    *("method", "precision", "seconds", "(min - max)"),
    *("wrong pixels  ", "t error, m", "MiB", "coverage  "),
)
_BAND = (-0.9, 0.9)  # of the plot, where rows without a wrong pixel are, one below the other
# Where a name may be, in points from what it names; the first that is free.
_PLACES = [(x, y) for y in (0, 16, -16, 32, -32) for x in (16, -16)]
_Name = tuple[float, float, str]  # of what is at (x, y)


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
    """Write `tradeoff.txt`, `tradeoff.json` and `tradeoff.png`, all or none, in a folder.

    Raises
    ------
    MissingLibraryError
        If there can be no plot. The table and the JSON are there all the same.
    OSError
        If the folder cannot be written.
    """
    with replacing(Path(directory), (TABLE, PLOT, JSON)) as new:
        (new / TABLE).write_text(table(trade) + "\n", encoding="utf-8")
        write_json(new / JSON, to_dict(trade))
        images.save_png(new / PLOT, plot_picture(trade))


def pictures(trade: Trade) -> Iterator[tuple[str, NDArray[np.uint8]]]:
    """Yield the name and pixels of the one picture that there is, as :func:`plot_picture`."""
    yield "tradeoff", plot_picture(trade)


def plot_picture(trade: Trade) -> NDArray[np.uint8]:
    """Return the plot, (h, w, 4) sRGB, row 0 at the bottom.

    Wrong pixels are those of the methods side by side, coverage errors those of all rows. A line
    joins what no other row beats.

    Raises
    ------
    MissingLibraryError
        If Matplotlib is not installed.
    """
    figure = plots.new_figure()
    both = left, right = figure.subplots(1, 2)
    names = _wrong_pixels(left, trade), _coverage(right, trade)
    labels = {m.words: {"color": m.color} for m in MEASURED}
    labels |= {"float64": {"color": plots.GREY}, "float32": {"color": plots.GREY, "mfc": "white"}}
    handles = [
        left.plot([], [], "o", markersize=13, mew=2.5, label=label, **style)[0]
        for label, style in labels.items()
    ]
    handles += left.plot([], [], color=plots.INK, lw=2.5, label="no other beats these")
    plots.legend_below(figure, handles)
    title = f"{trade.scene or 'Trade'}: {trade.advice}"
    plots.headline(figure, textwrap.fill(title, 132))  # in lines as long as the picture is wide
    figure.draw_without_rendering()  # puts all in its place
    figure.set_layout_engine("none")
    for axes, some in zip(both, names, strict=True):
        _label(axes, some)
    return plots.pixels(figure)


def _wrong_pixels(axes: Axes, trade: Trade) -> list[_Name]:
    """Draw the methods side by side; return the names to be written, and where."""
    rows = trade.whole
    plots.plain_axes(
        axes,
        f"Time against wrong pixels\n{rows[0].width} × {rows[0].height} pixels, one ray each",
        "seconds; the bar is from the fastest round to the slowest",
        "wrong pixels",
    )
    most = max(r.wrong_pixels for r in rows)
    axes.set_yscale("symlog", linthresh=1, linscale=1.5)  # linear below 1: 0 has its place
    axes.set_ylim(_BAND[0] - 0.1, max(10.0, 4.0 * most))
    axes.set_yticks([0, *(10**k for k in range(int(np.log10(max(10, most))) + 1))])
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:,.0f}" if value else "none")
    axes.axhspan(_BAND[0] - 0.1, _BAND[1], color="#e6f2e6", zorder=0)
    fastest, slowest = min(r.fastest for r in rows), max(r.slowest for r in rows)
    if slowest > 10 * fastest:
        plots.log_ticks(axes.xaxis, 0.8 * fastest, 4 * slowest)  # room for the names
    else:
        named = max((r.slowest for r in rows if _is_named(r)), default=0.0)
        axes.set_xlim(0, max(1.1 * slowest, 1.8 * named))  # room for the names
    right = sorted((r for r in rows if not r.wrong_pixels), key=lambda r: r.seconds)
    places = np.linspace(_BAND[1], _BAND[0], len(right) + 2)[1:-1].tolist()
    place = dict(zip(map(id, right), places, strict=True))
    heights = [place.get(id(r), r.wrong_pixels) for r in rows]
    for r, y in zip(rows, heights, strict=True):
        axes.plot([r.fastest, r.slowest], [y, y], color=Method(r.method).color, lw=2, alpha=0.4)
    _points(axes, rows, heights, "best_pixels")
    return [(r.slowest, y, _name(r)) for r, y in zip(rows, heights, strict=True) if _is_named(r)]


def _name(r: TradeRow) -> str:
    count = f": {r.wrong_pixels:,}" if r.wrong_pixels else ""
    return f"{Method(r.method).words}, {r.precision}{count}{', proven' * (r.method == 'certified')}"


def _is_named(row: TradeRow) -> bool:
    return row.best_pixels or not row.wrong_pixels


def _coverage(axes: Axes, trade: Trade) -> list[_Name]:
    """Draw all rows; return the names to be written, and where."""
    k = trade.converged
    title = f"Time against coverage error\nheld against {k} × {k} rays a pixel"
    plots.plain_axes(axes, title, "seconds", "root mean square of RGBA")
    seconds = [r.seconds for r in trade.rows]
    plots.log_ticks(axes.xaxis, 0.85 * min(seconds), 1.25 * max(seconds))
    errors = [r.coverage_error for r in trade.rows]
    if min(errors) > 0:
        plots.log_ticks(axes.yaxis, 0.75 * min(errors), 1.3 * max(errors))
    elif max(errors) == 0:
        axes.set_ylim(-0.05, 1)
        axes.set_yticks([0], ["none"])
    _points(axes, trade.rows, errors, "best_coverage")
    names = {}
    for r in sorted(trade.rows, key=lambda r: (r.seconds, r.coverage_error)):
        rays = f", {r.samples} × {r.samples} rays each" if r.samples > 1 else ""
        name = f"{r.width} × {r.height}{rays}"
        if r.best_coverage:
            names.setdefault(name, (r.seconds, r.coverage_error, name))
    return list(names.values())


def _points(axes: Axes, rows: list[TradeRow], errors: Sequence[float], best: str) -> None:
    """Draw the rows, and the line of those that no other beats; `best` says by a row's field."""
    ordered = sorted(zip((r.seconds for r in rows), errors, rows, strict=True), key=lambda p: p[:2])
    front = [(x, y) for x, y, r in ordered if getattr(r, best)]
    axes.plot([x for x, _ in front], [y for _, y in front], color=plots.INK, lw=2.5, zorder=2)
    for r, y in zip(rows, errors, strict=True):
        color = Method(r.method).color
        style = {"color": color, "mfc": color if r.precision == "float64" else "white", "mew": 2.5}
        size, z, alpha = (16, 4, 1.0) if getattr(r, best) else (10, 3, 0.7)
        axes.plot(r.seconds, y, "o", ms=size, zorder=z, alpha=alpha, **style)


def _label(axes: Axes, names: list[_Name]) -> None:
    """Write names beside their points; leave out a name that would cover another."""
    points = [p for line in axes.lines for p in axes.transData.transform(line.get_xydata())]
    taken, inside = [], axes.get_window_extent().padded(4)
    for x, y, text in names:
        found = []
        for dx, dy in _PLACES:
            style = {"ha": "left" if dx > 0 else "right", "va": "center", "color": plots.INK}
            style |= {"textcoords": "offset points", "fontsize": 15, "zorder": 5}
            note = axes.annotate(text, (x, y), (dx, dy), **style)
            note.set_in_layout(False)
            box = note.get_window_extent()
            free = box.x1 < inside.x1 and box.x0 > inside.x0
            free = free and not any(box.overlaps(other) for other in taken)
            found.append((not free, sum(box.contains(*p) for p in points), len(found), note, box))
        blocked, _, _, best, box = min(found, key=lambda f: f[:3])
        for *_, note, _ in found:
            if blocked or note is not best:
                note.remove()
        if not blocked:
            taken.append(box)
