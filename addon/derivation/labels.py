"""Places the labels of a drawing: beside their points, off one another and off the lines.

Coordinates are those of the drawing, y down. Of points that are drawn in one place, the names are
one label.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ..svg import width_of

SIZE = 16.0  # of letters: legible where a drawing is as narrow as a phone
Place = tuple[float, float]
Segment = tuple[Place, Place]
Box = tuple[float, float, float, float]  # left, top, right, bottom

_TOGETHER = 7.0  # of points that are this near, the names are one label
_REACHES = 9.0, 18.0, 30.0, 46.0, 64.0  # from a point to its label's edge
_DIRECTIONS = 16
_HEIGHT = 1.35 * SIZE
_APART = 3.0  # on each side of a label, from the next one
# Worse than a longer way: a label that leaves the drawing, or lies on another, a dot, a line.
_OUTSIDE, _ON_LABEL, _ON_DOT, _ON_LINE = 1e5, 1e4, 600.0, 60.0
_SAME = 1e-6  # lengths and costs that differ by less are equal: rounding differs among machines


class Label(NamedTuple):
    """Words that belong to a point; `inside` allows them to lie on it."""

    words: str
    at: Place
    inside: bool = False


class Placed(NamedTuple):
    """Words with the middle of their place; `far` if a line has to lead to their point."""

    words: str
    at: Place
    middle: Place
    far: bool

    @property
    def box(self) -> Box:
        """What the words cover, at most."""
        return _box(self.words, self.middle)

    @property
    def lead(self) -> Segment:
        """A line from the point to the words' edge."""
        left, top, right, bottom = self.box
        x, y = self.at
        way = self.middle[0] - x, self.middle[1] - y
        over = (abs(way[0]) / (right - left), abs(way[1]) / (bottom - top))
        share = max(1 - 0.5 / max(*over, 0.5), 0.0)
        return self.at, (x + share * way[0], y + share * way[1])


def joined(labels: Sequence[Label]) -> list[Label]:
    """Return the labels, those of points in one place joined."""
    out: list[Label] = []
    for label in labels:
        near = (k for k, o in enumerate(out) if not label.inside and not o.inside)
        same = next((k for k in near if math.dist(out[k].at, label.at) <= _TOGETHER), None)
        if same is None:
            out.append(label)
        else:
            out[same] = out[same]._replace(words=f"{out[same].words}, {label.words}")
    return out


def placed(labels: Sequence[Label], lines: Sequence[Segment], room: Box) -> list[Placed]:
    """Return each label at the best place that is left for it in the room, the first ones first."""
    together = joined(labels)
    dots = [label.at for label in together if not label.inside]
    out: list[Placed] = []
    taken: list[Box] = []
    for label in together:
        tries = _tries(label)
        best, least = tries[0], math.inf
        for place in tries:
            cost = 0.0
            for more in _costs(place, taken, dots, lines, room):
                cost += more
                if cost >= least - _SAME:  # what is slow to count comes last
                    break
            else:
                best, least = place, cost
        out.append(best)
        taken.append(best.box)
    return out


def _tries(label: Label) -> list[Placed]:
    half_width, half_height = width_of(label.words, SIZE) / 2, _HEIGHT / 2
    out = [Placed(label.words, label.at, label.at, False)] if label.inside else []
    for reach in _REACHES:
        for k in range(_DIRECTIONS):
            angle = 2 * math.pi * k / _DIRECTIONS
            x = label.at[0] + math.cos(angle) * (reach + half_width)
            y = label.at[1] + math.sin(angle) * (reach + half_height)
            out.append(Placed(label.words, label.at, (x, y), reach > _REACHES[1]))
        for right, down in itertools.product((-1, 1), (-1, 1)):  # the label's corner at the point
            x = label.at[0] + right * (0.6 * reach + half_width)
            y = label.at[1] + down * (0.6 * reach + half_height)
            out.append(Placed(label.words, label.at, (x, y), reach > _REACHES[1]))
    return out


def _costs(
    place: Placed,
    others: Sequence[Box],
    dots: Sequence[Place],
    lines: Sequence[Segment],
    room: Box,
) -> Iterator[float]:
    """Yield what makes a place bad, the quickest to find first."""
    left, top, right, bottom = box = place.box
    x, y = place.at
    away = math.hypot(max(left - x, 0, x - right), max(top - y, 0, y - bottom))
    yield away + 0.3 * math.dist(place.at, place.middle)
    if left < room[0] or top < room[1] or right > room[2] or bottom > room[3]:
        yield _OUTSIDE
    yield _ON_LABEL * sum(overlap(box, other) for other in others)
    yield _ON_DOT * sum(left - 5 < x < right + 5 and top - 5 < y < bottom + 5 for x, y in dots)
    for line in lines:
        yield _ON_LINE * crosses(line, box)


def overlap(one: Box, other: Box) -> bool:
    """Return whether two boxes share more than an edge."""
    across = min(one[2], other[2]) - max(one[0], other[0])
    return min(across, min(one[3], other[3]) - max(one[1], other[1])) > _SAME


def crosses(line: Segment, box: Box) -> bool:
    """Return whether a line has a part in a box."""
    (x, y), (to_x, to_y) = line
    low, high = 0.0, 1.0
    for start, way, least, most in (
        (x, to_x - x, box[0], box[2]),
        (y, to_y - y, box[1], box[3]),
    ):
        if way == 0:
            if not least < start < most:
                return False
            continue
        ends = sorted(((least - start) / way, (most - start) / way))
        low, high = max(low, ends[0]), min(high, ends[1])
    return high - low > _SAME


def _box(words: str, middle: Place) -> Box:
    half_width, half_height = width_of(words, SIZE) / 2 + _APART, _HEIGHT / 2
    x, y = middle
    return x - half_width, y - half_height, x + half_width, y + half_height
