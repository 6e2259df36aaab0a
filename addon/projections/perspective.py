"""Perspective: all rays begin in the eye, and what is twice as far appears half as large."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ..arrays import Array
from .projection import Formulas, Projection, Ray


@dataclass(frozen=True)
class Perspective(Projection):
    """The rays of a pinhole camera. The window is at depth 1."""

    name = "perspective"
    formulas: ClassVar[Formulas] = {
        "o": ("e", ""),
        "d": ("u right + v up + forward", "not normalised: t is the depth"),
    }

    def ray(self, eye: Array, x: Array, y: Array, right: Array, up: Array, forward: Array) -> Ray:
        """Return the eye, and directions that are one unit deep."""
        return eye, x * right + y * up + forward
