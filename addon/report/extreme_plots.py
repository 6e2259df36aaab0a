"""The pictures of numerical stability: where methods break, sweeps, and maps of two scales."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ..methods import MEASURED, Method
from ..study.extremes import BreakingPoint, ExtremesRow, breaking_points, written
from ..study.scenarios.sweeps import BY_NAME, Map
from . import plots
from .tables import STUDIES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.image import AxesImage

_SAID = STUDIES["extremes"]["pictures"]
# Of the sweeps: without the literal textbook, which loses half of all rays and hides the others.
SWEPT = tuple(m for m in MEASURED if m is not Method.TEXTBOOK_LITERAL)
ACROSS = 4  # sweeps beside one another
NEVER = "#d9eedd"  # of a cell or a map where nothing goes wrong
DOUBLED = "#d5e0f0"  # where no ray is lost, but some cross too many triangles
_INKS = {NEVER: "#3d7a4a", DOUBLED: "#3a5687"}
# Of lines that cover one another, each shows inside the one before: width, size of its marks.
_WIDTHS, _SIZES = (6.0, 4.0, 2.4, 1.4), (11.0, 8.5, 6.5, 4.5)
_LEFT = -4.65  # of the scenes' names, where a column of the table is 1 wide
_CENTRED = {"ha": "center", "va": "center"}
_SLANTED = {"rotation": 45, "ha": "right", "rotation_mode": "anchor"}


def breaking_picture(rows: Sequence[ExtremesRow]) -> NDArray[np.uint8]:
    """Return a table in colour: the first scale of each sweep at which a method loses a ray.

    The later in the sweep, the paler. A plus marks methods that cross too many triangles somewhere.
    """
    points, sweeps = breaking_points(rows), by_scenario(rows)
    columns = list(dict.fromkeys((p.method, p.precision) for p in points))
    names = list(sweeps)
    figure = plots.new_figure(1920, 320 + 46 * len(names))
    axes = figure.subplots()
    axes.set_axis_off()
    axes.set_xlim(-4.7, len(columns))
    axes.set_ylim(len(names) + 2.4, -1.7)
    for y, name in enumerate(names):
        axes.text(_LEFT, y + 0.5, _title(name), va="center", fontsize=13.5)
        right = {"va": "center", "ha": "right", "color": plots.GREY, "fontsize": 11}
        axes.text(-0.12, y + 0.5, scale_of(name), **right)
    for x, (method, precision) in enumerate(columns):
        lines = Method(method).words.replace(" ", "\n").replace("–", "–\n")
        axes.text(x + 0.5, -1.0, lines, **_CENTRED, fontsize=11.5, fontweight="bold")
        axes.text(x + 0.5, -0.2, precision, **_CENTRED, fontsize=11, color=plots.GREY)
    for p in points:
        x, y = columns.index((p.method, p.precision)), names.index(p.scenario)
        _point(axes, x, y, p, list(dict.fromkeys(r.scale for r in sweeps[p.scenario])))
    _key(axes, len(names) + 0.3)
    plots.headline(figure, _SAID["breaking"], 18)
    return plots.pixels(figure)


def _point(axes: Axes, x: int, y: int, point: BreakingPoint, sweep: list[float]) -> None:
    text, color = "never", NEVER if point.doubled is None else DOUBLED
    ink = _INKS[color]
    if point.lost is not None:
        late = sweep.index(point.lost) / max(1, len(sweep) - 1)
        text, color = written(point.lost), _colormap()(0.85 - 0.8 * late)
        ink = plots.INK if late > 0.3 else "white"
    text += "" if point.doubled is None else " +"
    _cell(axes, (x + 0.03, y + 0.05, 0.94, 0.9), text, color, ink, 13.5)


def _cell(axes: Axes, box: tuple[float, ...], text: str, color: Any, ink: str, size: float) -> None:
    """Draw a coloured rectangle, (x, y, width, height), with a text in its middle."""
    from matplotlib.patches import Rectangle

    x, y, width, height = box
    axes.add_patch(Rectangle((x, y), width, height, color=color, linewidth=0))
    axes.text(x + width / 2, y + height / 2, text, **_CENTRED, color=ink, fontsize=size)


def _key(axes: Axes, y: float) -> None:
    """Explain the colours and the plus, below the table."""
    colors = {"early": _colormap()(0.3), "holds": NEVER, "doubled": DOUBLED}
    for text, (meaning, color) in zip(("1e5", "never", "never +"), colors.items(), strict=True):
        ink = _INKS.get(color, plots.INK)
        _cell(axes, (_LEFT, y + 0.05, 0.7, 0.55), text, color, ink, 12)
        axes.text(_LEFT + 0.8, y + 0.33, _SAID[meaning], va="center", fontsize=12, color=plots.GREY)
        y += 0.65


def by_scenario(rows: Sequence[ExtremesRow]) -> dict[str, list[ExtremesRow]]:
    """Return the rows of each sweep; those of maps are left out."""
    sweeps: dict[str, list[ExtremesRow]] = {}
    for row in rows:
        if row.across is None:
            sweeps.setdefault(row.scenario, []).append(row)
    return sweeps


def scale_of(scenario: str) -> str:
    """Return what a scenario's scale means, and its unit; nothing for one of a user's own."""
    return BY_NAME[scenario].scale_and_unit if scenario in BY_NAME else ""


def _title(scenario: str) -> str:
    return BY_NAME[scenario].title if scenario in BY_NAME else scenario


def _colormap() -> Colormap:
    """Return from pale yellow to dark red, with a colour for none and one for not known."""
    import matplotlib

    return matplotlib.colormaps["YlOrRd"].with_extremes(under=NEVER, bad="#dddddd")


def sweeps_picture(sweeps: Sequence[Sequence[ExtremesRow]], page: str = "") -> NDArray[np.uint8]:
    """Return small multiples: of each scenario the share of lost rays over the scale."""
    down = -(-len(sweeps) // ACROSS)
    figure = plots.new_figure(1920, 200 + 310 * down)
    grid = figure.subplots(down, ACROSS, squeeze=False).ravel()
    for axes, rows in zip(grid, sweeps, strict=False):
        _sweep(axes, rows)
    for axes in grid[len(sweeps) :]:
        axes.set_axis_off()
    handles = [
        grid[0].plot([], [], "o-", color=m.color, lw=width, ms=size, label=m.words)[0]
        for m, (width, size) in _nested().items()
    ]
    grey = {"color": plots.GREY, "lw": 2.5, "ms": 7}
    handles += grid[0].plot([], [], "o-", label="float64", **grey)
    handles += grid[0].plot([], [], "o:", label="float32", mfc="white", **grey)
    plots.legend_below(figure, handles)
    title = f"{_SAID['lost']}{page and f' ({page})'}\n{_SAID['nested']}"
    plots.headline(figure, title, 14)
    return plots.pixels(figure)


def _nested() -> dict[Method, tuple[float, float]]:
    """Return the width of each method's line, and the size of its marks."""
    at = np.linspace(0, len(_WIDTHS) - 1, len(SWEPT))
    ends = (np.interp(at, range(len(_WIDTHS)), v).tolist() for v in (_WIDTHS, _SIZES))
    return dict(zip(SWEPT, zip(*ends, strict=True), strict=True))


def _sweep(axes: Axes, rows: Sequence[ExtremesRow]) -> None:
    """Draw one scenario; its scales are steps, each as wide as the next."""
    name = rows[0].scenario
    scales = list(dict.fromkeys(r.scale for r in rows))
    shown = [r for r in rows if r.method in SWEPT]
    plots.plain_axes(axes, _title(name), scale_of(name), "", plots.SMALL)
    for method, precision in dict.fromkeys((r.method, r.precision) for r in shown):
        some = [r for r in shown if (r.method, r.precision) == (method, precision)]
        color, whole = Method(method).color, precision == "float64"
        width, size = _nested()[method]
        style = {"color": color, "mfc": color if whole else "white", "mew": 1.5, "clip_on": False}
        style |= {"lw": width, "ms": size}
        at = [scales.index(r.scale) for r in some]
        shares = [100 * r.share for r in some]
        axes.plot(at, shares, "o-" if whole else "o:", zorder=3 + SWEPT.index(method), **style)
    if not any(r.lost for r in shown):
        most = max(r.doubled / r.rays for r in shown)
        note = "no ray is lost"
        note += f"\nup to {100 * most:.0f} % cross too many triangles" if most else ""
        axes.text(0.5, 0.5, note, transform=axes.transAxes, **_CENTRED, fontsize=12)
    axes.set_ylim(0, 100)
    axes.set_yticks([0, 50, 100], ["0 %", "50 %", "100 %"])
    axes.set_xticks(range(len(scales)), [written(s) for s in scales], **_SLANTED)


def map_picture(some: Map, rows: Sequence[ExtremesRow]) -> NDArray[np.uint8]:
    """Return heat maps over two scales of the share of lost rays, one for each method."""
    columns = [m for m in MEASURED if any(r.method == m for r in rows)]
    precisions = [p for p in ("float64", "float32") if any(r.precision == p for r in rows)]
    figure = plots.new_figure()
    grid = figure.subplots(len(precisions), len(columns), squeeze=False, sharex=True, sharey=True)
    images = [
        _heat(axes, [r for r in rows if (r.method, r.precision) == (method, precision)])
        for precision, line in zip(precisions, grid, strict=True)
        for method, axes in zip(columns, line, strict=True)
    ]
    figure.supxlabel(some.rows[0].scale_name, fontsize=15)
    figure.supylabel(some.across_name, fontsize=15)
    plots.headline(
        figure,
        f"{some.title}: rays that are missed or see the wrong surface\n{some.explanation}\n"
        f"Green: none.{' Grey: rounding has left nothing to see.' * any(map(_is_grey, rows))}",
    )
    bar = figure.colorbar(next(i for i in images if i), ax=grid, shrink=0.8)
    bar.set_ticks([0.01, 0.1, 0.25, 0.5, 1], labels=["1 %", "10 %", "25 %", "50 %", "100 %"])
    bar.ax.tick_params(labelsize=13)
    return plots.pixels(figure)


def _is_grey(row: ExtremesRow) -> bool:
    return not (row.seen or row.lost)


def _heat(axes: Axes, rows: Sequence[ExtremesRow]) -> AxesImage | None:
    """Draw the map of one method; nothing where there are no rows."""
    from matplotlib.colors import PowerNorm

    if not rows:
        axes.set_axis_off()
        return None
    scales, others = (
        list(dict.fromkeys(getattr(r, of) for r in rows)) for of in ("scale", "across")
    )
    cells = np.full((len(others), len(scales)), np.nan)
    for r in rows:
        if not _is_grey(r):
            cells[others.index(r.across), scales.index(r.scale)] = r.share
    norm = PowerNorm(0.5, vmin=0.5 / max(r.rays for r in rows), vmax=1)  # below a ray: none
    image = axes.imshow(np.ma.masked_invalid(cells), cmap=_colormap(), norm=norm, aspect="auto")
    title = f"{Method(rows[0].method).words}, {rows[0].precision}"
    axes.set_title(title, fontsize=14, color=plots.INK)
    axes.set_xticks(range(len(scales)), [written(s) for s in scales], **_SLANTED)
    axes.set_yticks(range(len(others)), [written(o) for o in others])
    axes.tick_params(labelsize=11, length=0)
    axes.spines[:].set_visible(False)
    return image
