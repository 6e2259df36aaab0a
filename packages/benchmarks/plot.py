"""The plot of a `Bench`, by matplotlib: time against triangles, and stages by scene."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from reference_tracer.methods import Method

from .peers import missing
from .rows import Bench, Row
from .scenes import SCALED

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# What a row has, what it is called, its colour and its mark.
_LINES = (
    ("trace_s", "certified", Method.CERTIFIED.record.color, "o"),
    ("plain_s", "Möller–Trumbore", Method.MOLLER_TRUMBORE.record.color, "o"),
    ("embreex_trace_s", "embreex, trace", "#d55e00", "s"),
    ("embreex_both_s", "embreex, build + trace", "#e69f00", "s"),
    ("bvhtree_s", "BVHTree", "#8c8c8c", "^"),
    ("cycles_s", "Cycles, 1 sample", "#56b4e9", "D"),
    ("workbench_s", "Workbench", "#009e73", "D"),
    ("rtree_s", "trimesh's rtree", "#444444", "v"),
)
_SIZE = 14.0, 7.0  # inches
_COLORS = "tab20"  # of stages: there are a dozen


def figure(bench: Bench) -> Figure:
    """Return the plot.

    Left, of the icospheres where there are two or more, else of all scenes: time against the number
    of triangles. Right, of every scene, what each stage of a certified frame takes. Both through
    the perspective camera at the largest size that was measured.

    Raises
    ------
    ValueError
        If nothing was measured.
    MissingPeerError
        If matplotlib is not installed.
    """
    rows = largest(bench)
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise missing("matplotlib") from None
    cores = "one core" if bench.machine.get("one_core") else "not kept on one core"
    processor = bench.machine.get("processor") or "unknown processor"
    made = Figure(_SIZE, layout="constrained")
    made.suptitle(
        f"{rows[0].width} × {rows[0].height} pixels, {rows[0].camera}, {processor}, {cores}"
    )
    growth, stages = made.subplots(1, 2)
    _growth(growth, rows, _plain(bench))
    _stages(stages, rows)
    return made


def write(path: Path, bench: Bench) -> None:
    """Write the plot as SVG, its words as text; raises what :func:`figure` does."""
    made = figure(bench)
    from matplotlib import rc_context

    with rc_context({"svg.fonttype": "none"}):
        made.savefig(path, format="svg", metadata={"Date": None})


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


def _growth(axes: Axes, rows: list[Row], plain: dict[tuple, float]) -> None:
    """Draw each method and peer, joined by a line if all are of one sphere."""
    spheres = [r for r in rows if r.scene in SCALED]
    joined = len(spheres) > 1
    line = "-" if joined else "none"
    for name, label, color, marker in _LINES:
        found = ((r.triangles, _seconds(r, name, plain)) for r in (spheres if joined else rows))
        if points := sorted((n, seconds) for n, seconds in found if seconds):
            x, y = zip(*points, strict=True)
            axes.plot(x, y, ls=line, marker=marker, color=color, label=label)
    title = "Time against triangles" + (", of one sphere" if joined else "")
    axes.set(xscale="log", yscale="log", xlabel="triangles", ylabel="seconds", title=title)
    axes.xaxis.set_major_formatter("{x:,.0f}")
    axes.grid(alpha=0.4)
    axes.legend()


def _stages(axes: Axes, rows: list[Row]) -> None:
    """Draw what each stage takes of every scene, as bars."""
    wholes = [max(r.render_s or 0.0, sum(r.stages.values())) for r in rows]
    stages = [
        r.stages | {"other": whole - sum(r.stages.values())}
        for r, whole in zip(rows, wholes, strict=True)
    ]
    names = dict.fromkeys(name for own in stages for name in own if name != "other")
    scenes = [f"{r.scene}, {r.triangles:,}" for r in rows]
    start = [0.0] * len(rows)
    from matplotlib import colormaps

    for k, name in enumerate((*names, "other")):
        color = colormaps[_COLORS](k)
        seconds = [own.get(name, 0.0) for own in stages]
        bars = axes.barh(scenes, seconds, 0.7, start, color=color, label=name)
        start = [sum(pair) for pair in zip(start, seconds, strict=True)]
    axes.bar_label(bars, [f"{whole:.3g} s" for whole in wholes], padding=4)
    axes.set(xlabel="seconds", title="Where the time of a certified frame goes")
    axes.invert_yaxis()
    axes.margins(x=0.15)
    axes.legend()
