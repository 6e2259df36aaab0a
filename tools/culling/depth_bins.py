"""depth_bins.svg: a scene from above, bin by bin, and what the depth buffer has hidden by then."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from reference_tracer.report import plots

from .panels import image, panel, points, rgb, shown
from .scenes import ahead, scene, sheet, sphere
from .watched import Look, Watched, watch

COLORS = "#0072b2", "#d98e00", "#009e73", "#c2477f", "#7a3d9a", "#8c510a", "#3a9ad9", "#5f7a00"
HIDDEN, BEFORE = "#a9a9a9", "#dedede"
WIDTH, HEIGHT = 192, 128
SPHERES = (  # x, y, depth
    (-0.65, 0.15, 2.2),
    (0.4, -0.3, 2.6),
    (-0.1, 0.5, 3.4),
    (1.3, 0.45, 3.9),
    (-1.2, -0.9, 4.3),
    (0.7, 0.2, 5.0),
)


def picture() -> str:
    shapes = [sphere(3, 0.22 * depth, x, y, -depth) for x, y, depth in SPHERES]
    wall = sheet(61, 43, (6.53, 4.17), lambda x, y: np.maximum(-7.6, -7 - 0.3 * x + 0.1 * y))
    swept = watch(scene(ahead(WIDTH, HEIGHT), *shapes, wall))
    high = 840 / math.ceil(len(swept.looks) / 2)
    seen = [*(look.seen for look in swept.looks[1:]), swept.seen]
    out = from_above(swept)
    for number, (look, after) in enumerate(zip(swept.looks, seen, strict=True)):
        row, column = divmod(number, 2)
        out += one_bin(1150 + 385 * column, 10 + high * row, high, number, look, after)
    out += plots.text((1520, 875), "grey: a sure hit before this bin", 23, anchor="middle")
    title = (
        "Triangles seen from above, by depth bin, and the pixels that each bin is first to cover"
    )
    return plots.picture(1920, 900, title, "What is hidden is grey.", out)


def from_above(swept: Watched) -> str:
    depths = [1 / look.nearest for look in swept.looks]
    far = max(depth.max() for depth in depths)
    scales = plots.linear(0, WIDTH), plots.linear(0.95 * min(d.min() for d in depths), 1.02 * far)
    axes = plots.Axes(130, 70, 920, 710, *scales)
    out = axes.drawn("", "column of pixels", "depth of the nearest corner, m")
    out += plots.text((20, 32), "Triangles seen from above, by depth bin (grey: hidden)", 30)
    for number, (look, depth) in enumerate(zip(swept.looks, depths, strict=True)):
        x = (look.boxes.low[0] + look.boxes.high[0]) / 2
        dropped = np.setdiff1d(np.arange(len(x)), look.open)
        color = COLORS[number]
        out += points(axes, x[dropped], depth[dropped], HIDDEN, 4)
        out += points(axes, x[look.open], depth[look.open], color, 4)
        middle = axes.at(WIDTH + 4, (depth.min() + depth.max()) / 2)
        out += plots.text(middle, f"{number + 1}", 30, color)
        out += plots.line([axes.at(0, depth.max()), axes.at(WIDTH, depth.max())], plots.INK, 1.2)
    return out


def one_bin(
    left: float, top: float, high: float, number: int, look: Look, after: NDArray[np.bool_]
) -> str:
    count, hidden = len(look.nearest), len(look.nearest) - len(look.open)
    colors = image(WIDTH, HEIGHT)
    colors[look.seen] = rgb(BEFORE)
    colors[after & ~look.seen] = rgb(COLORS[number])
    axes = panel(left, top + 34, 430, high - 50, WIDTH, HEIGHT)
    corners = [axes.at(*at) for at in ((0, 0), (WIDTH, 0), (WIDTH, HEIGHT), (0, HEIGHT), (0, 0))]
    title = plots.text((left, top + 18), f"{number + 1}: {hidden:,} of {count:,} hidden", 24)
    return title + shown(axes, colors) + plots.line(corners, plots.FAINT, 1.3)
