"""culling.png: boxes of triangles; cells of a large one; pixels sure, in doubt and missed."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import Rectangle
from numpy.typing import NDArray
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.report import plots
from reference_tracer.tracer.certified.sweep.depth_buffer import COARSE, FINE, DepthBuffer
from reference_tracer.tracer.certified.sweep.rasterise import Boxes, cells

from .scenes import ahead, mesh, scene, sheet, sphere
from .watched import Watched, watch

SURE, DOUBT, MISSED = "#8cc4e3", "#d55e00", "#dedede"
BY_EDGE, BY_DEPTH = ("#a9a9a9", "#dedede"), ("#7a3d9a", "#c9abd8")  # cells of 64, of 8 pixels
BOXES = {5: "#0072b2", 14: "#b8860b", 23: "#009e73", 38: "#8c510a"}  # triangles, by number


def picture() -> NDArray[np.uint8]:
    figure = plots.new_figure(1920, 740)
    figure.get_layout_engine().set(rect=(0, 0.16, 1, 0.84))  # what is below the legends
    left, middle, right = figure.subplots(1, 3)
    draw_boxes(left)
    draw_cells(middle)
    draw_pixels(right)
    return plots.pixels(figure)


def draw_boxes(axes: Axes) -> None:
    camera = ahead(24, 20)
    wavy = sheet(6, 5, (0.53, 0.44), lambda x, y: -1.1 - 0.13 * np.sin(6 * x + 4 * y))
    swept = watch(scene(camera, wavy))
    [(low, high)] = swept.found_boxes
    pixel_axes(axes, "1  Boxes of small triangles", 24, 20, 1)
    film = corners_on_film(swept)
    outline(axes, film, plots.INK, 0.9)
    for number, color in BOXES.items():
        (x0, y0), (x1, y1) = low[:, number].tolist(), high[:, number].tolist()
        axes.add_collection(PolyCollection(film[[number]], facecolors=color, alpha=0.4))
        axes.add_patch(Rectangle((x0, y0), x1 + 1 - x0, y1 + 1 - y0, fill=False, ec=color, lw=3))
        dots(axes, np.arange(x0, x1 + 1), np.arange(y0, y1 + 1), color, 4)
    legend(axes, [("a pixel's centre in the box: to be tested", plots.INK)], 1, "o")


def draw_cells(axes: Axes) -> None:
    width, height = 5 * COARSE, 4 * COARSE
    camera = ahead(width, height)
    large = mesh([(-1.15, -0.95, -2), (1.2, -0.5, -2.4), (-0.1, 1.1, -2.2)], [(0, 1, 2)])
    swept = watch(scene(camera, sphere(4, 0.33, 0.02, -0.17, -1.2), large))
    tested = swept.tested[-1]  # the large one's, as it lies behind
    boxes, found, depths = tested.boxes, tested.found, tested.depths
    nothing = DepthBuffer(camera.region)  # it hides nothing: with it, edges alone drop cells
    by_edges, coarse = (joined(cells(found, boxes, d, COARSE)) for d in (nothing, depths))
    fine_by_edges, fine = (joined(cells(found, coarse, d, FINE)) for d in (nothing, depths))
    pixel_axes(axes, "2  Cells of a large triangle", width, height, COARSE)
    image = np.ones((height, width, 3))
    for some, color, line in (  # each is a part of the one before
        (boxes, BY_EDGE[0], 0),
        (by_edges, BY_DEPTH[0], 1.5),
        (coarse, BY_EDGE[1], 1.5),
        (fine_by_edges, BY_DEPTH[1], 0.5),
        (fine, SURE, 0.5),
    ):
        low, end = some.low, some.high + 1
        for (x0, y0), (x1, y1) in zip(low.T, end.T, strict=True):
            image[y0:y1, x0:x1] = to_rgb(color)
        shapes = np.stack((low, [end[0], low[1]], end, [low[0], end[1]]), axis=1).transpose(2, 1, 0)
        outline(axes, shapes, "white", line)
    show(axes, image)
    outline(axes, corners_on_film(swept)[-1:], plots.INK, 2)
    pixels = np.arange(width) + 0.5, np.arange(height) + 0.5
    in_front = depths.nearness.reshape(-1, depths.stride)[:height, :width] > -np.inf
    axes.contour(*pixels, in_front, [0.5], colors=plots.INK, linewidths=1.2, linestyles="dashed")
    names = [
        ("64 pixels: dropped by an edge", BY_EDGE[0]),
        ("8 pixels: dropped by an edge", BY_EDGE[1]),
        ("64: hidden by a sphere", BY_DEPTH[0]),
        ("8: hidden", BY_DEPTH[1]),
        ("8: kept", SURE),
    ]
    legend(axes, names, 2)


def draw_pixels(axes: Axes) -> None:
    width, height = 12, 10  # metres, too: one for each pixel, so that all numbers are exact
    film = np.array([(1.5, 0.5), (10.6, 1.3), (9.5, 8.5), (0.7, 9.2)])
    place = np.insert(film - (width / 2, height / 2), 2, -5, axis=1)
    camera = ahead(width, height, height / 2, projection=ORTHOGRAPHIC)
    swept = watch(scene(camera, mesh(place, [(0, 1, 2), (0, 2, 3)])))
    image = np.ones((height, width, 3))
    [(low, high)] = swept.found_boxes
    for (x0, y0), (x1, y1) in zip(low.T, high.T, strict=True):
        image[y0 : y1 + 1, x0 : x1 + 1] = to_rgb(MISSED)
    image[swept.seen] = to_rgb(SURE)
    for rivals in (k for tested in swept.tested for k in tested.rivals):
        image.reshape(-1, 3)[swept.numbers(rivals)] = to_rgb(DOUBT)
    pixel_axes(axes, "3  Pixels of two triangles", width, height, 1)
    show(axes, image)
    outline(axes, film[np.array([(0, 1, 2), (0, 2, 3)])], plots.INK, 2)
    dots(axes, np.arange(width), np.arange(height), plots.INK, 3)
    names = [
        ("sure", SURE),
        ("missed", MISSED),
        ("in doubt: an edge runs through the very centre", DOUBT),
    ]
    legend(axes, names, 1)


def corners_on_film(swept: Watched) -> NDArray[np.float64]:
    """Where the triangles' corners appear, (m, 3, 2), in pixels."""
    [expanded] = swept.expanded
    v = expanded.vertices
    return np.stack((v.p / v.w, v.q / v.w), axis=1)[expanded.corners.T]


def joined(parts: Iterable[Boxes]) -> Boxes:
    fields = zip(*(vars(part).values() for part in parts), strict=True)
    return Boxes(*(np.concatenate(f, axis=-1) for f in fields))


def pixel_axes(axes: Axes, title: str, width: int, height: int, step: int) -> None:
    axes.set_title(title, fontsize=20, color=plots.INK, loc="left", pad=10)
    axes.set(xlim=(0, width), ylim=(0, height), aspect="equal", xticks=(), yticks=())
    lines = [[(x, 0), (x, height)] for x in range(0, width + 1, step)]
    lines += [[(0, y), (width, y)] for y in range(0, height + 1, step)]
    axes.add_collection(LineCollection(lines, colors=plots.FAINT, linewidths=0.8, zorder=1))
    for spine in axes.spines.values():
        spine.set_color(plots.FAINT)


def show(axes: Axes, image: NDArray[np.float64]) -> None:
    extent = (0, image.shape[1], 0, image.shape[0])
    axes.imshow(image, origin="lower", extent=extent, interpolation="nearest", zorder=0)


def outline(axes: Axes, shapes: NDArray, color: str, line: float) -> None:
    some = PolyCollection(shapes, facecolors="none", edgecolors=color, linewidths=line, zorder=2)
    axes.add_collection(some)


def dots(axes: Axes, x: NDArray, y: NDArray, color: str, size: float) -> None:
    x, y = np.meshgrid(x + 0.5, y + 0.5)
    axes.plot(x.ravel(), y.ravel(), "o", color=color, markersize=size)


def legend(axes: Axes, names: list[tuple[str, str]], columns: int, marker: str = "s") -> None:
    """What colours mean, below."""
    handles = [
        axes.plot([], [], marker, color=color, ms=7 if marker == "o" else 15, label=name)[0]
        for name, color in names
    ]
    found = axes.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(0, -0.02),
        ncols=columns,
        fontsize=14,
        frameon=False,
        borderaxespad=0,
        handlelength=1,
        columnspacing=1,
    )
    found.set_in_layout(False)
