"""Where instances are on the film: by their bounding boxes, before any of them is expanded.

In comes a scene; out goes what every instance's box says of it: whether it may be in view, how near
it comes, and which pixels it may cover.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....scene import Region, Scene
from ...vector import Vectors, transform_points
from .depth_buffer import DepthBuffer
from .film import Film, Vertices

_MARGIN = 1.0  # pixels around the region that count as in view, and around a box as its own


@dataclass(frozen=True, eq=False)
class InstanceBoxes:
    """The boxes of n instances.

    `in_view` (n,) is False for what no ray of the region meets. `depth` (n,) is the least of its
    corners, in metres. Pixels outside `low` to `high`, (2, n) x and y, both included, are not
    covered, and nothing is nearer than `nearest` (n,), a nearness (`edge_functions.py`).
    """

    in_view: NDArray[np.bool_]
    depth: NDArray[np.float64]
    low: NDArray[np.int32]
    high: NDArray[np.int32]
    nearest: NDArray[np.float64]

    @classmethod
    @np.errstate(all="ignore")
    def of(cls, scene: Scene, film: Film) -> InstanceBoxes:
        """Project the bounding boxes of all instances."""
        corners, size = _corners(scene)
        count = corners.shape[2]
        camera, region = film.camera, film.camera.region
        # What lies between the corners was rounded like them, from numbers of at most this size.
        size = 4 * (size + np.abs(camera.origin).max())
        vertices = Vertices.empty(8 * count, np.int32)
        film.enter(vertices, 0, corners.reshape(3, 8 * count))
        p, q, w, depth, ahead = (
            getattr(vertices, name).reshape(8, count) for name in ("p", "q", "w", "depth", "ahead")
        )
        constant, slope = film.place
        place, weight = constant + slope * size, film.weight * size
        own = film.depth_error[0] + film.depth_error[1] * size
        outside = (depth + own < camera.clip_start).all(axis=0)
        outside |= (depth - own > camera.clip_end).all(axis=0)
        for value, first, last in ((p, region.x0, region.x1), (q, region.y0, region.y1)):
            for sign, end in ((1, first - _MARGIN), (-1, last + _MARGIN)):
                error = place + abs(end) * weight
                outside |= (sign * (value - end * w) < -error).all(axis=0)
        # In a box that is wholly before the eye nothing appears beside its corners, by more than
        # the margin where that is wide enough for all rounding.
        far = max(camera.width, camera.height)
        clear = ahead & (place + far * weight < 0.25 * _MARGIN * w)
        clear = clear.all(axis=0) & film.is_sound
        box = vertices.box.reshape(8, count, 4).min(axis=0).T
        margin = int(_MARGIN)
        return cls(
            ~outside if film.is_sound else np.ones(count, bool),
            np.nan_to_num(depth.min(axis=0)),
            np.where(clear, box[:2] - margin, np.iinfo(np.int32).min),
            np.where(clear, -box[2:] + margin, np.iinfo(np.int32).max),
            np.where(clear, film.nearest(depth.min(axis=0), size), np.inf),
        )

    def in_region(self, region: Region) -> NDArray[np.bool_]:
        """Return which instances may be in view in a region, (n,)."""
        out = self.in_view.copy()
        for axis, (first, last) in enumerate(((region.x0, region.x1), (region.y0, region.y1))):
            out &= (self.low[axis] < last) & (self.high[axis] >= first)
        return out

    def hidden(self, instances: NDArray[np.integer], depths: DepthBuffer) -> NDArray[np.bool_]:
        """Return which of these instances lie wholly behind what a depth buffer holds."""
        region = depths.region
        ends = np.array([[region.x0], [region.y0]]), np.array([[region.x1 - 1], [region.y1 - 1]])
        low = np.clip(self.low[:, instances], *ends) - ends[0]
        high = np.clip(self.high[:, instances], *ends) - ends[0]
        farthest = [depths.farthest_around(*box) for box in np.concatenate((low, high)).T.tolist()]
        return self.nearest[instances] < np.array(farthest)


def _corners(scene: Scene) -> tuple[Vectors, NDArray[np.float64]]:
    """Return the corners of all boxes in world space, (3, 8, n), and their numbers' size, (n,)."""
    low, high = np.array([m.bounds for m in scene.meshes])[scene.instance_meshes].transpose(1, 2, 0)
    matrices = scene.instance_matrices
    ends = [
        np.stack([(low, high)[corner >> axis & 1][axis] for axis in range(3)])
        for corner in range(8)
    ]
    corners = np.stack([transform_points(matrices, end) for end in ends], axis=1)
    reach = np.maximum(np.abs(low), np.abs(high))
    size = (np.abs(matrices[:3, :3]) * reach).sum(axis=1) + np.abs(matrices[:3, 3])
    return corners, size.max(axis=0)
