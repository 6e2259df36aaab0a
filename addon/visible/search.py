"""Looks for a witness of each face, or for what hides it."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Index, parts
from ..certified.any_rays import decide
from ..scene import Scene
from ..tracer.camera import Rays, film_of
from ..tracer.hits import NOTHING
from ..tracer.progress import Work
from .boxes import Boxes, boxes_of
from .cells import Cells
from .cover import Cover
from .faces import Faces
from .found import HIDDEN, SEEN, UNDECIDED
from .hiding import patches
from .planes import before_planes
from .polygons import cut, middles, on_film
from .sights import Sights

_TOGETHER = 1 << 12  # pairs of faces that are compared in one step
_BOXES = 64  # of a face, that are divided
_FINER = 12  # times that boxes are divided
_TRIES = 3  # rays that tell nothing new of a face, before it is left to its boxes
_RAYS = 64  # through a face that shows next to nothing
_FACES = 64  # of those, at once


class Search:
    """The search for each of the m faces of a scene, until no more than `limit` may be seen of it.

    `seen`, `witness` (2, m) and `area` are those of `Visible`.
    """

    def __init__(self, scene: Scene, faces: Faces, limit: float) -> None:
        self._scene = scene
        self._faces = faces
        self._limit = limit
        self.seen = np.full(faces.count, HIDDEN, np.uint8)
        self.seen[faces.may_show] = UNDECIDED
        self.witness = np.full((2, faces.count), np.nan)

    def steps(self, cells: Cells, work: int) -> Work[None]:
        """Look for each face, and for what is before it, until nothing new is found."""
        faces = self._faces
        self._enter(cells.face, cells.at)
        undecided = np.flatnonzero(self.seen == UNDECIDED)
        boxes = yield from boxes_of(self._scene, faces, cells, undecided)
        self._bound(boxes)
        self._sights = Sights(self._scene, faces, self.seen != HIDDEN)
        self._cover = Cover(faces, self._low, self._high, work)
        self._covered = np.zeros(faces.count, bool)  # in one ray
        self._tries = np.zeros(faces.count, np.intp)  # since more was known of what is before it
        self._left = self.seen == UNDECIDED
        face: Index = np.flatnonzero(self._left)
        at = middles(faces, face, self._low[:, face], self._high[:, face])
        while len(face) and self._cover.work > 0:
            yield None
            face, at = yield from self._round(face, at)
        self._find_ground()
        yield from self._look_closely()
        yield from self._divide(boxes)
        self.area[self.seen != UNDECIDED] = 0

    def _enter(self, face: Index, at: Floats) -> None:
        self.seen[face] = SEEN
        self.witness[:, face] = at

    def _bound(self, boxes: Boxes) -> None:
        """Note in which box each face may be seen, and how much of it; planes cut that."""
        count = self._faces.count
        self._ground = np.full(count, NOTHING)
        self.area = boxes.areas(count)
        self._low, self._high = boxes.around(count)
        self._cut(np.flatnonzero(self.area))

    def _cut(self, some: Index) -> None:
        """Leave out what planes, or faces that cover all of their boxes, hide of some faces."""
        left = self._parts(some)
        low, high, area = on_film(self._faces, some, left)
        self._low[:, some] = np.fmax(self._low[:, some], low)
        self._high[:, some] = np.fmin(self._high[:, some], high)
        self.area[some] = np.fmin(self.area[some], area)
        self.area[some[np.isnan(left).all(axis=(0, 1))]] = 0
        self.seen[(self.seen == UNDECIDED) & (self.area == 0)] = HIDDEN

    def _parts(self, face: Index) -> Floats:
        """Return what is left of faces (n,), as polygons (k, 3, n) in world space."""
        faces = self._faces
        corners = faces.corners[:, face]
        value = np.ones(corners.shape)
        own = np.flatnonzero(self._ground[face] >= 0)
        height = faces.height(self._ground[face[own]], corners[:, own])
        value[:, own] = height.value + height.error
        polygons = cut(faces.points[:, corners].swapaxes(0, 1), value)
        box = self._low[:, face], self._high[:, face]
        return before_planes(self._scene, faces, polygons, *box)

    def _find_ground(self) -> None:
        """Find for each face that is left one that covers all of its box, if it is tried."""
        faces = self._faces
        face = np.flatnonzero(self.seen == UNDECIDED)
        which, base = self._cover.tried(face)
        found = faces.within(base, self._low[:, face[which]], self._high[:, face[which]])
        sure = found.inside.all(axis=0) & faces.clip.inside(found.least, found.most)
        self._ground[face[which[sure]]] = base[sure]
        self._cut(face)

    def _look(self, face: Index, at: Floats) -> Work[tuple[Index, Rays, Bools]]:
        """Trace n rays for faces; return what they see, the rays, and which may see the faces."""
        before, rays = yield from self._sights.look(at, face)
        # A ray along the picture's border may see what is wholly beyond it.
        inside = ((self._low[:, face] < at) & (at < self._high[:, face])).all(axis=0)
        own = (before == face) & inside
        self._enter(face[own], at[:, own])
        return before, rays, inside

    def _round(self, face: Index, at: Floats) -> Work[tuple[Index, Floats]]:
        """Trace rays, decide what they tell, and return the next ones: past edges."""
        faces = self._faces
        cover = self._cover
        covered = self._covered
        before, rays, inside = yield from self._look(face, at)
        self._left &= self.seen == UNDECIDED
        rows = np.flatnonzero(self._left[face])
        face = face[rows]
        before = before[rows]
        rays = rays.take(rows)
        self._tries[face] += 1
        for part in parts(len(face), _TOGETHER):
            self._tries[cover.add(face[part], before[part])] = 0
            yield None
        pierced = self._pierced(face, before)
        rows = np.flatnonzero(~covered[face] & inside[rows] & cover.holds(face, before))
        for met in (face, before):
            corners = faces.points[:, faces.corners[:, met[rows]]].swapaxes(0, 1)
            rows = rows[decide(rays.take(rows), corners).crossed]
        covered[face[rows]] = True
        whole = self._left & covered
        face, at = yield from cover.gaps(whole, self._tries)
        whole[face] = False
        self.seen[whole] = HIDDEN
        face, at = (np.concatenate(both, axis=-1) for both in zip((face, at), pierced, strict=True))
        self._left &= ~whole & (self._tries < _TRIES) & (self.area > self._limit)
        some = self._left[face]
        return face[some], at[:, some]

    def _pierced(self, face: Index, before: Index) -> tuple[Index, Floats]:
        """Return points of faces (n,) in front of what is before a part of them."""
        rows = np.flatnonzero((before >= 0) & ~self._cover.holds(face, before))
        face, before = face[rows], before[rows]
        height = self._faces.height(before, self._faces.corners[:, face])
        box = self._low[:, face], self._high[:, face]
        return face, middles(self._faces, face, *box, height.value)

    def _look_closely(self) -> Work[None]:
        """Look through many points of faces that few rays meet, so little may be seen of them."""
        random = np.random.default_rng(0)
        thin = np.flatnonzero((self.seen == UNDECIDED) & (self.area <= self._limit))
        for part in parts(len(thin), _FACES):
            face = thin[part]
            polygons = self._parts(face)
            shares = random.dirichlet(np.ones(len(polygons)), _RAYS)
            points = np.tensordot(shares, polygons, 1).swapaxes(0, 1).reshape(3, -1)
            x, y, _ = film_of(self._scene.camera, points)
            yield from self._look(np.tile(face, _RAYS), np.stack((x, y)))

    def _divide(self, boxes: Boxes) -> Work[None]:
        """Divide the boxes of faces that are left, and see whether each is covered by one patch."""
        count = self._faces.count
        for _ in range(_FINER):
            left = (self.seen == UNDECIDED) & (self.area > self._limit)
            left &= np.bincount(boxes.face, minlength=count) < _BOXES
            rows = np.flatnonzero(left[boxes.face])
            if not len(rows) or self._cover.work <= 0:
                break
            boxes = boxes.take(rows).quarters().within(self._low, self._high)
            divided = np.unique(boxes.face)
            still = [rows[:0]]
            for part in parts(len(boxes.face), _TOGETHER):
                covered = yield from self._covers(boxes.take(part))
                still.append(part.start + np.flatnonzero(~covered))
            boxes = boxes.take(np.concatenate(still))
            self.area[divided] = boxes.areas(count)[divided]
            hidden = (self.seen == UNDECIDED) & (self.area == 0)
            self.seen[hidden] = HIDDEN

    def _covers(self, boxes: Boxes) -> Work[Bools]:
        """Return in which of n boxes faces are hidden; look through the middles of others."""
        face, low, high = boxes
        covered = ~(low < high).all(axis=0)
        found = self._faces.within(face, low, high)
        covered |= found.beside | self._faces.clip.outside(found.least, found.most)
        rows = np.flatnonzero(~covered)
        at = (low + high) / 2
        which, base = self._cover.tried(face[rows])
        which = rows[which]
        least = patches(self._faces, base, at[:, which], low[:, which], high[:, which])
        covered[which[least > found.most[which]]] = True
        rows = np.flatnonzero(~covered)
        before, *_ = yield from self._look(face[rows], at[:, rows])
        self._cover.add(face[rows], before)
        return covered | (self.seen[face] == SEEN)
