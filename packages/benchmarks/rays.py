"""A camera's rays as the peers take them: one array row a ray, float32."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Camera


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
    w = camera.window
    x = w.left + (np.arange(camera.width) + 0.5) / camera.width * (w.right - w.left)
    y = w.bottom + (np.arange(camera.height) + 0.5) / camera.height * (w.top - w.bottom)
    rows = slice(min(every // 2, camera.height - 1), None, every)
    y = y[rows]
    near = camera.clip_start
    film = x[None, :, None], y[:, None, None]
    axes = camera.right, camera.up, camera.forward
    eye, directions = camera.projection.ray(camera.origin, *film, *axes)
    directions = np.broadcast_to(directions, (len(y), len(x), 3))
    origins = eye + near * directions
    pixels = camera.width * camera.height
    return Rays(_float32(origins), _float32(directions), camera.clip_end - near, pixels, rows)


def _float32(v: NDArray[np.float64]) -> NDArray[np.float32]:
    return np.ascontiguousarray(v.reshape(-1, 3), dtype=np.float32)
