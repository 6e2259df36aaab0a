"""culling.svg: boxes of triangles; cells of a large one; pixels sure, in doubt and missed."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from reference_tracer.certified.sweep.depth_buffer import COARSE, FINE, DepthBuffer
from reference_tracer.certified.sweep.rasterise import Boxes, cells
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.report import plots

from .panels import border, dots, image, outline, panel, rgb, shown
from .scenes import ahead, mesh, scene, sheet, sphere
from .watched import Watched, watch

SURE, DOUBT, MISSED = "#8cc4e3", "#d55e00", "#dedede"
BY_EDGE, BY_DEPTH = ("#a9a9a9", "#dedede"), ("#7a3d9a", "#c9abd8")  # cells of 64, of 8 pixels
BOXES = {5: "#0072b2", 14: "#b8860b", 23: "#009e73", 38: "#8c510a"}  # triangles, by number


Names = list[tuple[str, str]]  # what a colour means, and the colour


def picture() -> str:
    title = "Boxes of small triangles, cells of a large triangle, and pixels of two triangles"
    about = "What the sweep computes, and what it drops before."
    return plots.picture(1920, 740, title, about, _boxes(20) + _cells(660) + _pixels(1300))


def _boxes(left: float) -> str:
    camera = ahead(24, 20)
    wavy = sheet(6, 5, (0.53, 0.44), lambda x, y: -1.1 - 0.13 * np.sin(6 * x + 4 * y))
    swept = watch(scene(camera, wavy))
    [(low, high)] = swept.found_boxes
    axes, out = pixel_axes(left, "1  Boxes of small triangles", 24, 20, 1)
    film = corners_on_film(swept)
    out += outline(axes, film, plots.INK, 1.5)
    for number, color in BOXES.items():
        (x0, y0), (x1, y1) = low[:, number].tolist(), (high[:, number] + 1).tolist()
        box = np.array([[(x0, y0), (x1, y0), (x1, y1), (x0, y1)]])
        out += outline(axes, film[[number]], "none", 0, fill=color, fill_opacity=0.4)
        out += outline(axes, box, color, 5) + dots(
            axes, np.arange(x0, x1), np.arange(y0, y1), color, 7
        )
    return out + legend(left, [("a pixel's centre in the box: to be tested", plots.INK)], 12)


def _cells(left: float) -> str:
    width, height = 5 * COARSE, 4 * COARSE
    camera = ahead(width, height)
    large = mesh([(-1.15, -0.95, -2), (1.2, -0.5, -2.4), (-0.1, 1.1, -2.2)], [(0, 1, 2)])
    swept = watch(scene(camera, sphere(4, 0.33, 0.02, -0.17, -1.2), large))
    tested = swept.tested[-1]  # the large one's, as it lies behind
    boxes, found, depths = tested.boxes, tested.found, tested.depths
    nothing = DepthBuffer(camera.region)  # it hides nothing: with it, edges alone drop cells
    by_edges, coarse = (joined(cells(found, boxes, d, COARSE)) for d in (nothing, depths))
    fine_by_edges, fine = (joined(cells(found, coarse, d, FINE)) for d in (nothing, depths))
    axes, grid = pixel_axes(left, "2  Cells of a large triangle", width, height, COARSE)
    colors, seams = image(width, height), ""
    for some, color, line in (  # each is a part of the one before
        (boxes, BY_EDGE[0], 0),
        (by_edges, BY_DEPTH[0], 2.5),
        (coarse, BY_EDGE[1], 2.5),
        (fine_by_edges, BY_DEPTH[1], 0.8),
        (fine, SURE, 0.8),
    ):
        low, end = some.low, some.high + 1
        for (x0, y0), (x1, y1) in zip(low.T, end.T, strict=True):
            colors[y0:y1, x0:x1] = rgb(color)
        shapes = np.stack((low, [end[0], low[1]], end, [low[0], end[1]]), axis=1).transpose(2, 1, 0)
        seams += outline(axes, shapes, "white", line)
    out = shown(axes, colors) + grid + seams
    out += outline(axes, corners_on_film(swept)[-1:], plots.INK, 3.5)
    in_front = depths.nearness.reshape(-1, depths.stride)[:height, :width] > -np.inf
    names = [
        ("64 pixels: dropped by an edge", BY_EDGE[0]),
        ("8 pixels: dropped by an edge", BY_EDGE[1]),
        ("64: hidden by a sphere", BY_DEPTH[0]),
        ("8: hidden", BY_DEPTH[1]),
        ("8: kept", SURE),
    ]
    return out + border(axes, in_front, plots.INK) + legend(left, names)


def _pixels(left: float) -> str:
    width, height = 12, 10  # metres, too: one for each pixel, so that all numbers are exact
    film = np.array([(1.5, 0.5), (10.6, 1.3), (9.5, 8.5), (0.7, 9.2)])
    place = np.insert(film - (width / 2, height / 2), 2, -5, axis=1)
    camera = ahead(width, height, height / 2, projection=ORTHOGRAPHIC)
    swept = watch(scene(camera, mesh(place, [(0, 1, 2), (0, 2, 3)])))
    colors = image(width, height)
    [(low, high)] = swept.found_boxes
    for (x0, y0), (x1, y1) in zip(low.T, high.T, strict=True):
        colors[y0 : y1 + 1, x0 : x1 + 1] = rgb(MISSED)
    colors[swept.seen] = rgb(SURE)
    for fragments in (k for tested in swept.tested for k in tested.fragments):
        colors.reshape(-1, 4)[swept.numbers(fragments)] = rgb(DOUBT)
    axes, grid = pixel_axes(left, "3  Pixels of two triangles", width, height, 1)
    out = shown(axes, colors) + grid
    out += outline(axes, film[np.array([(0, 1, 2), (0, 2, 3)])], plots.INK, 3.5)
    out += dots(axes, np.arange(width), np.arange(height), plots.INK, 6)
    names = [
        ("sure", SURE),
        ("missed", MISSED),
        ("in doubt: an edge runs through the very centre", DOUBT),
    ]
    return out + legend(left, names)


def corners_on_film(swept: Watched) -> NDArray[np.float64]:
    """Where the triangles' corners appear, (m, 3, 2), in pixels."""
    [expanded] = swept.expanded
    v = expanded.vertices
    return np.stack((v.p / v.w, v.q / v.w), axis=1)[expanded.corners.T]


def joined(parts: Iterable[Boxes]) -> Boxes:
    fields = zip(*(vars(part).values() for part in parts), strict=True)
    return Boxes(*(np.concatenate(f, axis=-1) for f in fields))


def pixel_axes(
    left: float, title: str, width: int, height: int, step: int
) -> tuple[plots.Axes, str]:
    """A panel of so many pixels, and its grid and title."""
    axes = panel(left, 70, 600, 500, width, height)
    out = plots.text((left, 35), title, 33)
    for x in range(0, width + 1, step):
        out += plots.line([axes.at(x, 0), axes.at(x, height)], plots.FAINT, 1.3)
    for y in range(0, height + 1, step):
        out += plots.line([axes.at(0, y), axes.at(width, y)], plots.FAINT, 1.3)
    return axes, out


def legend(left: float, names: Names, side: float = 24) -> str:
    """What colours mean, below; a small mark is a dot."""
    out = ""
    for k, (words, color) in enumerate(names):
        y = 592 + 30 * k
        dot = plots.mark((left + 12, y), 4, color)
        out += plots.cell(left, y - side / 2, side, side, color) if side > 20 else dot
        out += plots.text((left + 36, y), words, 23)
    return out
