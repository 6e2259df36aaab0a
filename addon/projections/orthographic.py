"""Orthographic: all rays are parallel, and a thing appears as large at any depth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ..arrays import Array, Floats
from .projection import Formulas, Lengths, Projection, Ray


@dataclass(frozen=True)
class Orthographic(Projection):
    """Rays along the view axis, beside one another. The window is in metres."""

    name = "orthographic"
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

    def scale(self, depth: Lengths, y: Lengths = 0.0) -> float:
        """Return 1: the window is in metres."""
        return 1.0

    def slant(self, reach: float) -> float:
        """Return 1: an error of the depth moves nothing."""
        return 1.0

    def _window_range(
        self, value: Floats, depth: Floats, error: Floats, front: Floats, clip_start: float
    ) -> tuple[Floats, Floats]:
        """Return the corners' own range."""
        return value.min(axis=0) - error, value.max(axis=0) + error
