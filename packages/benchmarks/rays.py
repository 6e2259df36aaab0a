"""A camera's rays as the peers take them: one array row a ray, float32."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Camera
from reference_tracer.tracer.camera import camera_rays


@dataclass(frozen=True, eq=False)
class Rays:
    """Rays through the centres of pixels, row by row from the lowest, world space, metres.

    They begin at the clip start, as what is nearer is not seen: t counts from there.
    """

    origins: NDArray[np.float32]  # (n, 3)
    directions: NDArray[np.float32]  # (n, 3), one unit deep along the view axis
    length: float  # t of the clip end
    of: int  # rays of the whole picture
    rows: slice  # of the picture, that they pass through

    @property
    def count(self) -> int:
        """Rays that there are here."""
        return len(self.origins)


def rays_of(camera: Camera, every: int = 1) -> Rays:
    """Return a camera's rays, or a sample of them: those of every so many rows.

    Whole rows, as neighbours make the work of a ray tracer easier, and it shall be as easy.
    """
    rows = slice(min(every // 2, camera.height - 1), None, every)
    y, x = np.indices((camera.height, camera.width))[:, rows].reshape(2, -1) + 0.5
    own = camera_rays(camera, x, y)
    near = camera.clip_start
    pixels = camera.width * camera.height
    directions = np.broadcast_to(own.directions, (3, len(x)))
    origins = own.origins + near * directions
    return Rays(_float32(origins), _float32(directions), camera.clip_end - near, pixels, rows)


def _float32(v: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.ascontiguousarray(v.T, dtype=np.float32)
