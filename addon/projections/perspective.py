"""Perspective: all rays begin in the eye, and what is twice as far appears half as large."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from .projection import Edges, Floats, Projection, shifts

_SENSOR = 36.0  # millimetres; what Blender's own cameras have
_LEAST_LENS = 1.0  # millimetres: Blender's least focal length


@dataclass(frozen=True)
class Perspective(Projection):
    """The rays of a pinhole camera. The window is at depth 1."""

    name: ClassVar[str] = "perspective"
    in_files: ClassVar[bool | str] = False
    blender: ClassVar[str] = "PERSP"
    formulas: ClassVar[dict[str, tuple[str, str]]] = {
        "o": ("e", ""),
        "d": ("u right + v up + forward", "not normalised: t is the depth"),
    }

    def ray(self, eye: Any, x: Any, y: Any, right: Any, up: Any, forward: Any) -> tuple[Any, Any]:
        """Return the eye, and directions that are one unit deep."""
        return eye, x * right + y * up + forward

    def window_range(
        self, value: Floats, depth: Floats, error: Floats, front: Floats, clip_start: float
    ) -> tuple[Floats, Floats]:
        """Return the range of value / depth over each triangle."""
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
        """Return the sides of a pyramid with its tip in the eye."""
        return across - edges[:, None] * depth, np.zeros(4)

    def window(
        self, data: Any, lens: Any, sensor: float, around: Callable[[float], Edges]
    ) -> Edges:
        """Return the window that the lens makes of the sensor."""
        return around(sensor / data.lens)

    def settings(self, edges: Edges) -> dict[str, float]:
        """Return the lens, and a larger sensor where the lens would be too short."""
        extent = edges[1] - edges[0]
        lens = {"lens": max(_SENSOR / extent, _LEAST_LENS)}
        return lens | {"sensor_width": max(_SENSOR, _LEAST_LENS * extent)} | shifts(edges)
