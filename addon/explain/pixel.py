"""What one pixel's ray may meet: all that its derivation needs of a scene, and nothing else.

It stands alone: `reproducer.py` writes it to a file, and what is derived from that is the same.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, SceneError
from ..tracer.camera import Rays, camera_rays
from ..tracer.hits import NOTHING, Name
from ..tracer.world import WorldTriangles


@dataclass(frozen=True, eq=False)
class Candidate:
    """A triangle or an infinite plane that the ray may meet.

    Parameters
    ----------
    object : str
        Name of the object.
    instance, triangle : int
        As in a `Frame`: a plane has a number after all instances, and no triangle (NOTHING).
    points : (3, 3) float64
        The corners, a row each; of a plane (2, 3): its point and its normal. World space, metres.
    colors : (1, 4) or (3, 4) float32
        Linear RGBA: one, or one at each corner.
    mesh : str
    slot : int
        Material slot whose colour it is.
    """

    object: str
    instance: int
    triangle: int
    points: NDArray[np.float64]
    colors: NDArray[np.float32]
    mesh: str = ""
    slot: int = 0

    @property
    def is_plane(self) -> bool:
        """Whether it is an infinite plane."""
        return self.triangle == NOTHING

    @property
    def name(self) -> Name:
        """Instance and triangle: of two at the same t, the lower is seen."""
        return self.instance, self.triangle

    @property
    def title(self) -> str:
        """What a reader calls it."""
        if self.is_plane:
            return f"{self.object}, infinite plane"
        return f"{self.object}, triangle {self.triangle}"


@dataclass(frozen=True, eq=False)
class Pixel:
    """A camera, one of its pixels, and the candidates.

    Parameters
    ----------
    camera : Camera
    x, y : int
        Of the traced picture, the camera's region: (0, 0) is its lower left pixel.
    candidates : tuple of Candidate
        What is nearest first.
    background : (4,) float32
        Linear RGBA.
    first_plane : int
        The number of the scene's first infinite plane: that of its instances.
    triangles : int
        In the whole scene.
    left_out : int
        Candidates beyond the limit: none of them is nearer than what is seen.
    refused : int
        Triangles of the scene with a corner that is not finite in world space.
    source : str
        Where it comes from, for a reader.

    Raises
    ------
    SceneError
        If there is no such pixel.
    """

    camera: Camera
    x: int
    y: int
    candidates: tuple[Candidate, ...]
    background: NDArray[np.float32]
    first_plane: int = 0
    triangles: int = 0
    left_out: int = 0
    refused: int = 0
    source: str = ""

    def __post_init__(self) -> None:
        check_pixel(self.camera, self.x, self.y)

    @property
    def column(self) -> int:
        """Of the whole picture, of which the region is a part."""
        return self.camera.region.x0 + self.x

    @property
    def row(self) -> int:
        """Of the whole picture, from the bottom."""
        return self.camera.region.y0 + self.y

    def rays(self, dtype: np.dtype | type = np.float64) -> Rays:
        """Return its ray as the tracer has it, one of one."""
        return camera_rays(
            self.camera, np.array([self.column + 0.5]), np.array([self.row + 0.5]), dtype
        )

    @property
    def planes(self) -> list[Candidate]:
        """Those of the candidates that are infinite planes."""
        return [c for c in self.candidates if c.is_plane]

    def world_triangles(self) -> WorldTriangles:
        """Return the candidates that are triangles, as the tracer takes them."""
        kept = [c for c in self.candidates if not c.is_plane]
        if not kept:
            return WorldTriangles.none()
        return WorldTriangles(
            np.stack([c.points for c in kept], axis=2),
            np.array([c.instance for c in kept], np.int32),
            np.array([c.triangle for c in kept], np.int32),
        )

    @cached_property
    def origin(self) -> NDArray[np.float64]:
        """Where the ray begins, (3,) metres."""
        return self.rays().origins[:, 0]

    @cached_property
    def direction(self) -> NDArray[np.float64]:
        """Where it goes, (3,); its length is that at which the depth is 1."""
        return self.rays().directions[:, 0]


def check_pixel(camera: Camera, x: int, y: int) -> None:
    """Raise a SceneError if the traced picture has no pixel (x, y)."""
    size = camera.region.width, camera.region.height
    for name, value, count in (("x", x, size[0]), ("y", y, size[1])):
        if not isinstance(value, (int, np.integer)):
            raise SceneError(f"{name} of the pixel is {value!r}; it must be a whole number.")
        if not 0 <= value < count:
            raise SceneError(
                f"There is no pixel ({x}, {y}) in a picture of {size[0]} x {size[1]}: {name} must "
                f"be between 0 and {count - 1}. (0, 0) is the lower left."
            )
