"""depth_bins.png: a scene from above, bin by bin, and what the depth buffer has hidden by then."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from numpy.typing import NDArray
from reference_tracer.report import plots

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


def picture() -> NDArray[np.uint8]:
    shapes = [sphere(3, 0.22 * depth, x, y, -depth) for x, y, depth in SPHERES]
    wall = sheet(61, 43, (6.53, 4.17), lambda x, y: np.maximum(-7.6, -7 - 0.3 * x + 0.1 * y))
    swept = watch(scene(ahead(WIDTH, HEIGHT), *shapes, wall))
    figure = plots.new_figure(1920, 900)
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.1)
    rows = -(-len(swept.looks) // 2)
    grid = figure.add_gridspec(rows, 4)
    draw_from_above(figure.add_subplot(grid[:, :2]), swept)
    seen = [*(look.seen for look in swept.looks[1:]), swept.seen]
    for number, (look, after) in enumerate(zip(swept.looks, seen, strict=True)):
        row, column = divmod(number, 2)
        axes = figure.add_subplot(grid[row, 2 + column])
        draw_bin(axes, number, look, after)
        if row == rows - 1:
            axes.set_xlabel("grey: a sure hit before this bin", fontsize=14, color=plots.INK)
    return plots.pixels(figure)


def draw_from_above(axes: Axes, swept: Watched) -> None:
    title = "Triangles seen from above, by depth bin (grey: hidden)"
    plots.plain_axes(axes, title, "column of pixels", "depth of the nearest corner, m")
    for number, look in enumerate(swept.looks):
        x, depth = (look.boxes.low[0] + look.boxes.high[0]) / 2, 1 / look.nearest
        dropped = np.setdiff1d(np.arange(len(x)), look.open)
        color = COLORS[number]
        axes.plot(x[dropped], depth[dropped], ".", color=HIDDEN, ms=4.5)
        axes.plot(x[look.open], depth[look.open], ".", color=color, ms=4.5, zorder=3)
        middle = (depth.min() + depth.max()) / 2
        axes.text(WIDTH + 2, middle, f"{number + 1}", va="center", fontsize=18, color=color)
        axes.axhline(depth.max(), color=plots.INK, lw=0.7)


def draw_bin(axes: Axes, number: int, look: Look, after: NDArray[np.bool_]) -> None:
    count, hidden = len(look.nearest), len(look.nearest) - len(look.open)
    image = np.ones((HEIGHT, WIDTH, 3))
    image[look.seen] = to_rgb(BEFORE)
    image[after & ~look.seen] = to_rgb(COLORS[number])
    axes.imshow(image, origin="lower", interpolation="nearest")
    title = f"{number + 1}: {hidden:,} of {count:,} hidden"
    axes.set_title(title, fontsize=16, color=plots.INK, loc="left")
    axes.set(xticks=(), yticks=())
    for spine in axes.spines.values():
        spine.set_color(plots.FAINT)
