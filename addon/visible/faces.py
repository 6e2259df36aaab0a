"""All faces of a scene on the camera's film: where each may appear, and exact signs of its corners.

A face is a triangle of an instance; faces are numbered through all instances. Edge k of face f is
k m + f. The film is measured in pixels. What bounds a face there is `certified/sweep/`.
"""

from __future__ import annotations

from itertools import combinations
from typing import NamedTuple

import numpy as np

from ..arrays import Bools, Floats, Index
from ..certified.bounds import bound, cross_magnitude
from ..certified.sweep.depth_buffer import ClipRange
from ..certified.sweep.edge_functions import set_up
from ..certified.sweep.film import DELTA, Film
from ..certified.sweep.vertices import Vertices
from ..scene import Camera, Scene
from ..tracer.progress import Work
from ..tracer.vector import cross, dot, transform_points
from .signs import Signs, exact_signs

EDGES = (1, 2), (2, 0), (0, 1)  # the corners of a face's edges, in their order
_ROOM = 4  # pixels around a box in which functions are evaluated, too


class Within(NamedTuple):
    """What is known of n faces in boxes of the film."""

    beside: Bools  # (n,) none of the box's rays meets the face
    inside: Bools  # (3, n) the box surely is on the inner side of each edge
    least: Floats  # (n,) the nearness of what is met; -inf where the side that is seen is not known
    most: Floats


class Faces:
    """The m faces of a scene.

    `start` (k + 1,) is the first of each instance; `corners` (3, m) indexes `points` (3, v), in
    world space. Corners with the same coordinates have the same number in `welded` (v,), and those
    that are seen as one point in `shown` (v,).
    `at` (2, 2, v) is from where to where each appears, `room` (v,) how far off the middle may be.
    `low`, `high` (2, m) enclose each face on the film, `near`, `far` (m,) its depth; t is at most
    `last` (m,); `nearest` (m,) bounds its nearness; one `in_clip` (m,) surely is in the clip range.
    `turn` (m,) is the side that the camera sees: 1 the back, -1 the front, 0 none. That is the sign
    of d . n for rays d that meet it, n = (b - a) x (c - a). `ends` (2, 3 m) are edges' vertices: of
    partners, in the same order; `side` (3 m,) is where their faces are: 1, as `turn`, is the right.
    `may_show` (m,) is False for what is edge-on, not finite, or outside the clip range or region.
    """

    def __init__(self, scene: Scene) -> None:
        self.film = Film(scene.camera)
        self.clip = ClipRange(scene.camera)
        meshes = [scene.meshes[i.mesh] for i in scene.instances]
        self.start = np.cumsum([0, *(len(mesh.triangles) for mesh in meshes)])
        self.count = int(self.start[-1])
        first = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
        points = [
            transform_points(scene.instance_matrices[..., k], mesh.vertices.T)
            for k, mesh in enumerate(meshes)
        ]
        self.points = np.concatenate([np.zeros((3, 0)), *points], axis=1)
        corners = [mesh.triangles.T + v for mesh, v in zip(meshes, first, strict=False)]
        self.corners = np.concatenate([np.zeros((3, 0), np.intp), *corners], axis=1)
        self.vertices = Vertices.empty(int(first[-1]), np.int32)
        self.film.enter(self.vertices, 0, self.points)
        self.welded = _welded(self.points)
        self.shown = self._shown(scene.camera)

    @classmethod
    def of(cls, scene: Scene) -> Work[Faces]:
        """Return the faces of a scene, in steps."""
        faces = cls(scene)
        yield None
        faces._enclose(scene.camera)
        yield None
        faces._find_turns()
        yield None
        faces._pair_edges()
        return faces

    def _shown(self, camera: Camera) -> Index:
        """Return the numbers of points, the same if seen as one: known along an axis of space."""
        across = camera.forward == 0
        if camera.projection.shares_direction and across.sum() == 2:
            return _welded(np.where(across[:, None], self.points, 0))
        return self.welded

    def _enclose(self, camera: Camera) -> None:
        """Find where each face may appear."""
        v = self.vertices
        constant, slope = self.film.depth_error
        own = constant + slope * v.size
        self.near = self.of_corners(v.depth - own).min(axis=0)
        self.far = self.of_corners(v.depth + own).max(axis=0)
        room = 0.0 if camera.projection.shares_direction else 4 * self.film.ray_error
        self.last = self.far + room * np.abs(self.far)
        self.in_clip = (self.near * (1 - room) > camera.clip_start) & (self.last < camera.clip_end)
        self.nearest = self.of_corners(v.nearest).max(axis=0, initial=-np.inf)
        self.nearest[~np.isfinite(self.of_corners(v.depth)).all(axis=0)] = np.inf
        r = camera.region
        first, last = np.array([[[r.x0], [r.y0]], [[r.x1], [r.y1]]], np.float64)
        # As film.py has it: what is farther beside the picture truly lies on that side of it.
        beyond = 2 * max(camera.width, camera.height)
        constant, slope = self.film.place
        self.room = 1.01 * (constant + (slope + beyond * self.film.weight) * v.size) / v.w
        self.room[~v.ahead] = np.inf
        margin = self.room + 2 * DELTA
        at = np.clip(np.nan_to_num((v.x, v.y)), -beyond, beyond)
        self.at = np.stack((at - margin, at + margin))
        self.low = np.maximum(self.of_corners(self.at[0]).min(axis=0), first)
        self.high = np.minimum(self.of_corners(self.at[1]).max(axis=0), last)
        self.may_show = self.of_corners(v.finite).all(axis=0)
        self.may_show &= (self.far >= camera.clip_start) & (self.near <= camera.clip_end)
        self.may_show &= (self.low < self.high).all(axis=0)

    def _find_turns(self) -> None:
        self.turn = np.zeros(self.count, np.int8)
        some = np.flatnonzero(self.may_show)
        self.turn[some] = self.signs(*self.corners[:, some]).sign
        self.may_show &= self.turn != 0

    def of_corners(self, values: Floats | Bools) -> Floats:
        """Return what is known of vertices, (..., v), for the corners of faces, (3, ..., m)."""
        return np.stack([values[..., corner] for corner in self.corners])

    def _pair_edges(self) -> None:
        """Find for each edge another one with the same two ends.

        Each has one partner at most, or is its own. Where more meet, those of neighbours in the
        list of faces are partners.
        """
        first, last = (np.concatenate([self.corners[k] for k in end]) for end in np.array(EDGES).T)
        a, b = self.welded[first], self.welded[last]
        self.ends = np.where(a < b, (first, last), (last, first))
        self.side = np.where(a < b, 1, -1) * np.tile(self.turn, 3)
        key = np.minimum(a, b) * np.int64(len(self.welded)) + np.maximum(a, b)
        every = np.arange(len(key))
        order = np.argsort(key.reshape(3, -1).T.ravel(), kind="stable")
        order = every.reshape(3, -1).T.ravel()[order]
        starts = np.diff(key[order], prepend=-1) != 0
        first = np.flatnonzero(starts)[np.cumsum(starts) - 1]
        second = np.flatnonzero((every - first) % 2 == 1)
        self.mate = every.copy()
        self.mate[order[second]] = order[second - 1]
        self.mate[order[second - 1]] = order[second]

    def beyond(self, edge: Index) -> Index:
        """Return the faces that continue those of edges on their other sides, (n,); -1 for none."""
        mate = self.mate[edge]
        goes_on = (mate != edge) & (self.side[edge] == -self.side[mate])
        return np.where(goes_on, mate % self.count, -1)

    def box(self, edge: Index) -> tuple[Floats, Floats]:
        """Return boxes of the film around edges, from low to high, (2, n) each."""
        low, high = self.at[:, :, self.ends.take(edge, axis=1)]
        return low.min(axis=1), high.max(axis=1)

    def inside(self, edge: Index, point: Index) -> Signs:
        """Return on which side of edges of faces points are: positive within."""
        first, last = self.ends.take(edge, axis=1)
        found = self.signs(first, last, point)
        turn = self.side[edge]
        return Signs(found.sign * turn, found.value * turn, found.error)

    def height(self, face: Index, point: Index) -> Signs:
        """Return how far points (..., n) are before faces (n,): positive on the eye's side."""
        a, b, c = self.corners[:, face]
        found = self.signs(a, b, c, point)
        turn = self.turn[face]
        return Signs(found.sign * turn, found.value * turn, found.error)

    def signs(self, a: Index, b: Index, c: Index, before: Index | None = None) -> Signs:
        """Return how points, by their numbers (...), turn for the camera, as `turn` of a face.

        Or, if `before` is given: for an eye in those points.
        """
        points = np.broadcast_arrays(a, b, c, *(() if before is None else (before,)))
        every = [each.ravel() for each in points]
        camera = self.film.camera
        parallel = before is None and camera.projection.shares_direction
        eye = camera.forward if parallel else camera.origin
        corners = [self.points.take(each, axis=1) for each in every]
        v = np.broadcast_to(eye[:, None], (3, len(every[0]))) if before is None else corners.pop()
        sides = corners[1] - corners[0], corners[2] - corners[0]
        size = cross_magnitude(*np.abs(sides))
        arm = v if parallel else corners[0] - v
        value = dot(arm, cross(*sides))
        error = bound(dot(np.abs(arm), size), np.abs(arm))
        sign = np.sign(value)
        doubt = np.flatnonzero(~(np.abs(value) > error) | ~np.isfinite(value))
        own = [self.welded[each[doubt]] for each in every]
        same = np.any([a == b for a, b in combinations(own, 2)], axis=0)
        sign[doubt[same]] = value[doubt[same]] = error[doubt[same]] = 0
        doubt = doubt[~same]
        doubtful = [corner[:, doubt] for corner in corners]
        sign[doubt] = exact_signs(doubtful, v[:, doubt], parallel)
        shape = points[0].shape
        return Signs(
            sign.astype(np.int8).reshape(shape), value.reshape(shape), error.reshape(shape)
        )

    def within(self, faces: Index, low: Floats, high: Floats) -> Within:
        """Evaluate n faces in boxes of the film, (2, n) each."""
        origin = np.floor(low)
        reach = np.maximum(*(high - origin)) + _ROOM
        found = set_up(
            self.film, self.vertices, self.corners[:, faces], self.nearest[faces], origin, reach
        ).take(slice(len(faces)))
        of_1, of_y, of_x = found.coefficients
        (x0, y0), (x1, y1) = low - origin - 0.5, high - origin - 0.5
        up, down = of_y * y1, of_y * y0
        right, left = of_x * x1, of_x * x0
        least = of_1 + np.minimum(up, down) + np.minimum(right, left)
        most = of_1 + np.maximum(up, down) + np.maximum(right, left)
        inside = least[:3] > found.edge_error
        beside = (most[:3] < -found.edge_error).any(axis=0)
        # One that is not sure may have the other orientation.
        beside &= found.sure | inside.any(axis=0)
        beside |= (self.low[:, faces] > high).any(axis=0) | (self.high[:, faces] < low).any(axis=0)
        nearest = np.fmin(most[3] + found.nearness_error, self.nearest[faces])
        return Within(beside, inside, least[3] - found.nearness_error, nearest)


def _welded(points: Floats) -> Index:
    """Return the same number for the same coordinates, (v,)."""
    order = np.lexsort(points)
    other = (np.diff(points[:, order], axis=1) != 0).any(axis=0)
    out = np.empty(points.shape[1], np.intp)
    out[order] = np.cumsum(np.r_[0, other][: len(order)])
    return out
