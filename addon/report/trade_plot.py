"""The plot of a `Trade`: time against wrong pixels, and time against coverage error."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..methods import MEASURED, Method
from ..study.trade import Row, Trade
from . import plots

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BAND = (-0.9, 0.9)  # where the rows without a wrong pixel are, one below the other
_Error = Callable[[Row], float]
_Name = tuple[float, float, str]  # of what is at (x, y)
# Where a name may be, in points from what it names; the first that is free.
_PLACES = [(x, y) for y in (0, 16, -16, 32, -32) for x in (16, -16)]


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
    for axes, some in zip((left, right), names, strict=True):
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
    slowest, most = max(r.slowest for r in rows), max(r.wrong_pixels for r in rows)
    axes.set_yscale("symlog", linthresh=1, linscale=1.5)  # linear below 1: 0 has its place
    axes.set_ylim(_BAND[0] - 0.1, max(10.0, 4.0 * most))
    axes.set_yticks([0, *(10**k for k in range(int(np.log10(max(10, most))) + 1))])
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:,.0f}" if value else "none")
    axes.axhspan(_BAND[0] - 0.1, _BAND[1], color="#e6f2e6", zorder=0)
    fastest = min(r.fastest for r in rows)
    if slowest > 10 * fastest:
        plots.log_ticks(axes.xaxis, 0.8 * fastest, 4 * slowest)  # room for the names
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
            color=Method(r.method).color,
            lw=2,
            alpha=0.4,
        )
    _points(axes, rows, height, lambda r: r.best_pixels)
    return [(r.slowest, height(r), _name(r)) for r in rows if _is_named(r)]


def _name(r: Row) -> str:
    count = f": {r.wrong_pixels:,}" if r.wrong_pixels else ""
    return f"{Method(r.method).words}, {r.precision}{count}{', proven' * (r.method == 'certified')}"


def _is_named(row: Row) -> bool:
    return row.best_pixels or not row.wrong_pixels


def _coverage(axes: Axes, trade: Trade) -> list[_Name]:
    """Draw all rows; return the names to be written, and where."""
    plots.plain_axes(
        axes,
        "Time against coverage error\n"
        f"held against {trade.converged} × {trade.converged} rays a pixel",
        "seconds",
        "root mean square of RGBA",
    )
    seconds = [r.seconds for r in trade.rows]
    plots.log_ticks(axes.xaxis, 0.85 * min(seconds), 1.25 * max(seconds))
    errors = [r.coverage_error for r in trade.rows]
    if min(errors) > 0:
        plots.log_ticks(axes.yaxis, 0.75 * min(errors), 1.3 * max(errors))
    elif max(errors) == 0:
        axes.set_ylim(-0.05, 1)
        axes.set_yticks([0], ["none"])
    front = _points(axes, trade.rows, lambda r: r.coverage_error, lambda r: r.best_coverage)
    names = {}
    for r in front:
        rays = f", {r.samples} × {r.samples} rays each" if r.samples > 1 else ""
        name = f"{r.width} × {r.height}{rays}"
        names.setdefault(name, (r.seconds, r.coverage_error, name))
    return list(names.values())


def _points(axes: Axes, rows: list[Row], error: _Error, best: Callable[[Row], bool]) -> list[Row]:
    """Draw the rows, and the line of those that no other beats; return these, fastest first."""
    front = sorted((r for r in rows if best(r)), key=lambda r: (r.seconds, error(r)))
    line = [r.seconds for r in front], [error(r) for r in front]
    axes.plot(*line, color=plots.INK, lw=2.5, zorder=2)
    for r in rows:
        color = Method(r.method).color
        fill = color if r.precision == "float64" else "white"
        size, z, alpha = (16, 4, 1.0) if best(r) else (10, 3, 0.7)
        axes.plot(
            r.seconds, error(r), "o", ms=size, color=color, mfc=fill, mew=2.5, zorder=z, alpha=alpha
        )
    return front


def _label(axes: Axes, names: list[_Name]) -> None:
    """Write names beside their points; leave out a name that would cover another."""
    points = [
        axes.transData.transform((x, y))
        for line in axes.lines
        for x, y in zip(*line.get_data(), strict=True)
    ]
    taken, inside = [], axes.get_window_extent().padded(4)
    for x, y, text in names:
        found = []
        for dx, dy in _PLACES:
            note = axes.annotate(
                text,
                (x, y),
                (dx, dy),
                textcoords="offset points",
                ha="left" if dx > 0 else "right",
                va="center",
                fontsize=15,
                color=plots.INK,
                zorder=5,
            )
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
