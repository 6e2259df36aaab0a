"""Orthographic: all rays are parallel, and a thing appears as large at any depth.

Every function is that of the same name in `perspective.py`, which says what comes in and goes out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from .perspective import Floats


@dataclass(frozen=True)
class Orthographic:
    """Rays along the view axis, beside one another."""

    name: ClassVar[str] = "orthographic"
    in_files: ClassVar[bool | str] = True
    blender: ClassVar[str] = "ORTHO"
    is_parallel: ClassVar[bool] = True
    is_linear: ClassVar[bool] = True  # a ray is linear in the film position
    formulas: ClassVar[dict[str, tuple[str, str]]] = {
        "o": ("e + (u right + v up)", ""),
        "d": ("forward", "the same for all pixels: t is the depth"),
    }

    def ray(self, eye: Any, aside: Any, forward: Any) -> tuple[Any, Any]:
        """Return an origin beside the eye, and the direction that all share."""
        return eye + aside, forward

    def scale(self, depth: Any) -> float:
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
        return rng.uniform(*ends, count)

    def depth_step(self, step: float, depth: Floats, start: float, end: float) -> Any:
        """Return the step: all are equal."""
        return step

    def nearness(self, low: Any, high: Any, room: float) -> tuple[Any, Any]:
        """Return least and most -t, exactly; where high is inf, t may be negative, too."""
        return -high, np.where(np.isfinite(high), -low, np.inf)
