"""Equirectangular: the film is longitude and latitude, and all rays begin in the eye.

The window is in radians. Longitude 0, latitude 0 is the middle of what the camera looks at, to the
right is east, up is north: Cycles' panorama of that name ("Equirectangular", `kernel/camera/
projection.h`), whose shift counts in widths and heights of the picture. With orthonormal axes a
direction is of unit length but for rounding, so that t is the distance from the eye, as Cycles' own
depth pass and clip range have it for panoramas.

Straight lines are curved in the picture. Boxes on the film are those of cones around polygons.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..arrays import Array, Floats
from .projection import Edges, Formulas, Lengths, Projection, Ray, Vectors
from .sine import sine

# Radians: far above the rounding of an angle that is found here, where it is not near pi / 2.
_ANGLE = 1e-9
_WIDEST, _NEAR_POLE = 1.5, 1e-6  # radians: a cone is narrower, and farther from the poles


@dataclass(frozen=True)
class Equirectangular(Projection):
    """A panorama. The window is in radians: longitudes, latitudes."""

    name = "equirectangular"
    is_linear = False
    farthest = 1024.0  # many turns, and few enough for `sine`
    formulas: ClassVar[Formulas] = {
        "o": ("e", ""),
        "d": (
            "cos v sin u right + sin v up + cos v cos u forward",
            "u is the longitude, v the latitude; of unit length: t is the distance",
        ),
    }

    def ray(self, eye: Array, x: Array, y: Array, right: Array, up: Array, forward: Array) -> Ray:
        """Return the eye, and directions of unit length."""
        east, north, ahead = _direction(x, y)
        return eye, east * right + north * up + ahead * forward

    def terms(self, x: float, y: float, frame: Floats) -> Floats:
        """Return (x + y + 2) times the axes' own terms, for a bound of 8 u times that.

        An angle is off by 4 u of its terms (x or y); its sine and cosine by that and 4 u more. So
        what an axis is multiplied by, a product of two of them, is off by (4 x + 4 y + 9) u; with
        the product by the axis and two sums, all of it is (4 x + 4 y + 12) u of the axes.
        """
        return (x + y + 2) * np.abs(frame[:3]).sum(axis=0)

    def scale(self, depth: Lengths, y: Lengths = 0.0) -> Any:
        """Return how many metres a radian of longitude is at a distance and a latitude."""
        return depth * np.maximum(np.abs(np.cos(y)), _ANGLE)

    def slant(self, reach: float) -> float:
        """Return 1: the error across a ray counts."""
        return 1.0

    def film(self, xyz: Vectors, middle: float) -> tuple[Floats, Floats, Floats]:
        """Return longitudes at most half a turn from the window's middle, latitudes, distances."""
        x, y, depth = xyz
        level = np.hypot(x, depth)
        longitude = np.arctan2(x, depth)
        turns = np.round((longitude - middle) / (2 * np.pi))
        return longitude - 2 * np.pi * turns, np.arctan2(y, level), np.hypot(level, y)

    def beside(self, xyz: Vectors, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Return where points appear on the plane that touches the sphere of directions there."""
        quarter = np.pi / 2
        axes = (x + quarter, np.zeros_like(y)), (x, y + quarter), (x, y)
        right, up, depth = ((xyz * _direction(*axis)).sum(axis=0) for axis in axes)
        depth = np.where(depth > 0, depth, np.nan)
        return right / self.scale(depth, y), up / depth

    def box(
        self, xyz: Vectors, error: Floats, clip_start: float, edges: Edges, eps: float
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

        A cone of half angle r at latitude b spans longitudes of +- arcsin(sin r / cos b), unless it
        holds a pole. The film may go on behind the poles, or around more than once: what may be
        seen in two places has no bounds on that side.
        """
        left, right, bottom, top = edges
        toward, sizes = _direction_and_size(xyz)
        axis, _ = _direction_and_size(toward.sum(axis=1))
        chord = _length(toward - axis[:, None]).max(axis=0)
        off = 512 * eps * (np.abs(edges).sum() + 6)
        turned = 4 * error / sizes.min(axis=0)
        wide = 2 * np.arcsin(chord / 2) + turned + off + _ANGLE
        farthest = (sizes.max(axis=0) + 2 * error) * (1 + off)
        nearest = (xyz * axis[:, None]).sum(axis=0).min(axis=0) - 2 * error - off * farthest

        longitude, latitude, _ = self.film(axis, (left + right) / 2)
        beyond = max(top - np.pi / 2, -np.pi / 2 - bottom, 0)
        wide = np.where((wide < _WIDEST) & (turned < 0.5), wide, np.nan)
        low, high, pole = latitude - wide, latitude + wide, np.pi / 2 - beyond - _NEAR_POLE
        half = np.arcsin(np.sin(wide) / np.cos(latitude)) + _ANGLE
        once = (longitude - half > right - 2 * np.pi) & (longitude + half < left + 2 * np.pi)
        half = np.where(once & (low > -pole) & (high < pole), half, np.nan)
        low, high = np.where(low > -pole, low, np.nan), np.where(high < pole, high, np.nan)
        return [longitude - half, low], [longitude + half, high], nearest, farthest


def _direction(x: Array, y: Array) -> tuple[Array, Array, Array]:
    """Return what right, up and forward are multiplied by at longitudes x and latitudes y, (n,)."""
    level = sine(y, 1)
    return level * sine(x), sine(y), level * sine(x, 1)


def _direction_and_size(v: Vectors) -> tuple[Vectors, Floats]:
    """Return unit vectors, and the lengths of `v` (3, ...); NaN where that is 0."""
    largest = np.abs(v).max(axis=0)
    v = v / largest  # whose squares neither over- nor underflow
    return v / _length(v), largest * _length(v)


def _length(v: Vectors) -> Floats:
    """Return the length of vectors (3, ...)."""
    return np.sqrt((v * v).sum(axis=0))
