"""The plot of a `Bench`: time against triangles for ours and the peers, and stages by scene."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from reference_tracer.methods import Method
from reference_tracer.report import plots

from .rows import Bench, Row
from .scenes import SCALED

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# What a row has, what it is called, its colour and its mark.
_LINES = (
    ("trace_s", "certified", Method.CERTIFIED.color, "o"),
    ("plain_s", "Möller–Trumbore", Method.MOLLER_TRUMBORE.color, "o"),
    ("embreex_trace_s", "embreex, trace", "#d55e00", "s"),
    ("embreex_both_s", "embreex, build + trace", "#e69f00", "s"),
    ("bvhtree_s", "BVHTree", "#8c8c8c", "^"),
    ("cycles_s", "Cycles, 1 sample", "#56b4e9", "D"),
    ("workbench_s", "Workbench", "#009e73", "D"),
    ("rtree_s", "trimesh's rtree", "#444444", "v"),
)
_STAGES = (
    *("#7a3d9a", "#0072b2", "#009e73", "#e69f00", "#d55e00", "#56b4e9", "#b0723a", "#cc79a7"),
    *("#4d4d4d", "#b8a9d9", "#8fd3bd"),
)
_OTHER = "#d9d9d9"
_NAMES_TAKE = 0.72  # of the width that the lines have: room for the longest name


def picture(bench: Bench) -> NDArray[np.uint8]:
    """Return the plot, (h, w, 4) sRGB, row 0 at the bottom.

    Left, of the icospheres where there are two or more, else of all scenes: time against the number
    of triangles. Right, of every scene, what each stage of a certified frame takes. Both through
    the perspective camera at the largest size that was measured.

    Raises
    ------
    MissingLibraryError
        If Matplotlib is not installed.
    ValueError
        If nothing was measured.
    """
    rows = largest(bench)
    figure = plots.new_figure()
    left, right = figure.subplots(1, 2, width_ratios=(1.15, 1))
    spheres = [r for r in rows if r.scene in SCALED]
    _growth(left, spheres if len(spheres) > 1 else rows, _plain(bench), len(spheres) > 1)
    _stages(right, rows)
    cores = "one core" if bench.machine.get("one_core") else "not kept on one core"
    plots.headline(
        figure,
        f"{rows[0].width} × {rows[0].height} pixels, {rows[0].camera}, "
        f"{bench.machine.get('processor') or 'unknown processor'}, {cores}",
    )
    return plots.pixels(figure)


def largest(bench: Bench) -> list[Row]:
    """Return certified's rows of the size that most scenes can be seen at, the larger if equal."""
    rows = [r for r in bench.rows if r.method == "certified" and r.trace_s]
    if not rows:
        raise ValueError("nothing was measured: there is nothing to plot")
    groups: dict[tuple, list[Row]] = {}
    for r in rows:
        groups.setdefault((r.camera == "perspective", r.pixels), []).append(r)
    many = max(len(group) for group in groups.values())
    return groups[max(key for key, group in groups.items() if 2 * len(group) >= many)]


def _plain(bench: Bench) -> dict[tuple, float]:
    """Return Möller–Trumbore's seconds by scene, size and camera."""
    return {r.key[:4]: r.trace_s for r in bench.rows if r.method == "moller_trumbore" and r.trace_s}


def _seconds(row: Row, name: str, plain: dict[tuple, float]) -> float | None:
    if name == "plain_s":
        return plain.get(row.key[:4])
    if name == "embreex_both_s":
        parts = row.embreex_trace_s, row.embreex_build_s
        return sum(parts) if None not in parts else None
    return getattr(row, name)


def _growth(axes: Axes, rows: list[Row], plain: dict[tuple, float], joined: bool) -> None:
    plots.plain_axes(
        axes,
        "Time against triangles" + (", of one sphere" if joined else ""),
        "triangles",
        "seconds",
    )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_major_formatter(lambda value, _: _number(value))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    ends = []
    for name, label, color, mark in _LINES:
        found = sorted((r.triangles, s) for r in rows if (s := _seconds(r, name, plain)))
        if found:
            ours = name in ("trace_s", "plain_s")
            axes.plot(
                *zip(*found, strict=True),
                mark,
                ls="-" if joined else "",
                color=color,
                lw=4 if ours else 2.5,
                ms=12 if ours else 9,
                zorder=4 if ours else 3,
                label=label,
            )
            ends.append((*found[-1], label, color))
    if joined:
        _name(axes, ends)
    else:
        axes.legend(fontsize=14, frameon=False, ncols=2)


def _name(axes: Axes, ends: list[tuple[float, float, str, str]]) -> None:
    """Write each line's name in a column at the right, no two over one another."""
    low, high = np.log(axes.get_ylim())
    far = max(x for x, *_ in ends)
    axes.set_xlim(right=far * (far / axes.get_xlim()[0]) ** _NAMES_TAKE)
    axes.xaxis.set_major_formatter(lambda x, _: _number(x) if x < 3 * far else "")
    step, below = 0.05 * (high - low), -np.inf
    for x, y, label, color in sorted(ends, key=lambda end: end[1]):
        at = below = max(np.log(y), below + step)
        note = axes.annotate(
            label,
            (x, y),
            (far * (far / axes.get_xlim()[0]) ** 0.035, np.exp(at)),
            textcoords="data",
            color=color,
            fontsize=15,
            fontweight="bold",
            va="center",
            arrowprops={"arrowstyle": "-", "color": color, "alpha": 0.4},
        )
        note.set_in_layout(False)


def _stages(axes: Axes, rows: list[Row]) -> None:
    plots.plain_axes(axes, "Where the time of a certified frame goes", "seconds", "")
    names = list(dict.fromkeys(name for r in rows for name in r.stages))
    colors = dict(zip(names, _STAGES * (1 + len(names) // len(_STAGES)), strict=False))
    places = range(len(rows), 0, -1)
    for place, r in zip(places, rows, strict=True):
        whole, start = r.render_s or 0.0, 0.0
        for name, seconds in r.stages.items():
            axes.barh(place, seconds, left=start, color=colors[name], height=0.7)
            start += seconds
        axes.barh(place, max(0.0, whole - start), left=start, color=_OTHER, height=0.7)
        axes.annotate(
            f" {whole:.3g} s", (max(whole, start), place), va="center", fontsize=14, color=plots.INK
        )
    axes.set_yticks(list(places), [f"{r.scene}\n{_number(r.triangles)}" for r in rows])
    axes.margins(x=0.15)
    axes.grid(False, axis="y")
    handles = [
        axes.barh([0], [0], color=color, label=name)
        for name, color in (colors | {"other": _OTHER}).items()
    ]
    axes.set_ylim(0.4, len(rows) + 0.6)
    axes.legend(
        handles=handles,
        fontsize=14,
        frameon=False,
        loc="upper center",
        ncols=4,
        bbox_to_anchor=(0.45, -0.09),
    )


def _number(value: float) -> str:
    """Return a number in few characters: 12, 5 k, 1.3 M."""
    for size, letter in ((1e6, " M"), (1e3, " k")):
        if value >= size:
            return (
                f"{value / size:.2g}{letter}"
                if value < 100 * size
                else f"{value / size:.0f}{letter}"
            )
    return f"{value:g}"
