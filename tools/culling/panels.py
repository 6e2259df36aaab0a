"""What both pictures are drawn with, beside the plots' own: rectangles that show pixels."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from reference_tracer.images import data_uri
from reference_tracer.png import encode
from reference_tracer.report import plots


def panel(left: float, top: float, width: float, height: float, x: float, y: float) -> plots.Axes:
    """Axes within a rectangle, of so many pixels (x, y) that are as wide as high."""
    side = min(width / x, height / y)
    scales = plots.Scale(0, x, {}), plots.Scale(0, y, {})
    return plots.Axes(left, top, x * side, y * side, *scales)


def rgb(color: str) -> tuple[int, ...]:
    return *bytes.fromhex(color[1:]), 255


def image(width: int, height: int) -> NDArray[np.uint8]:
    return np.full((height, width, 4), 255, np.uint8)


def shown(axes: plots.Axes, colors: NDArray[np.uint8]) -> str:
    """A picture (h, w, 4), row 0 at the bottom, each pixel a square."""
    place = {"x": axes.left, "y": axes.top, "width": axes.width, "height": axes.height}
    return plots.element(
        "image", href=data_uri(encode(colors)), style="image-rendering: pixelated", **place
    )


def path(moves: list[str], color: str, width: float, **more: str | float) -> str:
    style = {"fill": "none"} | more
    return plots.element("path", d="".join(moves), stroke=color, stroke_width=width, **style)


def outline(
    axes: plots.Axes, shapes: NDArray, color: str, width: float, **more: str | float
) -> str:
    """Polygons (n, corners, 2)."""
    moves = []
    for shape in shapes.tolist():
        places = " ".join("{:.1f},{:.1f}".format(*axes.at(x, y)) for x, y in shape)
        moves.append(f"M{places}Z")
    return path(moves, color if width else "none", width, **more)


def points(axes: plots.Axes, x: NDArray, y: NDArray, color: str, size: float) -> str:
    """Round dots, as lines without a length."""
    places = (axes.at(*at) for at in zip(x.tolist(), y.tolist(), strict=True))
    moves = ["M{:.1f} {:.1f}h0".format(*place) for place in places]
    return path(moves, color, size, stroke_linecap="round")


def dots(axes: plots.Axes, x: NDArray, y: NDArray, color: str, size: float) -> str:
    """The centres of all pixels in columns x and rows y."""
    x, y = np.meshgrid(x + 0.5, y + 0.5)
    return points(axes, x.ravel(), y.ravel(), color, size)


def border(axes: plots.Axes, mask: NDArray[np.bool_], color: str) -> str:
    """The border of what a mask (h, w) has."""
    framed = np.pad(mask, 1)
    rows, columns = framed[1:] != framed[:-1], framed[:, 1:] != framed[:, :-1]
    sides = [((x - 1, y), (x, y)) for y, x in np.argwhere(rows).tolist()]
    sides += [((x, y - 1), (x, y)) for y, x in np.argwhere(columns).tolist()]
    moves = "M{:.1f},{:.1f}L{:.1f},{:.1f}"
    return path([moves.format(*axes.at(*a), *axes.at(*b)) for a, b in sides], color, 1.5)
