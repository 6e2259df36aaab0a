"""Equirectangular: the film is longitude and latitude, and all rays begin in the eye.

The window is in radians. Longitude 0, latitude 0 is the middle of what the camera looks at, to the
right is east, up is north: Cycles' panorama of that name ("Equirectangular", `kernel/camera/
projection.h`), whose shift counts in widths and heights of the picture. With orthonormal axes a
direction is of unit length but for rounding, so that t is the distance from the eye, as Cycles' own
depth pass and clip range have it for panoramas.

Straight lines are curved in the picture. Boxes on the film are those of cones around polygons.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from .orthographic import Orthographic
from .projection import Edges, Floats, Projection

# pi / 2 as a sum: integers below 2^20 times each of the first two, of 33 digits, are exact.
_QUARTER = 1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21
_TERMS = 18  # of the series: the first that is left out is below 2^-60
# Radians: far above the rounding of an angle that is found here, where it is not near pi / 2.
_ANGLE = 1e-9
_RANGES = "longitude_min", "longitude_max", "latitude_min", "latitude_max"
_WIDEST = 1.5  # radians: the half angle of a cone that is used


def sine_cosine(angle: Any) -> tuple[Any, Any]:
    """Return the sine and the cosine of angles (n,), radians, at most 2^20 of them.

    Each operation is one of IEEE 754, so that all machines find the same bits, however many angles
    are asked for together; a library's own sine may differ.

    Each is off by less than 2^-51, 4 u with u = 2^-53; of a float32 it is rounded once more. With k
    the nearest integer to angle / (pi / 2), the rest r = angle - k pi / 2 is off by two roundings
    of numbers below 0.79, u / 2 each. Horner's rule for

        sin r = r (1 - r^2 / (2 3) (1 - r^2 / (4 5) (1 - ...)))
        cos r = 1 - r^2 / (1 2) (1 - r^2 / (3 4) (1 - ...))

    rounds each difference by u / 2; what is inside counts by r^2 / 6 < 0.11 and r^2 / 2 < 0.31. So
    the sine's bracket is off by 0.8 u, and the sine by 1.2 u; the cosine by 1.4 u.
    """
    exact = np.asarray(angle, np.float64)
    turns = np.floor(exact * (2 / np.pi) + 0.5)
    rest = exact
    for part in _QUARTER:
        rest = rest - turns * part
    square = rest * rest
    sine, cosine = rest * _series(square, 2), _series(square, 1)
    quarter = turns % 4
    is_odd = quarter % 2 == 1
    found = np.where(is_odd, cosine, sine), np.where(is_odd, sine, cosine)
    signs = np.where(quarter >= 2, -1.0, 1.0), np.where(is_odd != (quarter >= 2), -1.0, 1.0)
    both = (sign * value for sign, value in zip(signs, found, strict=True))
    sine, cosine = (value.astype(np.asarray(angle).dtype)[()] for value in both)
    return sine, cosine


def _series(square: Floats, first: int) -> Floats:
    """Return 1 - r^2 / (k (k + 1)) (1 - r^2 / ((k + 2) (k + 3)) (1 - ...)) for k = `first`."""
    out = np.ones_like(square)
    for k in range(first + _TERMS - 2, 0, -2):
        out = 1 - square / (k * (k + 1)) * out
    return out


@dataclass(frozen=True)
class Equirectangular(Projection):
    """A panorama. The window is in radians: longitudes, latitudes."""

    name: ClassVar[str] = "equirectangular"
    in_files: ClassVar[bool | str] = "equirectangular"
    blender: ClassVar[str] = "EQUIRECTANGULAR"
    is_linear: ClassVar[bool] = False
    farthest: ClassVar[float] = 1024.0  # many turns, and few enough for `sine_cosine`
    formulas: ClassVar[dict[str, tuple[str, str]]] = {
        "o": ("e", ""),
        "d": (
            "cos v sin u right + sin v up + cos v cos u forward",
            "u is the longitude, v the latitude; of unit length: t is the distance",
        ),
    }

    def ray(self, eye: Any, x: Any, y: Any, right: Any, up: Any, forward: Any) -> tuple[Any, Any]:
        """Return the eye, and directions of unit length."""
        (east, ahead), (north, level) = sine_cosine(x), sine_cosine(y)
        return eye, level * east * right + north * up + level * ahead * forward

    def enclosing(
        self, eye: Any, x: Any, y: Any, right: Any, up: Any, forward: Any
    ) -> tuple[Any, Any]:
        """Return rays with components that no direction exceeds, negative and positive.

        What the axes are multiplied by is at most 1, but for less than ten roundings.
        """
        most = (np.abs(right) + np.abs(up) + np.abs(forward)) * (1 + 2.0**-40)
        return eye, most * np.array([-1.0, 1.0])

    def terms(self, x: float, y: float, frame: Floats) -> Floats:
        """Return (x + y + 2) times the axes' own terms, for a bound of 8 u times that.

        An angle is off by 4 u of its terms (x or y); its sine and cosine by that and 4 u more. So
        what an axis is multiplied by, a product of two of them, is off by (4 x + 4 y + 9) u; with
        the product by the axis and two sums, all of it is (4 x + 4 y + 12) u of the axes.
        """
        return (x + y + 2) * np.abs(frame[:3]).sum(axis=0)

    def scale(self, depth: Any, y: Any = 0.0) -> Any:
        """Return how many metres a radian of longitude is at a distance and a latitude."""
        return depth * np.maximum(np.abs(np.cos(y)), _ANGLE)

    def slant(self, reach: float) -> float:
        """Return 1: the error across a ray counts."""
        return 1.0

    def film(self, xyz: Floats, middle: float) -> tuple[Floats, Floats, Floats]:
        """Return longitudes at most half a turn from the window's middle, latitudes, distances."""
        x, y, depth = xyz
        level = np.hypot(x, depth)
        longitude = _beside(np.arctan2(x, depth), middle)
        return longitude, np.arctan2(y, level), np.hypot(level, y)

    def beside(self, xyz: Floats, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Return where points appear on the plane that touches the sphere of directions there."""
        (east, ahead), (north, level) = sine_cosine(x), sine_cosine(y)
        across = xyz[0] * ahead - xyz[2] * east
        outward = xyz[0] * east + xyz[2] * ahead
        depth = xyz[1] * north + outward * level
        depth = np.where(depth > 0, depth, np.nan)
        size = np.maximum(np.abs(level), _ANGLE)
        return across / depth / size, (xyz[1] * level - outward * north) / depth

    def box(
        self, xyz: Floats, error: Floats, clip_start: float, edges: Edges, eps: float
    ) -> tuple[list[Floats], list[Floats], Floats, Floats]:
        """Return longitudes, latitudes and distances of a cone around each polygon.

        The cone's axis is the mean direction of the corners, its half angle `wide` the largest to a
        corner: up to a right angle it is convex, and holds the polygon. `wide` is made larger by

        - what the corners' errors turn them, less than 4 error / distance;
        - 512 eps (X + Y + 6), X and Y the largest longitude and latitude: how far a ray's direction
          may lie beside its film position. By `terms` it is (4 X + 4 Y + 12) eps of the axes in
          world space, or less; camera space has at most 56 times that while the axes are sound
          (`candidates.has_sound_axes`: the inverse's rows are at most 16 long, the axes 2);
        - `_ANGLE` for the rounding here.

        Around the pole of the film, a cone of half angle r at latitude b spans longitudes of
        +- arcsin(sin r / cos b), or all, where it holds the pole. The film may go on behind the
        poles, or around more than once: what may then be seen twice spans all of it.
        """
        left, right, bottom, top = edges
        sizes = np.sqrt((xyz * xyz).sum(axis=0))
        units = xyz / sizes
        axis = units.sum(axis=1)
        axis = axis / np.sqrt((axis * axis).sum(axis=0))
        chord = np.sqrt(((units - axis[:, None]) ** 2).sum(axis=0)).max(axis=0)
        off = 512 * eps * (max(abs(left), abs(right)) + max(abs(bottom), abs(top)) + 6)
        turned = 4 * error / sizes.min(axis=0)
        wide = 2 * np.arcsin(chord / 2) + turned + off + _ANGLE
        wide = np.where((wide < _WIDEST) & (turned < 0.5), wide, np.nan)

        level = np.hypot(axis[0], axis[2])
        latitude = np.arctan2(axis[1], level)
        low, high = latitude - wide, latitude + wide
        pole = np.pi / 2 - 1e-6
        above, below = high > pole - max(top - pole, 0), low < max(-pole - bottom, 0) - pole
        half = np.arcsin(np.minimum(np.sin(wide) / level, 1)) + _ANGLE
        middle = _beside(np.arctan2(axis[0], axis[2]), (left + right) / 2)
        once = (middle - half > right - 2 * np.pi) & (middle + half < left + 2 * np.pi)
        half = np.where(once & ~above & ~below, half, np.inf)
        low, high = np.where(below, -np.inf, low), np.where(above, np.inf, high)
        farthest = (sizes.max(axis=0) + 2 * error) * (1 + off)
        nearest = (xyz * axis[:, None]).sum(axis=0).min(axis=0) - 2 * error - off * farthest
        return [middle - half, low], [middle + half, high], nearest, farthest

    def volume(self, edges: Edges, start: float, end: float) -> tuple[Projection, Edges, float]:
        """Return a box around the eye, as large as the clip range reaches."""
        return Orthographic(), (-end, end, -end, end), -end

    def window(
        self, data: Any, lens: Any, sensor: float, around: Callable[[float], Edges]
    ) -> Edges:
        """Return the ranges of longitude and latitude; shifts count in lengths of these."""
        west, east, south, north = (float(getattr(lens, name)) for name in _RANGES)
        x, y = data.shift_x * (east - west), data.shift_y * (north - south)
        return west + x, east + x, south + y, north + y

    def settings(self, edges: Edges) -> dict[str, float]:
        """Return the ranges of longitude and latitude."""
        return dict(zip(_RANGES, edges, strict=True))


def _beside(angle: Floats, middle: float) -> Floats:
    """Return angles, radians, at most half a turn from a middle."""
    return angle - 2 * np.pi * np.round((angle - middle) / (2 * np.pi))
