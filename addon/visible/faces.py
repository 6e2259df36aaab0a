"""All faces of a scene on the camera's film: where each may appear, and its edge functions.

A face is a triangle of an instance; faces are numbered through all instances. The film is measured
in pixels. What bounds a face there is `certified/sweep/`: its projected vertices, edge functions
and nearness. On which side of a plane a point lies, `certified/bounds.py` says.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Index
from ..certified.bounds import FromPoint, Parallel
from ..certified.integers import cross, dot, integers, sub
from ..certified.sweep.depth_buffer import ClipRange
from ..certified.sweep.edge_functions import set_up
from ..certified.sweep.film import DELTA, Film
from ..certified.sweep.vertices import Vertices
from ..scene import Scene
from ..tracer.camera import Rays
from ..tracer.vector import transform_points

_ROOM = 4  # pixels around a face in which its functions are evaluated, too
_SET_UP = 1 << 14  # faces set up together
_EDGES = ((1, 2), (2, 0), (0, 1))  # of the edge functions, in their order
_UNKNOWN = 2  # a turn that nobody asked for yet


class Faces:
    """The m faces of a scene.

    `start` (k + 1,) is the first of each instance; `corners` (3, m) indexes `points` (3, v), in
    world space. Corners with the same coordinates have the same number in `welded` (v,).
    `low`, `high` (2, m) enclose each face on the film; `nearest` (m,) bounds its nearness.
    `may_show` (m,) is False for what is not finite, or wholly outside the clip range or the region.
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
        self._enclose(scene)
        self.welded = _welded(self.points)
        self._pair_edges()
        self._known = np.zeros(self.count, bool)
        self._turn = np.full(self.count, _UNKNOWN, np.int8)
        self._coefficients = np.empty((self.count, 12))  # of 1, y and x: 4 each
        self._origin = np.empty((2, self.count))
        self.edge_error = np.empty(self.count)
        self.nearness_error = np.empty(self.count)
        self.sure = np.empty(self.count, bool)

    def _enclose(self, scene: Scene) -> None:
        """Find where each face may appear: within `low` and `high`, or, if not `may_show`, nowhere.

        A vertex that is `certain` is off by DELTA; the box of another one says which pixels'
        centres a face may cover.
        """
        camera = scene.camera
        v = self.vertices
        constant, slope = self.film.depth_error
        own = constant + slope * v.size
        before = self._of_corners(v.depth + own < camera.clip_start).all(axis=0)
        behind = self._of_corners(v.depth - own > camera.clip_end).all(axis=0)
        self.nearest = self._of_corners(v.nearest).max(axis=0, initial=-np.inf)
        self.nearest[~np.isfinite(self._of_corners(v.depth)).all(axis=0)] = np.inf
        region = camera.region
        first = np.array([[region.x0], [region.y0]], np.float64)
        last = np.array([[region.x1], [region.y1]], np.float64)
        low = np.where(v.certain, (v.x, v.y), v.box[:, :2].T + 0.5) - 2 * DELTA
        low = np.where(v.certain, low, low - 1)
        high = np.where(v.certain, (v.x, v.y), -v.box[:, 2:].T + 0.5) + 2 * DELTA
        high = np.where(v.certain, high, high + 1)
        self.at = np.stack((low, high))
        self.at[:, :, ~v.ahead] = np.array([[[-np.inf]], [[np.inf]]])
        self.low = np.maximum(self._of_corners(self.at[0]).min(axis=0), first)
        self.high = np.minimum(self._of_corners(self.at[1]).max(axis=0), last)
        self.may_show = self._of_corners(v.finite).all(axis=0) & ~before & ~behind
        self.may_show &= (self.low < self.high).all(axis=0)

    def _of_corners(self, values: Floats | Bools) -> Floats:
        """Return what is known of vertices, (..., v), for the corners of faces, (3, ..., m)."""
        return np.stack([values[..., corner] for corner in self.corners])

    def _pair_edges(self) -> None:
        """Find for each edge k of face f, as k m + f, another one with the same two ends.

        Each has one partner at most, or is its own. Where more meet, those of neighbours in the
        list of faces are partners.
        """
        ends = self.welded[self.corners]
        a = np.concatenate([ends[i] for i, _ in _EDGES])
        b = np.concatenate([ends[j] for _, j in _EDGES])
        self._forward = a < b
        key = np.minimum(a, b) * np.int64(len(self.welded)) + np.maximum(a, b)
        every = np.arange(len(key))
        order = np.argsort(key.reshape(3, -1).T.ravel(), kind="stable")
        order = every.reshape(3, -1).T.ravel()[order]
        starts = np.diff(key[order], prepend=-1) != 0
        number = every - np.flatnonzero(starts)[np.cumsum(starts) - 1]
        second = np.flatnonzero(number % 2 == 1)
        self._mate = every
        self._mate[order[second]] = order[second - 1]
        self._mate[order[second - 1]] = order[second]

    def need(self, faces: Index) -> None:
        """Have the functions of some faces ready."""
        new = np.unique(faces[~self._known[faces]])
        for begin in range(0, len(new), _SET_UP):
            some = new[begin : begin + _SET_UP]
            origin = np.floor(self.low[:, some])
            reach = np.maximum(*(self.high[:, some] - origin)) + _ROOM
            found = set_up(
                self.film,
                self.vertices,
                self.corners[:, some],
                self.nearest[some],
                origin,
                reach,
            ).take(slice(len(some)))
            self._coefficients[some] = found.coefficients.reshape(12, -1).T
            self._origin[:, some] = origin + 0.5
            self.edge_error[some] = found.edge_error
            self.nearness_error[some] = found.nearness_error
            self.sure[some] = found.sure
        self._known[new] = True

    def at_points(self, faces: Index, x: Floats, y: Floats) -> Floats:
        """Return edge functions and nearness at film positions (n,): (4, n)."""
        of_1, of_y, of_x = self._functions(faces)
        x0, y0 = self._origin[:, faces]
        return of_1 + of_y * (y - y0) + of_x * (x - x0)

    def nearness_at(self, faces: Index, x: Floats, y: Floats) -> Floats:
        """Return the nearness of n faces at film positions (..., n)."""
        of_1, of_y, of_x = self._functions(faces)[:, 3]
        x0, y0 = self._origin[:, faces]
        return of_1 + of_y * (y - y0) + of_x * (x - x0)

    def between(self, faces: Index, low: Floats, high: Floats) -> tuple[Floats, Floats]:
        """Return the least and the most of edge functions and nearness in boxes, (4, n) each.

        The boxes of the film go from `low` to `high`, (2, n) each.
        """
        of_1, of_y, of_x = self._functions(faces)
        origin = self._origin[:, faces]
        (x0, y0), (x1, y1) = low - origin, high - origin
        up, down = of_y * y1, of_y * y0
        right, left = of_x * x1, of_x * x0
        least = of_1 + np.minimum(up, down) + np.minimum(right, left)
        return least, of_1 + np.maximum(up, down) + np.maximum(right, left)

    def lines(self, faces: Index) -> Floats:
        """Return edges as a + b x + c y of the film position, roughly: (a b c, 3, n)."""
        of_1, of_y, of_x = self._functions(faces)[:, :3]
        x, y = self._origin[:, faces]
        return np.stack((of_1 - of_x * x - of_y * y, of_x, of_y))

    def _functions(self, faces: Index) -> Floats:
        """Return the coefficients of 1, y and x, (3, 4, n)."""
        return np.ascontiguousarray(self._coefficients.take(faces, axis=0).T).reshape(3, 4, -1)

    def turn(self, faces: Index) -> Index:
        """Return which side the camera sees of faces: 1 the back, -1 the front, 0 none.

        That is the sign of d . n for the rays that meet it, n = (b - a) x (c - a).
        """
        new = np.unique(faces[self._turn[faces] == _UNKNOWN])
        if len(new):
            self._turn[new] = self.orientation(*self.corners[:, new])
        return self._turn[faces]

    def orientation(self, a: Index, b: Index, c: Index) -> Index:
        """Return how three points, by their numbers (n,), turn for the camera, as :meth:`turn`."""
        own = [self.welded[k] for k in (a, b, c)]
        out = np.zeros(len(a), np.int8)
        some = np.flatnonzero((own[0] != own[1]) & (own[1] != own[2]) & (own[2] != own[0]))
        corners = self.points[:, np.stack((a[some], b[some], c[some]))].swapaxes(0, 1)
        every = np.arange(len(some))
        camera = self.film.camera
        ray = Rays(camera.origin[:, None], camera.forward[:, None])
        if camera.projection.shares_direction:
            ends = ray.origins, ray.origins
            f = Parallel(ray.directions, *ends, corners).fractions(every, ray)
            values = f.denominator, f.denominator_error
            out[some] = _signs(*values, corners, ray.directions, True)
        else:
            f = FromPoint(ray.origins, np.abs(ray.directions), corners).fractions(every, ray)
            values = f.numerator, f.numerator_error
            out[some] = _signs(*values, corners, ray.origins, False)
        return out

    def side(self, faces: Index, point: Index) -> Index:
        """Return on which side of faces' planes points are: as :meth:`turn` on the camera's side.

        0 where they are in the plane.
        """
        shared = (self.welded[self.corners[:, faces]] == self.welded[point]).any(axis=0)
        some = np.flatnonzero(~shared)
        corners = self.points[:, self.corners[:, faces[some]]].swapaxes(0, 1)
        origins = self.points[:, point[some]]
        f = FromPoint(origins, np.zeros((3, 1)), corners)
        found = f.fractions(np.arange(len(some)), Rays(origins, origins))
        out = np.zeros(len(faces), np.int8)
        values = found.numerator, found.numerator_error
        out[some] = _signs(*values, corners, origins, False)
        return out

    def across(self, edge: Index) -> tuple[Index, Bools]:
        """Return the edges (k m + f) that continue a surface beyond others, and whether they do.

        They do if, as the camera sees them, the two faces lie on both sides of the edge.
        """
        mate = self._mate[edge]
        own = self.turn(edge % self.count) * np.where(self._forward[edge], 1, -1)
        other = self.turn(mate % self.count) * np.where(self._forward[mate], 1, -1)
        return mate, (mate != edge) & (own == -other) & (own != 0)

    def ends(self, edge: Index) -> tuple[Index, Index]:
        """Return the vertices of edges, k m + f."""
        k, face = np.divmod(edge, self.count)
        pairs = np.array(_EDGES)[k].T
        return self.corners[pairs[0], face], self.corners[pairs[1], face]


def _signs(value: Floats, error: Floats, corners: Floats, v: Floats, parallel: bool) -> Index:
    """Return the signs of values: where their bounds leave a doubt, in integers.

    They are (a - v) . n of the corners (3, 3, n), or v . n if `parallel`; v is (3, n) or (3, 1).
    """
    found = np.sign(value)
    doubt = np.flatnonzero(~(np.abs(value) > error) | ~np.isfinite(value))
    v = np.broadcast_to(v, corners.shape[1:])[:, doubt]
    lengths, _ = integers(np.hstack((*corners[..., doubt], *(() if parallel else (v,)))))
    count = len(doubt)
    a, b, c = (lengths[k * count : (k + 1) * count] for k in range(3))
    along, _ = integers(v) if parallel else (lengths[3 * count :], 0)
    for k in range(count):
        normal = cross(sub(b[k], a[k]), sub(c[k], a[k]))
        exact = dot(along[k] if parallel else sub(a[k], along[k]), normal)
        found[doubt[k]] = (exact > 0) - (exact < 0)
    return found.astype(np.int8)


def _welded(points: Floats) -> Index:
    """Return the same number for the same coordinates, (v,)."""
    order = np.lexsort(points)
    other = (np.diff(points[:, order], axis=1) != 0).any(axis=0)
    out = np.empty(points.shape[1], np.intp)
    out[order] = np.cumsum(np.r_[0, other][: len(order)])
    return out
