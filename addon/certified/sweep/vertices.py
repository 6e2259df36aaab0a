"""The record of projected vertices, which `film.py` fills."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Index


@dataclass(frozen=True, eq=False)
class Vertices:
    """v vertices on the film.

    `box` (v, 4) is lowest x, lowest y, -highest x, -highest y of the pixels whose centres a
    triangle may cover at this vertex. The minimum over its three corners is a triangle's box. It
    holds only where `ahead`: where the vertex surely is in front of the eye. `x`, `y` (v,) is the
    film position. `nearest` (v,) bounds the nearness (`edge_functions.py`) of the vertex from
    above. `finite` (v,) says whether the vertex is finite in world space.
    """

    box: Index
    p: Floats
    q: Floats
    w: Floats
    x: Floats
    y: Floats
    depth: Floats
    size: Floats
    nearest: Floats
    ahead: Bools
    finite: Bools

    @classmethod
    def empty(cls, count: int, dtype: type[np.integer]) -> Vertices:
        """Return arrays for this many vertices, to be filled; boxes are of this dtype."""
        numbers, flags = np.empty((8, count)), np.empty((2, count), bool)
        return cls(np.empty((count, 4), dtype), *numbers, *flags)
