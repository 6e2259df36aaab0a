"""How each type of Blender's camera sets a view window: by its lens, its scale or its ranges.

It stands here, not with the projections, as these know nothing of Blender.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ...projections import EQUIRECTANGULAR, ORTHOGRAPHIC, PERSPECTIVE, Projection
from ...projections.projection import Edges
from ..versions import lens

_SENSOR = 36.0  # millimetres; what Blender's own cameras have
_LEAST_LENS = 1.0  # millimetres: Blender's least focal length
_RANGES = "longitude_min", "longitude_max", "latitude_min", "latitude_max"

Around = Callable[[float], Edges]  # the window of a flat film whose fitted side is so long


class Lens(NamedTuple):
    """A type of Blender's camera."""

    projection: Projection
    kind: str  # its type; of a panorama, that of the panorama
    # The window of a `bpy.types.Camera`, by the length of the sensor's fitted side in millimetres.
    window: Callable[[Any, float, Around], Edges]
    # Sets a camera with a horizontal sensor, for a window.
    settings: Callable[[Edges], dict[str, Any]]


def lens_of(projection: Projection) -> Lens:
    """Return the type of Blender's camera that projects so."""
    return next(own for own in LENSES if own.projection == projection)


def _shifts(edges: Edges) -> dict[str, Any]:
    left, right, bottom, top = edges
    extent = right - left
    return {"shift_x": (left + right) / 2 / extent, "shift_y": (bottom + top) / 2 / extent}


def _perspective(edges: Edges) -> dict[str, Any]:
    """Return the lens, and a larger sensor where the lens would be too short."""
    extent = edges[1] - edges[0]
    return _shifts(edges) | {
        "type": "PERSP",
        "lens": max(_SENSOR / extent, _LEAST_LENS),
        "sensor_width": max(_SENSOR, _LEAST_LENS * extent),
    }


def _orthographic(edges: Edges) -> dict[str, Any]:
    return {"type": "ORTHO", "ortho_scale": edges[1] - edges[0]} | _shifts(edges)


def _ranges(data: Any, sensor: float, around: Around) -> Edges:
    """Return the ranges of longitude and latitude; shifts count in lengths of these."""
    west, east, south, north = (getattr(lens(data), name) for name in _RANGES)
    x = data.shift_x * (east - west)
    y = data.shift_y * (north - south)
    return west + x, east + x, south + y, north + y


def _panorama(edges: Edges) -> dict[str, Any]:
    kind = {"type": "PANO", "panorama_type": "EQUIRECTANGULAR"}
    return kind | dict(zip(_RANGES, edges, strict=True))


LENSES = (
    Lens(PERSPECTIVE, "PERSP", lambda data, size, around: around(size / data.lens), _perspective),
    Lens(ORTHOGRAPHIC, "ORTHO", lambda data, _, around: around(data.ortho_scale), _orthographic),
    Lens(EQUIRECTANGULAR, "EQUIRECTANGULAR", _ranges, _panorama),
)
