"""Decides of each face of a scene whether its camera sees it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Bytes, Floats, Index
from ..certified.any_rays import decide
from ..certified.arithmetic import sound_steps
from ..methods import Method
from ..rendering import hits as trace_hits
from ..scene import Scene, SceneError
from ..tracer.hits import NOTHING, Statistics
from ..tracer.progress import Progress, Work, result_of
from ..tracer.settings import Settings
from .cover import Cover
from .faces import Faces
from .points import points_of
from .sights import TOP, Centres, Sights, behind_planes

HIDDEN, SEEN, UNDECIDED = 0, 1, 2
LIMIT = 1e-6  # square pixels
WORK = 1 << 24  # pairs of faces that are compared, and of edges and faces
_ROOM = 2.0**-8  # pixels around what may be seen, so that more than a corner is there
_ROUNDS = 32  # of rays
_TRIES = 6  # of them without anything new, for a face


@dataclass(frozen=True, eq=False)
class Visible:
    """What a camera sees of the m faces of a scene.

    Parameters
    ----------
    seen : (m,) uint8
        HIDDEN, SEEN or UNDECIDED.
    witness : (m, 2) float64
        A film position of each face that is seen, in pixels: its ray sees the face. Else NaN.
    area : (m,) float64
        Of a face that is undecided, the most that may be seen of it, in square pixels. Else 0.
    behind : (m,) bool
        Whether a face that is seen shows its back, where its corners turn to the right.
    start : (k + 1,) int
        The first face of each of the scene's instances.
    """

    seen: Bytes
    witness: Floats
    area: Floats
    behind: Bools
    start: Index


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
    yield Progress(None, "tracing the pixels' centres")
    hits = yield from trace_hits(scene, Settings(method=Method.CERTIFIED), Statistics())
    yield Progress(None, "looking behind what is seen")
    faces = Faces(scene)
    yield None
    search = _Search(scene, faces, limit, work)
    search.bound(Centres(scene, faces, hits))
    yield None
    yield from search.steps()
    seen = np.flatnonzero(search.seen == SEEN)
    behind = np.zeros(faces.count, bool)
    behind[seen] = faces.turn[seen] > 0
    return Visible(
        search.seen,
        search.witness.T.copy(),
        search.area,
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

    def bound(self, centres: Centres) -> None:
        """Find the part of the film in which each face may be seen: a box, and its area."""
        faces = self._faces
        self._enter(centres.face, centres.at)
        self._low, self._high = np.full((2, 2, faces.count), np.inf)
        self._high = -self._high
        some = np.flatnonzero(self.seen == UNDECIDED)
        start, which, new = centres.cells_of(faces, some)
        face, cell = some[:0], new[:, :0]
        for level in range(TOP, -1, -1):
            own = start[which] == level
            face = np.concatenate((np.repeat(face, 4), some[which[own]]))
            x, y = 2 * cell
            four = np.stack([(x + i, y + j) for j in (0, 1) for i in (0, 1)], axis=2)
            cell = np.concatenate((four.reshape(2, -1), new[:, own]), axis=1)
            farthest = centres.hidden[level][cell[1], cell[0]]
            near = np.flatnonzero(~(faces.nearest[face] < farthest))
            face, cell, farthest = face[near], cell[:, near], farthest[near]
            low, high = centres.film(level, cell)
            if level == 0:
                farthest = np.maximum(farthest, behind_planes(self._scene, faces, low, high))
            missed, _, nearest = faces.within(face, low, high)
            left = np.flatnonzero(~(missed | (nearest < farthest)))
            face, cell = face[left], cell[:, left]
        low = np.maximum(low[:, left] - _ROOM, faces.low[:, face])
        high = np.minimum(high[:, left] + _ROOM, faces.high[:, face])
        np.add.at(self.area, face, np.prod(high - low, axis=0))
        for k in (0, 1):
            np.minimum.at(self._low[k], face, low[k])
            np.maximum.at(self._high[k], face, high[k])

    def steps(self) -> Work[None]:
        """Look for each face, and for what is before it, until nothing new is found."""
        faces = self._faces
        self.seen[(self.seen == UNDECIDED) & (self.area == 0)] = HIDDEN
        self._sights = Sights(self._scene, faces)
        self._before = Cover(faces, self._low, self._high, self._work)
        self._covered = np.zeros(faces.count, bool)  # in one ray
        self._tries = np.zeros(faces.count, np.intp)  # since more was known of what is before it
        self._cut = np.arange(faces.count)  # what each face may cross, or itself
        self._left = self.seen == UNDECIDED
        rays: tuple[Index, Floats] = np.zeros(0, np.intp), np.zeros((2, 0))
        for _ in range(_ROUNDS):
            yield None
            rays = self._round(*rays)
            if not self._left.any() or self._before.work <= 0:
                break
        self.area[self.seen != UNDECIDED] = 0

    def _round(self, face: Index, at: Floats) -> tuple[Index, Floats]:
        """Trace rays past edges, and others; decide what they tell, and return the next ones."""
        faces, cover, covered, tries = self._faces, self._before, self._covered, self._tries
        some = np.flatnonzero(self._left & (~covered | (tries > 0)))
        box = self._low[:, some], self._high[:, some]
        new = points_of(faces, some, self._cut[some], *box, tries[some] // 2)
        face, at = np.concatenate((face, some)), np.concatenate((at, new), axis=1)
        before, rays = self._sights.look(at)
        # A ray along the picture's border may see what is wholly beyond it.
        inside = ((self._low[:, face] < at) & (at < self._high[:, face])).all(axis=0)
        own = (before == face) & inside
        self._enter(face[own], at[:, own])
        self._left &= self.seen == UNDECIDED
        rows = np.flatnonzero(self._left[face])
        face, before, inside, rays = face[rows], before[rows], inside[rows], rays.take(rows)
        tries[face] += 1
        tries[cover.add(face, before)] = 0
        # What is before the face, but not all of it: another one may be, right before it.
        rows = np.flatnonzero(~cover.holds(face, before))
        self._cut[face[rows]] = np.where(before[rows] == NOTHING, face[rows], before[rows])
        before[rows] = self._sights.before(face[rows], rays.take(rows))
        tries[cover.add(face[rows], before[rows])] = 0
        rows = np.flatnonzero(~covered[face] & inside & cover.holds(face, before))
        for met in (face, before):
            corners = faces.points[:, faces.corners[:, met[rows]]].swapaxes(0, 1)
            rows = rows[decide(rays.take(rows), corners).crossed]
        covered[face[rows]] = True
        whole = self._left & covered
        face, at = cover.gaps(whole, tries)
        whole[face] = False
        self.seen[whole] = HIDDEN
        self._left &= ~whole & (tries < _TRIES) & (self.area > self._limit)
        some = self._left[face]
        return face[some], at[:, some]
