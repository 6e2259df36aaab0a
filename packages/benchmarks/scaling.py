"""How time grows with triangles and with pixels: rows -> exponents.

Time is about proportional to (number) ** exponent: 0 means that their number does not count, 1 in
proportion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from .rows import Row
from .scenes import SCALED

NAMES = {"trace_s": "trace", "render_s": "render", "embreex_trace_s": "embreex"}


@dataclass(frozen=True)
class Scaling:
    """One exponent, and what it was fitted to."""

    over: str  # "triangles" or "pixels"
    of: str  # one of NAMES
    method: str
    camera: str
    what: str  # the size of the picture, or the scene
    exponent: float
    points: int


def exponent(numbers: Iterable[float], seconds: Iterable[float]) -> float:
    """Return k of the power law seconds = c * number ** k that fits best, on logarithms."""
    x, y = np.log(list(numbers)), np.log(list(seconds))
    x = x - x.mean()
    return float((x * y).sum() / (x * x).sum())


def scalings(rows: list[Row]) -> list[Scaling]:
    """Return all exponents that there are two points for: icospheres, and the sizes of a scene."""
    spheres = [r for r in rows if r.scene in SCALED]
    return [
        *_fits("triangles", spheres, lambda r: f"{r.width} x {r.height}", lambda r: r.triangles),
        *_fits("pixels", rows, lambda r: r.scene, lambda r: r.pixels),
    ]


def _fits(
    over: str, rows: list[Row], what: Callable[[Row], str], number: Callable[[Row], int]
) -> Iterable[Scaling]:
    def key(row: Row) -> tuple[str, str, str]:
        return what(row), row.camera, row.method

    for (name, camera, method), group in groupby(sorted(rows, key=key), key=key):
        some = list(group)
        for attribute, of in NAMES.items():
            points = [(number(r), s) for r in some if (s := getattr(r, attribute))]
            if len({n for n, _ in points}) > 1:
                k = exponent(*zip(*points, strict=True))
                yield Scaling(over, of, method, camera, name, k, len(points))
