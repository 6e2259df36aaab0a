"""Decides of each face of a scene whether its camera sees it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Bools, Bytes, Floats, Index
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.arithmetic import sound
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import NOTHING

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


@sound
@np.errstate(all="ignore")
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
    camera = scene.camera
    if not camera.projection.is_linear:
        raise SceneError(
            f"Camera '{camera.name}' is {camera.projection.name}: which faces are seen is decided "
            "for perspective and orthographic cameras"
        )
    faces = Faces(scene)
    search = _Search(scene, faces, limit, work)
    search.run()
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

    def run(self) -> None:
        """Decide every face."""
        centres = Centres(self._scene, self._faces)
        self._enter(centres.face, centres.at)
        self._bound(centres)
        some = self.seen == UNDECIDED
        self.seen[some & (self.area == 0)] = HIDDEN
        self._cover()
        self.area[self.seen != UNDECIDED] = 0

    def _enter(self, face: Index, at: Floats) -> None:
        self.seen[face] = SEEN
        self.witness[:, face] = at

    def _bound(self, centres: Centres) -> None:
        """Find the part of the film in which each face may be seen: a box, and its area."""
        faces = self._faces
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

    def _cover(self) -> None:
        """Look for each face, and for what is before it, until nothing new is found."""
        faces = self._faces
        self._sights = Sights(self._scene, faces)
        cover = Cover(faces, self._low, self._high, self._work)
        covered = np.zeros(faces.count, bool)  # in one ray
        tries = np.zeros(faces.count, np.intp)  # since more was known of what is before a face
        cut = np.arange(faces.count)  # what each face may cross, or itself
        left = self.seen == UNDECIDED
        at: Floats = np.zeros((2, 0))
        face: Index = np.zeros(0, np.intp)
        for _ in range(_ROUNDS):
            some = np.flatnonzero(left & (~covered | (tries > 0)))
            box = self._low[:, some], self._high[:, some]
            new = points_of(faces, some, cut[some], *box, tries[some] // 2)
            face, at = np.concatenate((face, some)), np.concatenate((at, new), axis=1)
            if not len(face) or cover.work <= 0:
                break
            before, rays = self._look(face, at)
            left &= self.seen == UNDECIDED
            rows = np.flatnonzero(left[face])
            face, at, before, rays = face[rows], at[:, rows], before[rows], rays.take(rows)
            tries[face] += 1
            tries[cover.add(face, before)] = 0
            # What is before the face, but not all of it: another one may be, right before it.
            rows = np.flatnonzero(~cover.holds(face, before))
            cut[face[rows]] = np.where(before[rows] == NOTHING, face[rows], before[rows])
            before[rows] = self._sights.before(face[rows], rays.take(rows))
            tries[cover.add(face[rows], before[rows])] = 0
            inside = ((self._low[:, face] < at) & (at < self._high[:, face])).all(axis=0)
            rows = np.flatnonzero(~covered[face] & inside & cover.holds(face, before))
            for met in (face, before):
                corners = faces.points[:, faces.corners[:, met[rows]]].swapaxes(0, 1)
                rows = rows[decide(rays.take(rows), corners).crossed]
            covered[face[rows]] = True
            face, at = cover.gaps(left & covered, tries)
            whole = left & covered
            whole[face] = False
            self.seen[whole] = HIDDEN
            left &= ~whole & (tries < _TRIES) & (self.area > self._limit)
            some = left[face]
            face, at = face[some], at[:, some]

    def _look(self, face: Index, at: Floats) -> tuple[Index, Rays]:
        """Trace rays that may see faces, and note those that do; return what they see, and rays."""
        found, rays = self._sights.look(at)
        r = self._scene.camera.region
        # A ray along the picture's border may see what is wholly beyond it.
        own = (found == face) & (r.x0 < at[0]) & (at[0] < r.x1) & (r.y0 < at[1]) & (at[1] < r.y1)
        self._enter(face[own], at[:, own])
        return found, rays
