"""What the tracer gives back: one array for each output, row 0 at the bottom."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera
from .certainty import Certainty
from .hits import NOTHING, Name, Statistics
from .memory import check_memory

BYTES_PER_PIXEL = 4 * 4 + 8 + 3 * 3 * 8 + 3 * 4 + 1  # of a frame's arrays


@dataclass(eq=False)
class Frame:
    """A traced picture of h x w pixels: the camera's region.

    `color` is the mean over the samples of a pixel; everything else is that of the ray through
    the pixel's centre.
    """

    color: NDArray[np.float32]  # (h, w, 4) linear RGBA, alpha premultiplied
    t: NDArray[np.float64]  # (h, w) ray parameter = depth along the view axis, metres; inf: no hit
    position: NDArray[np.float64]  # (h, w, 3) world space, metres
    normal: NDArray[np.float64]  # (h, w, 3) world space, unit length
    barycentrics: NDArray[np.float64]  # (h, w, 3) weights of the triangle's corners
    object_index: NDArray[np.int32]  # (h, w) index into Scene.objects; NOTHING: no hit
    instance_index: NDArray[np.int32]  # (h, w) instances, then planes; NOTHING: no hit
    triangle_index: NDArray[np.int32]  # (h, w) index into Mesh.triangles; NOTHING: none
    certainty: NDArray[np.uint8]  # (h, w) Certainty of the surface that is seen
    rows_done: NDArray[np.bool_]  # (h,) False for rows that were not traced
    # All that an ambiguous pixel's ray may be said to see, by the pixel's index, row by row.
    ties: dict[int, frozenset[Name]] = field(default_factory=dict)
    cancelled: bool = False
    statistics: Statistics = field(default_factory=Statistics)

    @classmethod
    def empty(cls, camera: Camera) -> Frame:
        """Return a frame of the camera's region with no row done, its colour transparent.

        Raises
        ------
        PictureTooLargeError
            If there is not enough memory for it.
        """
        h, w = camera.region.height, camera.region.width
        check_memory(w, h, BYTES_PER_PIXEL)
        indices = [np.full((h, w), NOTHING, np.int32) for _ in range(3)]
        return cls(
            np.zeros((h, w, 4), np.float32),
            np.full((h, w), np.inf),
            *(np.zeros((h, w, 3)) for _ in range(3)),
            *indices,
            np.full((h, w), Certainty.NOT_CERTIFIED, np.uint8),
            np.zeros(h, bool),
        )

    @property
    def depth(self) -> NDArray[np.float64]:
        """Depth along the view axis, (h, w) metres, as Blender's Z pass has it; inf: no hit.

        Directions are not normalised, so it is t itself, for both kinds of camera.
        """
        return self.t

    def t_interval(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return two floats, (h, w) each, between which the exact t of a certified pixel lies.

        As t is rounded correctly, they are its neighbours. -inf to inf where nothing is certified.
        """
        known = self.certainty != Certainty.NOT_CERTIFIED
        return (
            np.where(known, np.nextafter(self.t, -np.inf), -np.inf),
            np.where(known, np.nextafter(self.t, np.inf), np.inf),
        )

    def wrong_against(self, certified: Frame) -> NDArray[np.bool_]:
        """Return which pixels, (h, w), see another surface than a certified frame of the scene.

        Where that is ambiguous, all that a ray moved infinitesimally may see is right.
        """
        wrong = (self.instance_index != certified.instance_index) | (
            self.triangle_index != certified.triangle_index
        )
        for pixel in np.flatnonzero(wrong).tolist():
            if may := certified.ties.get(pixel):
                name = int(self.instance_index.flat[pixel]), int(self.triangle_index.flat[pixel])
                wrong.flat[pixel] = name not in may
        return wrong

    def arrays(self) -> dict[str, NDArray]:
        """Return the arrays of a value a pixel, by name."""
        passes = self.passes()
        return {name: passes[name] for name in passes if name not in ("depth", "rows_done")}

    def passes(self) -> dict[str, NDArray]:
        """Return every output by name, in the order in which they are declared."""
        names = (
            "color",
            "depth",
            "t",
            "position",
            "normal",
            "barycentrics",
            "object_index",
            "instance_index",
            "triangle_index",
            "certainty",
            "rows_done",
        )
        return {name: getattr(self, name) for name in names}
