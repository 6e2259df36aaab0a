"""Where instances and triangles are on the film: the boxes of pixels that they may cover.

In comes a scene. Its instances' bounding boxes say, before any of them is expanded, whether they
may be in view, how near they come, and which pixels they may cover. Of expanded triangles the boxes
come from those of their vertices; by them the triangles are sorted from the front to the back, into
depth bins: how many is the scene's own number.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from ...scene import Region, Scene
from ...tracer.candidates import pixel_bounds
from ...tracer.vector import Index, Vectors, gather, grouped, largest, parts, transform_points
from ...tracer.world import world_corners
from .chunks import Expanded
from .depth_buffer import DepthBuffer
from .film import Film, Vertices

BINS = 256  # of nearness, into which triangles are sorted
_GROWTH = 1.2  # of depth bins
_FIRST = 0.5  # of the first bin, of the surface that is in front: a box is more than its triangle
_SAMPLE = 1 << 14  # triangles, about, that are asked how deep the scene is
_MARGIN = 1.0  # pixels around the region that count as in view, and around a box as its own
_TOGETHER = 1 << 15  # triangles at a time


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

    @property
    def area(self) -> NDArray[np.float64]:
        """How many pixels the boxes have, (n,)."""
        width, height = self.high - self.low.astype(np.float64) + 1
        return width * height

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
    x, y, z = (np.abs(matrices[:3, k]) * reach[k] for k in range(3))
    size = x + y + z + np.abs(matrices[:3, 3])
    return corners, size.max(axis=0)


def boxes_of(
    scene: Scene, film: Film, expanded: Expanded
) -> tuple[Index, Index, NDArray[np.float64]]:
    """Return lowest and highest x and y of triangles, (2, m) each, within the whole picture.

    And the most that the nearness of each can be, (m,).
    """
    vertices, corners = expanded.vertices, expanded.corners
    kind = vertices.box.dtype
    packed = vertices.box.view(np.int64 if kind.itemsize == 2 else np.complex128).ravel()
    count = corners.shape[1]
    low, high, nearest = np.empty((2, count), kind), np.empty((2, count), kind), np.empty(count)
    ends = np.array([[film.camera.width - 1], [film.camera.height - 1]], kind)
    for part in parts(count, _TOGETHER):
        some = corners[:, part].astype(np.intp)
        box = reduce(np.minimum, [gather(packed, c).view(kind) for c in some]).reshape(-1, 4).T
        np.maximum(box[:2], 0, out=low[:, part])
        np.minimum(np.negative(box[2:], out=high[:, part]), ends, out=high[:, part])
        nearest[part] = largest(*(gather(vertices.nearest, c) for c in some))
    if not vertices.ahead.all() or not vertices.finite.all():
        _mend(scene, film, expanded, low, high)
    return low, high, nearest


def _mend(scene: Scene, film: Film, expanded: Expanded, low: Index, high: Index) -> None:
    """Mend the boxes of triangles with a corner that is not before the eye, or not finite."""
    vertices, corners = expanded.vertices, expanded.corners
    whole = replace(film.camera, region=Region(0, 0, film.camera.width, film.camera.height))
    finite = vertices.finite.take(corners).all(axis=0)
    high[:, ~finite] = -1
    some = np.flatnonzero(finite & ~vertices.ahead.take(corners).all(axis=0))
    for part in np.split(some, range(_TOGETHER, len(some), _TOGETHER)):
        world = world_corners(scene, *expanded.names.of(part))
        x0, x1, y0, y1 = pixel_bounds(whole, world, reach=1.0)
        low[:, part], high[:, part] = (x0, y0), (x1 - 1, y1 - 1)


def by_depth(seen: Index, nearest: NDArray[np.float64], low: Index, high: Index) -> list[Index]:
    """Split the triangles that are seen into depth bins, from the front to the back.

    The first holds somewhat fewer pixels of boxes than the union of all boxes has: about what one
    surface would have that covers it all. Every other is larger than the one before, as the more
    there is in front, the less is left to be hidden. So there are as many bins as the logarithm of
    the surfaces behind one another, and what a refreshed depth buffer may save is worth its price.
    All that is estimated, from some thousand triangles.
    """
    step = 1 + len(seen) // _SAMPLE
    some = seen[::step]
    (x0, y0), (x1, y1) = low.take(some, axis=1), high.take(some, axis=1)
    area = np.multiply(x1 - x0 + 1, y1 - y0 + 1, dtype=np.float32)
    union = _FIRST * (int(x1.max()) + 1 - int(x0.min())) * (int(y1.max()) + 1 - int(y0.min()))
    if step * area.sum(dtype=np.float64) < 2 * union or BINS < 3:
        return [seen]
    near = nearest.take(some)
    first, last = near.min(), near.max()
    scale = (BINS - 1) / (last - first) if last > first else 0.0

    def depth(nearness: NDArray[np.float64]) -> NDArray[np.uint8]:
        return np.clip((last - nearness) * scale, 0, BINS - 1).astype(np.uint8)

    before = np.cumsum(np.bincount(depth(near), area, BINS)) * (step / union)
    of_depth = (np.log1p(before * (_GROWTH - 1)) / np.log(_GROWTH)).astype(np.uint8)
    own = np.empty(len(seen), np.uint8)
    for part in parts(len(seen), _TOGETHER):
        own[part] = of_depth.take(depth(gather(nearest, seen[part])))
    bins = grouped(own, int(of_depth[-1]) + 1)
    return [seen.take(part) for part in bins if len(part)]
