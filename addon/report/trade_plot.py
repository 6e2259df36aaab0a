"""The plot of a `Trade`: time against wrong pixels, and time against coverage error."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..study.trade import NAMES, Row, Trade
from . import plots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_GREY = "#666666"
_BAND = (-0.9, 0.9)  # where the rows without a wrong pixel are, one below the other
_Error = Callable[[Row], float]


def picture(trade: Trade) -> NDArray[np.uint8]:
    """Return the plot, (h, w, 4) sRGB, row 0 at the bottom.

    Time against wrong pixels, for the methods side by side; time against coverage error, for all
    rows. A line joins those that no other beats.

    Raises
    ------
    MissingLibraryError
        If Matplotlib is not installed.
    """
    figure = plots.new_figure()
    left, right = figure.subplots(1, 2)
    _wrong_pixels(left, trade)
    _coverage(right, trade)
    labels = {NAMES[m]: {"color": plots.METHOD_COLORS[m]} for m in plots.METHOD_COLORS}
    labels |= {"float64": {"color": _GREY}, "float32": {"color": _GREY, "mfc": "white"}}
    handles = [
        left.plot([], [], "o", markersize=13, mew=2.5, label=label, **style)[0]
        for label, style in labels.items()
    ]
    handles += left.plot([], [], color=plots.INK, lw=2.5, label="no other beats these")
    figure.legend(
        handles=handles,
        loc="outside lower center",
        ncols=len(handles),
        fontsize=14,
        frameon=False,
        columnspacing=1.4,
        handletextpad=0.2,
    )
    figure.suptitle(_broken(trade.advice), fontsize=17, color=plots.INK, x=0.01, ha="left")
    return plots.pixels(figure)


def _wrong_pixels(axes: Axes, trade: Trade) -> None:
    rows = trade.whole
    plots.plain_axes(
        axes,
        f"Time against wrong pixels\n{rows[0].width} × {rows[0].height} pixels, one ray each",
        "seconds; the bar is from the fastest round to the slowest",
        "wrong pixels",
    )
    slowest, most = max(r.slowest for r in rows), max(r.wrong_pixels for r in rows)
    axes.set_yscale("symlog", linthresh=1, linscale=1.5)  # linear below 1: 0 has its place
    axes.set_ylim(_BAND[0] - 0.1, max(10.0, 4.0 * most))
    axes.set_yticks([0, *(10**k for k in range(int(np.log10(max(10, most))) + 1))])
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:,.0f}" if value else "none")
    axes.axhspan(_BAND[0] - 0.1, _BAND[1], color="#e6f2e6", zorder=0)
    if slowest > 10 * min(r.fastest for r in rows):
        plots.log_ticks(axes.xaxis)
    else:
        named = max((r.slowest for r in rows if _is_named(r)), default=0.0)
        axes.set_xlim(0, max(1.1 * slowest, 1.8 * named))  # room for the names
    right = sorted((r for r in rows if not r.wrong_pixels), key=lambda r: r.seconds)
    places = np.linspace(_BAND[1], _BAND[0], len(right) + 2)[1:-1].tolist()
    place = {id(r): y for r, y in zip(right, places, strict=True)}

    def height(r: Row) -> float:
        return place.get(id(r), r.wrong_pixels)

    for r in rows:
        axes.plot(
            [r.fastest, r.slowest],
            [height(r)] * 2,
            color=plots.METHOD_COLORS[r.method],
            lw=2,
            alpha=0.4,
        )
    _points(axes, rows, height, lambda r: r.best_pixels)
    for r in rows:
        if _is_named(r):
            count = f": {r.wrong_pixels:,}" if r.wrong_pixels else ""
            proven = ", proven" if r.method == "certified" else ""
            name = f"{NAMES[r.method]}, {r.precision}{count}{proven}"
            _label(axes, r.slowest, height(r), name)


def _is_named(row: Row) -> bool:
    return row.best_pixels or not row.wrong_pixels


def _coverage(axes: Axes, trade: Trade) -> None:
    plots.plain_axes(
        axes,
        "Time against coverage error\n"
        f"held against {trade.converged} × {trade.converged} rays a pixel",
        "seconds",
        "root mean square of RGBA",
    )
    plots.log_ticks(axes.xaxis)
    seconds = [r.seconds for r in trade.rows]
    axes.set_xlim(0.85 * min(seconds), 1.25 * max(seconds))
    errors = [r.coverage_error for r in trade.rows]
    if min(errors) > 0:
        plots.log_ticks(axes.yaxis)
        axes.set_ylim(0.75 * min(errors), 1.3 * max(errors))
    front = _points(axes, trade.rows, lambda r: r.coverage_error, lambda r: r.best_coverage)
    named = set()
    for r in front:
        if (r.width, r.samples) not in named:
            named.add((r.width, r.samples))
            rays = f", {r.samples} × {r.samples} rays each" if r.samples > 1 else ""
            name = f"{r.width} × {r.height}{rays}"
            _label(axes, r.seconds, r.coverage_error, name, up=16)


def _points(axes: Axes, rows: list[Row], error: _Error, best: Callable[[Row], bool]) -> list[Row]:
    """Draw the rows, and the line of those that no other beats; returns these, fastest first."""
    front = sorted((r for r in rows if best(r)), key=lambda r: (r.seconds, error(r)))
    line = [r.seconds for r in front], [error(r) for r in front]
    axes.plot(*line, color=plots.INK, lw=2.5, zorder=2)
    for r in rows:
        color = plots.METHOD_COLORS[r.method]
        fill = color if r.precision == "float64" else "white"
        size, z, alpha = (16, 4, 1.0) if best(r) else (10, 3, 0.7)
        axes.plot(
            r.seconds, error(r), "o", ms=size, color=color, mfc=fill, mew=2.5, zorder=z, alpha=alpha
        )
    return front


def _label(axes: Axes, x: float, y: float, text: str, up: float = 0) -> None:
    """Write beside a point: right of it and `up` points, or left and down where it is far right."""
    place = axes.transAxes.inverted().transform(axes.transData.transform((x, y)))
    left = place[0] > 0.57
    note = axes.annotate(
        text,
        (x, y),
        (-16, -up) if left else (16, up),
        textcoords="offset points",
        ha="right" if left else "left",
        va="center",
        fontsize=15,
        color=plots.INK,
        zorder=5,
    )
    note.set_in_layout(False)


def _broken(sentence: str) -> str:
    """Return the advice in two lines, broken where its second half begins."""
    return sentence.replace("; ", ";\n", 1)
