"""Certifies that the tracer's camera is Blender's: both see known points in the same places.

The points are projected by the tracer's camera and by Blender's own matrix. The largest distance
between the two, in pixels, is compared with what float32 may move. This is done before any picture
is drawn: pictures of different cameras are not compared.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import Array, Floats
from ..scene import Camera, SceneError
from ..tracer.camera import camera_rays, film_of, pixel_size
from .bounds import U32

POINTS = 1024  # besides the volume's corners
SEED = 1
# How often Blender has rounded, in float32, each number of its projection and of its camera's axes
# without their scale.
ROUNDINGS = 16


# Clip starts, at least metres: how deep points are of a view volume that has no end.
_ENDLESS = 1e4


class CameraMismatchError(SceneError):
    """The tracer's camera is not Blender's."""


class CameraCertificate(NamedTuple):
    """How far apart the two cameras see the point on which they agree least, in pixels."""

    largest: float
    allowed: float
    points: int

    @property
    def passed(self) -> bool:
        """Whether rounding accounts for the distance."""
        return self.largest <= self.allowed

    def to_dict(self) -> dict[str, object]:
        """Return the certificate as JSON can hold it."""
        return self._asdict() | {"passed": self.passed}

    def line(self) -> str:
        """Return it as a sentence."""
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
    """Return points all over the view volume, its corners first: (3, n) float64, world space."""
    rng = np.random.default_rng(SEED)
    start, end = camera.clip_start, camera.clip_end
    ends = np.array((start, end if end < np.inf else _ENDLESS * max(abs(start), 1.0)))
    corners = np.meshgrid((0.0, camera.width), (0.0, camera.height), ends, indexing="ij")
    x, y, depth = np.reshape(corners, (3, 8))
    x = np.append(x, rng.uniform(0, camera.width, POINTS))
    y = np.append(y, rng.uniform(0, camera.height, POINTS))
    if camera.projection.sees_behind:
        depths = rng.uniform(ends[0], ends[1], POINTS)
    else:  # as many near the camera as far away
        start, end = np.log(ends)
        depths = np.exp(rng.uniform(start, end, POINTS))
    return camera_rays(camera, x, y).at(np.append(depth, depths))


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
    return CameraCertificate(largest, float(allowed[worst]), len(depth))


def _allowed(camera: Camera, points: Array, depth: Array) -> Floats:
    """Return how far float32 may move each point on the film, (n,) pixels.

    The rounding of the axes moves a point in proportion to its distance from the camera, as seen
    from there; that of the projection in proportion to the picture's size and its shift.
    """
    w = camera.window
    width, height = pixel_size(camera)
    away = np.abs(points - camera.origin[:, None]).sum(axis=0)
    away = away / camera.projection.scale(depth)
    reach = max(map(abs, (w.left, w.right, w.bottom, w.top)))
    return ROUNDINGS * U32 * ((away + reach) / min(width, height) + camera.width + camera.height)
