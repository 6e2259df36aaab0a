"""A drawing as SVG: shapes of plane coordinates, cut off at its frame, with labels beside points.

Its colours are classes, which `fragment.css` has for light and dark. The elements of points have
their names and whoever reads the file finds the numbers again: all scales are the same in x and y.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Floats
from ..svg import element, said
from .labels import SIZE, Label, Place, Segment, placed

WIDTH, HEIGHT = 440.0, 340.0  # at most: a flat drawing is less high
_MARGIN = 46.0  # around what is fitted, for labels
_FRAME = 4.0  # from the drawing's edge to the frame at which shapes are cut off
NEGATIVE = " derivation-drawn-negative"  # of a shape's kind: of a share below 0
_HEAD = 9.0  # length of an arrow's head


class Plate:
    """One drawing; its coordinates are those of the points given, y up.

    Parameters
    ----------
    name, title : str
        What it is called in the file, and what it says to those who hear it.
    fitted : (n, 2) float64
        Points that it holds.
    """

    def __init__(self, name: str, title: str, fitted: Floats) -> None:
        self.name, self.title = name, title
        low, high = fitted.min(axis=0), fitted.max(axis=0)
        across = np.maximum(high - low, np.finfo(float).tiny)
        room = np.array((WIDTH, HEIGHT)) - 2 * _MARGIN
        self.scale = float(np.min(room / across))  # of the drawing's units to one of a point's
        self.height = float(min(across[1] * self.scale + 2 * _MARGIN, HEIGHT))
        self._middle = low / 2 + high / 2
        self._shapes: list[str] = []
        self._labels: list[Label] = []
        self._lines: list[Segment] = []

    def at(self, point: Sequence[float] | Floats) -> Place:
        """Return where a point is in the drawing."""
        x, y = (np.asarray(point, np.float64) - self._middle) * self.scale
        return WIDTH / 2 + float(x), self.height / 2 - float(y)

    def shape(self, name: str, points: Floats, kind: str, closed: bool = True) -> None:
        """Draw the polygon or the line of points (n, 2), as far as it is in the frame."""
        drawn = np.array([self.at(p) for p in points])
        lines = list(zip(drawn, np.roll(drawn, -1, axis=0), strict=True))
        parts = [drawn] if closed else [np.array(pair) for pair in lines[:-1]]
        for part in parts:
            inside = self._in_frame(part)
            if len(inside) > 1:
                path = " ".join(f"{x:.7g},{y:.7g}" for x, y in inside)
                tag = "polygon" if closed else "polyline"
                self._shapes.append(element(tag, points=path, data_name=name, **_of(kind)))
        for one, other in lines if closed else lines[:-1]:
            self._lines.append(((float(one[0]), float(one[1])), (float(other[0]), float(other[1]))))

    def arrow(self, name: str, start: Floats, end: Floats, kind: str) -> None:
        """Draw an arrow between two points."""
        self.shape(name, np.stack((start, end)), kind, closed=False)
        tip, foot = np.array(self.at(end)), np.array(self.at(start))
        length = float(np.hypot(*(tip - foot)))
        if length < 2 * _HEAD:
            return
        along = (tip - foot) / length * _HEAD
        aside = np.array((-along[1], along[0])) * 0.45
        head = np.array((tip, tip - along + aside, tip - along - aside))
        path = " ".join(f"{x:.7g},{y:.7g}" for x, y in head)
        self._shapes.append(element("polygon", points=path, **_of(f"{kind}-head")))

    def point(self, name: str, point: Floats, words: str, kind: str = "point") -> None:
        """Draw a dot with a label beside it, if it is in the frame."""
        x, y = self.at(point)
        if not (_FRAME < x < WIDTH - _FRAME and _FRAME < y < self.height - _FRAME):
            return
        self._shapes.append(element("circle", cx=x, cy=y, r=4.0, data_name=name, **_of(kind)))
        if words:
            self._labels.append(Label(words, (x, y)))

    def words(self, point: Floats, words: str) -> None:
        """Write words on a point, or beside it with a line to it."""
        self._labels.append(Label(words, self.at(point), inside=True))

    def svg(self) -> str:
        """Return the drawing."""
        out = []
        room = _FRAME, _FRAME, WIDTH - _FRAME, self.height - _FRAME
        for label in placed(self._labels, self._lines, room):
            x, y = label.middle
            if label.far:
                (x1, y1), (x2, y2) = label.lead
                out.append(element("line", x1=x1, y1=y1, x2=x2, y2=y2, **_of("lead")))
            out.append(
                said("text", label.words, x=x, y=y + 0.35 * SIZE, font_size=SIZE)  # on the letters
            )
        frame = element(
            "rect",
            x=_FRAME,
            y=_FRAME,
            width=WIDTH - 2 * _FRAME,
            height=self.height - 2 * _FRAME,
            **_of("paper"),
        )
        return element(
            "svg",
            said("title", self.title),
            frame,
            *self._shapes,
            *out,
            viewBox=f"0 0 {WIDTH:g} {self.height:g}",
            role="img",
            data_name=self.name,
            data_scale=self.scale,
        )

    def _in_frame(self, points: Floats) -> Floats:
        """Return the part of a polygon (n, 2) that is in the frame; of two points, of a line."""
        for axis, size in ((0, WIDTH), (1, self.height)):
            for side, bound in ((1.0, _FRAME), (-1.0, size - _FRAME)):
                points = kept(points, side * (points[:, axis] - bound))
        return points


def _of(kind: str) -> dict[str, str]:
    """Return the attribute that gives an element its colours."""
    return {"class": f"derivation-drawn-{kind}"}


def kept(points: Floats, inside: Floats) -> Floats:
    """Return the part of a polygon (n, k) in which a linear function, (n,) here, is not negative.

    Sutherland and Hodgman's: each edge that crosses 0 has a new corner there.
    """
    out = []
    for k in range(len(points)):
        a, b, at_a, at_b = points[k - 1], points[k], inside[k - 1], inside[k]
        if (at_a >= 0) != (at_b >= 0):
            out.append(a + (b - a) * (at_a / (at_a - at_b)))
        if at_b >= 0:
            out.append(b)
    return np.array(out).reshape(-1, points.shape[1])
