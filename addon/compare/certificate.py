"""The camera certificate: the tracer and Blender see the same points in the same places.

In come positions of known points on the film, as the tracer's camera has them and as Blender's own
matrix has them; out goes the largest distance in pixels, held against what float32 may do. It is
made before any picture: pictures of different cameras are not compared.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..arrays import Array, Floats
from ..scene import Camera, SceneError
from ..tracer.camera import film_of, pixel_size
from .bounds import U32

POINTS = 1024  # besides the volume's corners
SEED = 1
# Blender's projection, and the axes of its camera without their scale, are float32: each number has
# been rounded about so many times.
ROUNDINGS = 16


class CameraMismatchError(SceneError):
    """The tracer's camera is not Blender's."""


class CameraCertificate(NamedTuple):
    """How far apart, in pixels, the two cameras see the point on which they agree least."""

    largest: float
    allowed: float
    points: int

    @property
    def passed(self) -> bool:
        """Whether the distance is one of rounding."""
        return self.largest <= self.allowed

    def to_dict(self) -> dict[str, Any]:
        """Return the certificate as JSON can hold it."""
        return self._asdict() | {"passed": self.passed}

    def line(self) -> str:
        """Return it in words."""
        return (
            f"camera certificate: {self.points:,} known points lie at most {self.largest:.2g} px "
            f"apart in the tracer's camera and in Blender's own matrix (allowed: "
            f"{self.allowed:.2g} px)"
        )

    def check(self) -> None:
        """Raise a CameraMismatchError if it is not passed."""
        if not self.passed:
            raise CameraMismatchError(
                f"The tracer's camera is not Blender's: known points lie up to {self.largest:.3g} "
                f"pixels apart, and rounding allows {self.allowed:.2g}. Their pictures cannot be "
                "compared. This is a fault of Reference Tracer: please report the camera's "
                "settings."
            )


def known_points(camera: Camera) -> Floats:
    """Return points all over the view volume, its corners first: (3, n) world space, metres."""
    w, rng = camera.window, np.random.default_rng(SEED)
    ends = np.array((camera.clip_start, camera.clip_end), np.float64)
    x, y, depth = (
        v.ravel() for v in np.meshgrid((w.left, w.right), (w.bottom, w.top), ends, indexing="ij")
    )
    x = np.append(x, rng.uniform(w.left, w.right, POINTS))
    y = np.append(y, rng.uniform(w.bottom, w.top, POINTS))
    depth = np.append(depth, camera.projection.depths(rng, ends, POINTS))
    scale = camera.projection.scale(depth)
    right, up, forward, origin = (
        v[:, None] for v in (camera.right, camera.up, camera.forward, camera.origin)
    )
    return origin + scale * (x * right + y * up) + depth * forward


def certify(camera: Camera, points: Floats, film: Floats) -> CameraCertificate:
    """Return the certificate of a camera.

    `points` (3, n) are in world space, as :func:`known_points` gives them; `film` (2, n) is where
    Blender's own matrix has them, in pixels of the whole picture.
    """
    x, y, depth = film_of(camera, points)
    distance = np.hypot(film[0] - x, film[1] - y)
    allowed = _allowed(camera, points, depth)
    worst = int(np.argmax(np.where(np.isfinite(distance), distance / allowed, np.inf)))
    largest = float(np.nan_to_num(distance[worst], nan=np.finfo(float).max))
    return CameraCertificate(min(largest, np.finfo(float).max), float(allowed[worst]), len(depth))


def _allowed(camera: Camera, points: Array, depth: Array) -> Floats:
    """Return how far float32 may move each point's place on the film, (n,) pixels.

    Turned axes move it by what it is away from the camera, seen from there; a projection's rounding
    moves it by its share of the picture's size and of the shift.
    """
    w, (width, height) = camera.window, pixel_size(camera)
    away = np.abs(points - camera.origin[:, None]).sum(axis=0)
    away = away / camera.projection.scale(depth)
    reach = max(map(abs, (w.left, w.right, w.bottom, w.top)))
    return ROUNDINGS * U32 * ((away + reach) / min(width, height) + camera.width + camera.height)
