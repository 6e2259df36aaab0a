"""The base class of the types of cameras: a subclass each, in its own file, with its formulas.

The defaults are those of a camera with all rays from the eye and a flat film: its picture is
linear in the film position, and straight lines are straight in it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..arrays import Array, Floats

Vectors = Floats  # (3, ...)
Lengths = Floats | float
Ray = tuple[Array, Array]  # origins and directions
Formulas = dict[str, tuple[str, str]]  # of "o" and "d": the right side, and a remark
Edges = tuple[float, float, float, float]  # of a view window: left, right, bottom, top


@dataclass(frozen=True)
class Projection(ABC):
    """A type of camera. World vectors are (3, n) or (3, 1), film positions (n,), window units."""

    name: ClassVar[str]  # in files, too
    # A ray's origin and direction, for readers.
    formulas: ClassVar[Formulas]
    # Whether o and d are linear in the film position. Only then the sweep can find what is seen.
    # Else all rays begin in the eye, and what the axes are multiplied by is at most 1.
    is_linear: ClassVar[bool] = True
    shares_direction: ClassVar[bool] = False  # else all rays share their origin, the eye
    sees_behind: ClassVar[bool] = False  # the clip range may begin behind the camera
    farthest: ClassVar[float] = np.inf  # window units: the film ends before this

    @abstractmethod
    def ray(self, eye: Array, x: Array, y: Array, right: Array, up: Array, forward: Array) -> Ray:
        """Return origins and directions of the rays through film positions (x, y)."""

    def terms(self, x: float, y: float, frame: Floats) -> Floats:
        """Return the sum of the absolute terms of a ray, by component, (3,).

        It bounds the rounding of a ray as `certified/rounding.py` has it. `x` and `y` bound the
        absolute terms of a film position; `frame` (4, 3) is right, up, forward and the eye.
        """
        right, up, forward, _ = frame
        return np.abs([x * right, y * up, forward]).sum(axis=0)

    def scale(self, depth: Lengths, y: Lengths = 0.0) -> Any:
        """Return how many metres the window's unit is at a depth (t), at height y of the film."""
        return depth

    def slant(self, reach: float) -> float:
        """Return how far an error of 1 in every coordinate moves a point on a window's plane."""
        return 1 + reach

    def film(self, xyz: Vectors, middle: float) -> tuple[Floats, Floats, Floats]:
        """Return where points appear on the film, and their t, (n,) each; NaN where nowhere.

        `xyz` (3, n) is right, up, depth, in metres; `middle` is the x of the window's middle.
        """
        x, y, depth = xyz
        scale = self.scale(np.where(depth > 0, depth, np.nan))
        return x / scale, y / scale, depth

    def beside(self, xyz: Vectors, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Return how far from film positions (n,) points appear, where lines are straight."""
        u, v, _ = self.film(xyz, 0.0)
        return u - x, v - y

    def box(
        self, xyz: Vectors, error: Floats, clip_start: float, edges: Edges, eps: float
    ) -> tuple[list[Floats], list[Floats], Floats, Floats]:
        """Return bounds of the film position and t of rays that hit polygons.

        Parameters
        ----------
        xyz : (3, k, m) float64
            Right, up and depth of the k corners of m convex polygons, metres.
        error : (m,) float64
            Their largest error, metres.
        clip_start : float
            Metres; nearer parts do not count.
        edges : Edges
            Rays do not pass outside.
        eps : float
            That of the rays' own floating-point type.

        Returns
        -------
        low, high : [x, y], (m,) float64 each
            NaN where they are not known.
        nearest, farthest : (m,) float64
        """
        *sides, depth = xyz
        nearest, farthest = depth.min(axis=0) - error, depth.max(axis=0) + error
        front = np.maximum(nearest, clip_start)  # what can be seen is at least as deep
        ends = [self._window_range(v, depth, error, front, clip_start) for v in sides]
        return [low for low, _ in ends], [high for _, high in ends], nearest, farthest

    def _window_range(
        self, value: Floats, depth: Floats, error: Floats, front: Floats, clip_start: float
    ) -> tuple[Floats, Floats]:
        """Return where m polygons, from `front` on, lie on the window: lowest, highest, (m,) each.

        `value` and `depth`, (k, m), are the corners' right or up, and depth, metres, off by at most
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
