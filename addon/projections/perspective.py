"""Perspective: all rays begin in the eye, and what is twice as far appears half as large."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

from ..arrays import Array
from .projection import Edges, Formulas, Projection, Ray, shifts

_SENSOR = 36.0  # millimetres; what Blender's own cameras have
_LEAST_LENS = 1.0  # millimetres: Blender's least focal length


@dataclass(frozen=True)
class Perspective(Projection):
    """The rays of a pinhole camera. The window is at depth 1."""

    name = "perspective"
    in_files = False
    blender = "PERSP"
    formulas: ClassVar[Formulas] = {
        "o": ("e", ""),
        "d": ("u right + v up + forward", "not normalised: t is the depth"),
    }

    def ray(self, eye: Array, x: Array, y: Array, right: Array, up: Array, forward: Array) -> Ray:
        """Return the eye, and directions that are one unit deep."""
        return eye, x * right + y * up + forward

    def window(
        self, data: Any, lens: Any, sensor: float, around: Callable[[float], Edges]
    ) -> Edges:
        """Return the window that the lens makes of the sensor."""
        return around(sensor / data.lens)

    def settings(self, edges: Edges) -> dict[str, Any]:
        """Return the lens, and a larger sensor where the lens would be too short."""
        extent = edges[1] - edges[0]
        return shifts(edges) | {
            "type": self.blender,
            "lens": max(_SENSOR / extent, _LEAST_LENS),
            "sensor_width": max(_SENSOR, _LEAST_LENS * extent),
        }
