"""Orthographic: all rays are parallel, and a thing appears as large at any depth."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..arrays import Array, Floats
from .projection import Edges, Formulas, Projection, Ray, shifts


@dataclass(frozen=True)
class Orthographic(Projection):
    """Rays along the view axis, beside one another. The window is in metres."""

    name = "orthographic"
    in_files = True
    blender = "ORTHO"
    shares_direction = True
    sees_behind = True
    formulas: ClassVar[Formulas] = {
        "o": ("e + (u right + v up)", ""),
        "d": ("forward", "the same for all pixels: t is the depth"),
    }

    def ray(self, eye: Array, x: Array, y: Array, right: Array, up: Array, forward: Array) -> Ray:
        """Return origins beside the eye, and the direction that all share."""
        return eye + (x * right + y * up), forward

    def terms(self, x: float, y: float, frame: Floats) -> Floats:
        """Return those of an origin: the direction is not rounded."""
        right, up, _, eye = frame
        return np.abs([x * right, y * up, eye]).sum(axis=0)

    def scale(self, depth: Any, y: Any = 0.0) -> float:
        """Return 1: the window is in metres."""
        return 1.0

    def slant(self, reach: float) -> float:
        """Return 1: an error of the depth moves nothing."""
        return 1.0

    def window_range(
        self, value: Floats, depth: Floats, error: Floats, front: Floats, clip_start: float
    ) -> tuple[Floats, Floats]:
        """Return the corners' own range."""
        return value.min(axis=0) - error, value.max(axis=0) + error

    def sides(self, across: Floats, depth: Floats, edges: Floats) -> tuple[Floats, Floats]:
        """Return the sides of a box."""
        return across, -edges

    def depths(self, rng: np.random.Generator, ends: Floats, count: int) -> Floats:
        """Return depths spread evenly."""
        return rng.uniform(ends[0], ends[1], count)

    def depth_step(self, step: float, depth: Floats, start: float, end: float) -> Floats | float:
        """Return the step: all are equal."""
        return step

    def nearness(self, low: Any, high: Any, room: float) -> tuple[Any, Any]:
        """Return least and most -t, exactly; where high is inf, t may be negative, too."""
        return -high, np.where(np.isfinite(high), -low, np.inf)

    def window(
        self, data: Any, lens: Any, sensor: float, around: Callable[[float], Edges]
    ) -> Edges:
        """Return the window as wide as the camera's scale."""
        return around(data.ortho_scale)

    def settings(self, edges: Edges) -> dict[str, Any]:
        """Return the scale and the shift."""
        return {"type": self.blender, "ortho_scale": edges[1] - edges[0]} | shifts(edges)
