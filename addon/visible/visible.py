"""Decides of each face of a scene whether its camera sees it."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Index, parts
from ..certified.any_rays import decide
from ..certified.arithmetic import sound_steps
from ..methods import Method
from ..rendering import hits as trace_hits
from ..scene import Scene, SceneError
from ..tracer.camera import Rays, film_of
from ..tracer.hits import Statistics
from ..tracer.progress import Progress, Work, result_of, scaled
from ..tracer.settings import Settings
from .cells import TOGETHER, TOP, Cells, behind_plane, finer, quarters, scale_of
from .cover import Cover
from .faces import Faces
from .found import HIDDEN, SEEN, UNDECIDED, Visible
from .hiding import patches
from .polygons import before_planes, middles, on_film
from .sights import Sights

LIMIT = 1e-6  # square pixels
WORK = 1 << 24  # pairs of faces that are compared, and of edges and faces
_ROOM = 2.0**-8  # pixels around what may be seen, so that more than a corner is there
_TOGETHER = 1 << 12  # pairs of faces that are compared in one step
_CELLS = 64  # of a face, that are divided
_FINER = 12  # times that cells of a pixel are divided
_TRIES = 6
_RAYS = 64  # through each face of which little may be seen; and as many of them at once


def visible(scene: Scene, limit: float = LIMIT, work: int = WORK) -> Visible:
    """Decide which faces of a scene its camera sees.

    Parameters
    ----------
    limit : float
        Square pixels: if no more than that may be seen of a face, it stays undecided.
    work : int
        About how many pairs, of faces and of edges and faces, may be compared: then the rest is
        undecided.

    Raises
    ------
    SceneError
        If the camera is a panorama.
    """
    return result_of(steps(scene, limit, work))


@sound_steps
def steps(scene: Scene, limit: float = LIMIT, work: int = WORK) -> Work[Visible]:
    """Decide as :func:`visible`, in steps."""
    camera = scene.camera
    if not camera.projection.is_linear:
        raise SceneError(
            f"Camera '{camera.name}' is {camera.projection.name}: which faces are seen is decided "
            "for perspective and orthographic cameras"
        )
    scale = scale_of(scene)
    scene = finer(scene, scale)
    yield Progress(None, "tracing the pixels' centres")
    hits = yield from trace_hits(scene, Settings(method=Method.CERTIFIED), Statistics())
    yield Progress(None, "looking behind what is seen")
    faces = yield from Faces.of(scene)
    yield None
    depth = hits.t
    yield None
    cells = Cells(scene, faces, hits, depth)
    yield from cells.join(faces)
    search = _Search(scene, faces, limit * scale**2, work)
    yield from search.bound(cells)
    yield from scaled(search.steps(cells), 0.0, None, "looking behind what is seen")
    seen = np.flatnonzero(search.seen == SEEN)
    behind = np.zeros(faces.count, bool)
    behind[seen] = faces.turn[seen] > 0
    return Visible(
        search.seen,
        search.witness.T / scale,
        search.area / scale**2,
        behind,
        faces.start,
    )


class _Search:
    """Finds a witness of each face, or proves that it is hidden."""

    def __init__(self, scene: Scene, faces: Faces, limit: float, work: int) -> None:
        self._scene = scene
        self._faces = faces
        self._limit = limit
        self._work = work
        self.seen = np.full(faces.count, HIDDEN, np.uint8)
        self.seen[faces.may_show] = UNDECIDED
        self.witness = np.full((2, faces.count), np.nan)
        self.area = np.zeros(faces.count)

    def _enter(self, face: Index, at: Floats) -> None:
        self.seen[face] = SEEN
        self.witness[:, face] = at

    def bound(self, cells: Cells) -> Work[None]:
        """Find the part of the film in which each face may be seen: a box, and its area."""
        faces = self._faces
        self._enter(cells.face, cells.at)
        self._low, self._high = np.full((2, 2, faces.count), np.inf)
        self._high = -self._high
        some = np.flatnonzero(self.seen == UNDECIDED)
        start, which, new = cells.cells_of(faces, some)
        face, cell = some[:0], new[:, :0]
        for level in range(TOP, -1, -1):
            own = start[which] == level
            face = np.concatenate((np.repeat(face, 4), some[which[own]]))
            cell = np.concatenate((quarters(cell), new[:, own]), axis=1)
            rows = np.flatnonzero(faces.nearest[face] >= cells.hidden[level][cell[1], cell[0]])
            face, cell = face[rows], cell[:, rows]
            low, high = cells.film(level, cell)
            met = ((low <= faces.high[:, face]) & (high >= faces.low[:, face])).all(axis=0)
            near = np.flatnonzero(met)
            left = [near[:0]]
            for part in parts(len(near), TOGETHER):
                rows = near[part]
                left.append(rows[self._open(cells, level, face[rows], cell[:, rows])])
                yield None
            rows = np.concatenate(left)
            face, cell = face[rows], cell[:, rows]
        self._finest = face, cell
        low, high = cells.film(0, cell)
        low = np.maximum(low - _ROOM, faces.low[:, face])
        high = np.minimum(high + _ROOM, faces.high[:, face])
        np.add.at(self.area, face, np.prod(high - low, axis=0))
        for k in (0, 1):
            np.minimum.at(self._low[k], face, low[k])
            np.maximum.at(self._high[k], face, high[k])
        self._cut()

    def _cut(self) -> None:
        """Leave out what is behind planes."""
        some = np.flatnonzero(self.area)
        polygons = self._left_of(some)
        least, most, area = on_film(self._faces, some, polygons)
        self._low[:, some] = np.fmax(self._low[:, some], least)
        self._high[:, some] = np.fmin(self._high[:, some], most)
        self.area[some] = np.fmin(self.area[some], area)
        self.area[some[np.isnan(polygons).any(axis=(0, 1))]] = 0

    def _left_of(self, face: Index) -> Floats:
        """Return the parts of faces (n,) that planes leave, (k, 3, n), in world space."""
        box = self._low[:, face], self._high[:, face]
        return before_planes(self._scene, self._faces, face, *box)

    def _open(self, cells: Cells, level: int, face: Index, cell: Index) -> Bools:
        """Return in which cells faces may be seen, (n,)."""
        faces = self._faces
        low, high = cells.film(level, cell)
        farthest = cells.hidden[level][cell[1], cell[0]]
        for plane in self._scene.planes if level == 0 else ():
            own = behind_plane(self._scene, faces, plane, low, high)
            farthest = np.maximum(farthest, own)
        found = faces.within(face, low, high)
        missed = found.beside | faces.clip.outside(found.least, found.most)
        return ~(missed | (found.most < farthest))

    def steps(self, cells: Cells) -> Work[None]:
        """Look for each face, and for what is before it, until nothing new is found."""
        faces = self._faces
        self.seen[(self.seen == UNDECIDED) & (self.area == 0)] = HIDDEN
        self._sights = Sights(self._scene, faces, self.seen != HIDDEN)
        self._before = Cover(faces, self._low, self._high, self._work)
        self._covered = np.zeros(faces.count, bool)  # in one ray
        self._tries = np.zeros(faces.count, np.intp)  # since more was known of what is before it
        self._left = self.seen == UNDECIDED
        some = np.flatnonzero(self._left)
        middle = middles(faces, some, self._low[:, some], self._high[:, some])
        rays: tuple[Index, Floats] = some, middle
        while len(rays[0]) and self._before.work > 0:
            yield None
            rays = yield from self._round(*rays)
        yield from self._look_closely()
        yield from self._divide(cells)
        self.area[self.seen != UNDECIDED] = 0

    def _look_closely(self) -> Work[None]:
        """Look through many points of faces that few rays meet, so little may be seen of them."""
        random = np.random.default_rng(0)
        thin = np.flatnonzero((self.seen == UNDECIDED) & (self.area <= self._limit))
        for part in parts(len(thin), _RAYS):
            face = thin[part]
            polygons = self._left_of(face)
            shares = random.dirichlet(np.ones(len(polygons)), _RAYS)
            points = np.tensordot(shares, polygons, 1).swapaxes(0, 1).reshape(3, -1)
            x, y, _ = film_of(self._scene.camera, points)
            yield from self._look(np.tile(face, _RAYS), np.stack((x, y)))

    def _divide(self, cells: Cells) -> Work[None]:
        """Divide the cells of faces that are left, and see whether each is covered by one patch."""
        face, cell = self._finest
        for level in range(-1, -_FINER - 1, -1):
            left = (self.seen == UNDECIDED) & (self.area > self._limit)
            left &= np.bincount(face, minlength=len(left)) < _CELLS
            rows = np.flatnonzero(left[face])
            if not len(rows) or self._before.work <= 0:
                break
            face, cell = np.repeat(face[rows], 4), quarters(cell[:, rows])
            own = np.unique(face)
            low, high = cells.film(level, cell)
            low = np.maximum(low, self._low[:, face])
            high = np.minimum(high, self._high[:, face])
            still = [face[:0]]
            for part in parts(len(face), _TOGETHER):
                covered = yield from self._covers(face[part], low[:, part], high[:, part])
                still.append(part.start + np.flatnonzero(~covered))
            rows = np.concatenate(still)
            face, cell = face[rows], cell[:, rows]
            self.area[own] = 0
            np.add.at(self.area, face, np.prod((high - low)[:, rows], axis=0))
            own = own[self.seen[own] == UNDECIDED]
            self.seen[own[self.area[own] == 0]] = HIDDEN

    def _covers(self, face: Index, low: Floats, high: Floats) -> Work[Bools]:
        """Return in which of n boxes faces are hidden; look through the middles of others."""
        covered = ~(low < high).all(axis=0)
        found = self._faces.within(face, low, high)
        covered |= found.beside | self._faces.clip.outside(found.least, found.most)
        rows = np.flatnonzero(~covered)
        at = (low + high) / 2
        which, base = self._before.tried(face[rows])
        which = rows[which]
        least = patches(self._faces, base, at[:, which], low[:, which], high[:, which])
        covered[which[least > found.most[which]]] = True
        rows = np.flatnonzero(~covered)
        before, *_ = yield from self._look(face[rows], at[:, rows])
        self._before.add(face[rows], before)
        return covered | (self.seen[face] == SEEN)

    def _look(self, face: Index, at: Floats) -> Work[tuple[Index, Rays, Bools]]:
        """Trace n rays for faces; return what they see, the rays, and which may see the faces."""
        before, rays = yield from self._sights.look(at, face)
        # A ray along the picture's border may see what is wholly beyond it.
        inside = ((self._low[:, face] < at) & (at < self._high[:, face])).all(axis=0)
        own = (before == face) & inside
        self._enter(face[own], at[:, own])
        return before, rays, inside

    def _add(self, face: Index, before: Index) -> Work[None]:
        for part in parts(len(face), _TOGETHER):
            self._tries[self._before.add(face[part], before[part])] = 0
            yield None

    def _round(self, face: Index, at: Floats) -> Work[tuple[Index, Floats]]:
        """Trace rays, decide what they tell, and return the next ones: past edges."""
        faces, cover, covered, tries = self._faces, self._before, self._covered, self._tries
        before, rays, inside = yield from self._look(face, at)
        self._left &= self.seen == UNDECIDED
        rows = np.flatnonzero(self._left[face])
        face, before, inside, rays = face[rows], before[rows], inside[rows], rays.take(rows)
        tries[face] += 1
        yield from self._add(face, before)
        # What is before the face, but not all of it: another one may be, right before it.
        rows = np.flatnonzero(~cover.holds(face, before))
        before[rows] = yield from self._sights.before(face[rows], rays.take(rows))
        yield from self._add(face[rows], before[rows])
        rows = np.flatnonzero(~covered[face] & inside & cover.holds(face, before))
        for met in (face, before):
            corners = faces.points[:, faces.corners[:, met[rows]]].swapaxes(0, 1)
            rows = rows[decide(rays.take(rows), corners).crossed]
        covered[face[rows]] = True
        whole = self._left & covered
        face, at = yield from cover.gaps(whole, tries)
        whole[face] = False
        self.seen[whole] = HIDDEN
        self._left &= ~whole & (tries < _TRIES) & (self.area > self._limit)
        some = self._left[face]
        return face[some], at[:, some]
