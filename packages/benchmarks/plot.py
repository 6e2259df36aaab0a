"""The plot of a `Bench`: time against triangles for ours and the peers, and stages by scene."""

from __future__ import annotations

from reference_tracer.methods import Method
from reference_tracer.report import plots

from .rows import Bench, Row
from .scenes import SCALED

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
_STAGES = (
    *("#7a3d9a", "#0072b2", "#009e73", "#e69f00", "#d55e00", "#56b4e9", "#b0723a", "#cc79a7"),
    *("#4d4d4d", "#b8a9d9", "#8fd3bd"),
)
_OTHER = "#d9d9d9"
_SHAPES: dict[str, list[tuple[float, float]]] = {  # of marks that are not round, of radius 1
    "s": [(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
    "^": [(0, -1.1), (1, 0.8), (-1, 0.8)],
    "v": [(0, 1.1), (1, -0.8), (-1, -0.8)],
    "D": [(0, -1.2), (1.2, 0), (0, 1.2), (-1.2, 0)],
}
_TOP, _HIGH = 160, 725  # of both axes, in pixels


def picture(bench: Bench) -> str:
    """Return the plot, an SVG.

    Left, of the icospheres where there are two or more, else of all scenes: time against the number
    of triangles. Right, of every scene, what each stage of a certified frame takes. Both through
    the perspective camera at the largest size that was measured.

    Raises
    ------
    ValueError
        If nothing was measured.
    """
    rows = largest(bench)
    spheres = [r for r in rows if r.scene in SCALED]
    cores = "one core" if bench.machine.get("one_core") else "not kept on one core"
    head = (
        f"{rows[0].width} × {rows[0].height} pixels, {rows[0].camera}, "
        f"{bench.machine.get('processor') or 'unknown processor'}, {cores}"
    )
    inside = plots.text((20, 38), head, min(28.0, 28 * 1880 / plots.width_of(head, 28)))
    joined = len(spheres) > 1
    inside += _growth(spheres if joined else rows, _plain(bench), joined) + _stages(rows)
    title = "Time against triangles, and where the time of a certified frame goes"
    return plots.picture(plots.WIDTH, plots.HEIGHT, title, head, inside)


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


def _growth(rows: list[Row], plain: dict[tuple, float], joined: bool) -> str:
    """Draw each method and peer, joined by a line if all are of one scene; name them."""
    lines = {
        name: sorted((r.triangles, s) for r in rows if (s := _seconds(r, name, plain)))
        for name, *_ in _LINES
    }
    seconds = [s for line in lines.values() for _, s in line]
    low, far = 0.7 * min(r.triangles for r in rows), 1.3 * max(r.triangles for r in rows)
    x = plots.logarithmic(low, far * (far / low) ** (0.72 * joined))  # room for the names
    x = x._replace(ticks={v: _number(v) for v in x.ticks if v < 3 * far})
    y = plots.logarithmic(0.7 * min(seconds), 1.4 * max(seconds))
    axes = plots.Axes(150, _TOP, 890, _HIGH, x, y)
    title = "Time against triangles" + (", of one sphere" if joined else "")
    out, named, names = axes.drawn(title, "triangles", "seconds"), [], {}
    for name, label, color, shape in _LINES:
        places = [axes.at(*point) for point in lines[name]]
        size = 10.0 if name in ("trace_s", "plain_s") else 7.5
        out += plots.line(places, color, size / 2) if joined else ""
        out += "".join(_mark(place, size, color, shape) for place in places)
        if places:
            named.append((*places[-1], label, color))
            names[label] = _mark((0, 0), 9, color, shape)
    if not joined:
        return out + plots.legend(names, plots.HEIGHT - 30)
    column, above = axes.at(1.3 * far, y.low)[0] + 20, float("inf")
    for at, height, label, color in sorted(named, key=lambda end: -end[1]):
        above = min(height, above - 34)  # no two over one another
        out += plots.line([(at, height), (column - 6, above)], color, 1.5, opacity=0.4)
        out += plots.text((column, above), label, 25, color)
    return out


def _mark(at: plots.Place, size: float, color: str, shape: str) -> str:
    if shape not in _SHAPES:
        return plots.mark(at, size, color)
    points = " ".join(f"{at[0] + size * x:.1f},{at[1] + size * y:.1f}" for x, y in _SHAPES[shape])
    return plots.element("polygon", points=points, fill=color)


def _stages(rows: list[Row]) -> str:
    """Draw what each stage takes of every scene, as bars."""
    names = list(dict.fromkeys(name for r in rows for name in r.stages))
    colors = dict(zip(names, _STAGES * (1 + len(names) // len(_STAGES)), strict=False))
    colors["other"] = _OTHER
    wholes = [max(r.render_s or 0.0, sum(r.stages.values())) for r in rows]
    high = _HIGH / len(rows)
    size = min(20.0, 0.8 * high)
    scenes = {len(rows) - k - 0.5: f"{r.scene}, {_number(r.triangles)}" for k, r in enumerate(rows)}
    left = 1090 + max(plots.width_of(name, size) for name in scenes.values())
    x = plots.linear(0, 1.25 * max(wholes))
    axes = plots.Axes(left, _TOP, 1890 - left, _HIGH, x, plots.Scale(0, len(rows), {0: ""}))
    title = "Where the time of a certified frame goes"
    out = axes.drawn("", "seconds") + plots.text((1890, _TOP - 34), title, 32, anchor="end")
    for (middle, scene), r, whole in zip(scenes.items(), rows, wholes, strict=True):
        out += plots.text((left - 12, axes.at(0, middle)[1]), scene, size, anchor="end")
        start = 0.0
        for name, seconds in (r.stages | {"other": whole - sum(r.stages.values())}).items():
            (begin, y), (end, _) = axes.at(start, middle), axes.at(start + seconds, middle)
            title = f"{r.scene}, {name}: {seconds:.3g} s"
            out += plots.cell(begin, y - 0.35 * high, end - begin, 0.7 * high, colors[name], title)
            start += seconds
        out += plots.text((end + 8, y), f"{whole:.3g} s", size)
    entries = {name: plots.cell(-14, -14, 28, 28, color) for name, color in colors.items()}
    return out + plots.legend(entries, plots.HEIGHT - 75)


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
