"""Perspective: all rays begin in the eye, and what is twice as far appears half as large.

In come numbers of a camera's own axes (right, up, depth) and of its window; out goes what depends
on the projection.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Perspective:
    """The rays of a pinhole camera."""

    name: ClassVar[str] = "perspective"
    in_files: ClassVar[bool | str] = False  # their "orthographic"; of a third one, its name
    blender: ClassVar[str] = "PERSP"
    # Whether all rays are parallel: then the window is in metres, and the clip range may begin
    # behind the camera. Otherwise all rays begin in one point.
    is_parallel: ClassVar[bool] = False
    is_linear: ClassVar[bool] = True  # a ray is linear in the film position
    # A ray's origin and direction, for readers: the formula's right side, and a remark.
    formulas: ClassVar[dict[str, tuple[str, str]]] = {
        "o": ("e", ""),
        "d": ("u right + v up + forward", "not normalised: t is the depth"),
    }

    def ray(self, eye: Any, aside: Any, forward: Any) -> tuple[Any, Any]:
        """Return origin and direction of rays that pass the window at `aside`, u right + v up."""
        return eye, aside + forward

    def scale(self, depth: Any) -> Any:
        """Return how many metres the window's unit is at a depth."""
        return depth

    def slant(self, reach: float) -> float:
        """Return how far an error of 1 in every coordinate moves a point on a window's plane."""
        return 1 + reach

    def window_range(
        self, value: Floats, depth: Floats, error: Floats, front: Floats, clip_start: float
    ) -> tuple[Floats, Floats]:
        """Return where m triangles, from `front` on, lie on the window: lowest, highest, (m,) each.

        `value` and `depth`, (3, m), are the corners' right or up, and depth, metres, off by at most
        `error` (m,); `front` (m,) is the least depth of what can be seen of each.
        """
        smallest, largest = value.min(axis=0) - error, value.max(axis=0) + error
        end = np.maximum(depth.max(axis=0) + error, front)
        low = np.where(smallest < 0, smallest / front, smallest / end)
        high = np.where(largest > 0, largest / front, largest / end)
        # Where no corner is near the eye plane, the corners' own quotients bound.
        whole = depth.min(axis=0) - error >= clip_start
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            quotient = value / depth
            margin = error * (1 + np.abs(quotient)) / (depth - error)
            low = np.where(whole, (quotient - margin).min(axis=0), low)
            high = np.where(whole, (quotient + margin).max(axis=0), high)
        return low, high

    def sides(self, across: Floats, depth: Floats, edges: Floats) -> tuple[Floats, Floats]:
        """Return normals (4, 3) and offsets (4,) of the view volume's sides.

        `across` (4, 3), towards each side, and `depth` (3,) are rows of the inverse of the axes;
        `edges` (4,) is where the window ends on each side.
        """
        return across - edges[:, None] * depth, np.zeros(4)

    def depths(self, rng: np.random.Generator, ends: Floats, count: int) -> Floats:
        """Return depths all over a clip range, (count,): as many near the camera as far away."""
        return np.exp(rng.uniform(*np.log(ends), count))

    def depth_step(self, step: float, depth: Floats, start: float, end: float) -> Any:
        """Return the step of a depth buffer at a depth; `step` is that of equal steps, metres."""
        return step * depth**2 / (end * start)

    def nearness(self, low: Any, high: Any, room: float) -> tuple[Any, Any]:
        """Return least and most 1 / t between two t, which are not negative, high perhaps inf.

        `room` is for rounding, relative; where it is negative the range is surely covered.
        """
        return (1 - room) / high, (1 + room) / np.maximum(low, 0)
