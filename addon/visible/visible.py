"""Decides of each face of a scene whether its camera sees it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Bytes, Floats, Index, parts
from ..certified.arithmetic import sound_steps
from ..methods import Method
from ..rendering import hits as trace_hits
from ..scene import Scene, SceneError
from ..tracer.hits import NOTHING, Hits, Statistics
from ..tracer.progress import Progress, Work, result_of
from ..tracer.settings import Settings
from ..tracer.vector import spread
from .faces import Faces
from .hiding import Cells, behind_planes, covers, reached, surely_in
from .polygons import in_cells
from .sights import TOP, Centres, Sights, start_cells

HIDDEN, SEEN, UNDECIDED = 0, 1, 2
LIMIT = 1e-6  # square pixels
WORK = 1 << 20  # cells of at most one pixel, each with a face
_DEEPEST = -12  # the level of the smallest cells
_SMALL = -6  # in which a face is left undecided, if so little may be seen of it
_CELLS = 256  # of a face, that are divided further
_LOOKS = 4, 16  # rays of each face in cells of one pixel, and in smaller ones of a level
_ROOM = 1 / 16  # of a cell's size, on each side: so that no cell has only a corner of a face
_TOGETHER = 1 << 15


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
    """Return what :func:`steps` decides."""
    return result_of(steps(scene, limit, work))


@sound_steps
def steps(scene: Scene, limit: float = LIMIT, work: int = WORK) -> Work[Visible]:
    """Decide which faces of a scene its camera sees.

    Parameters
    ----------
    limit : float
        Square pixels: if no more than that may be seen of a face, it stays undecided.
    work : int
        About how many cells may be looked at, counted for each face: then the rest is undecided.

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
    yield Progress(None, "tracing the pixels' centres")
    hits = yield from trace_hits(scene, Settings(method=Method.CERTIFIED), Statistics())
    yield Progress(None, "dividing the film")
    faces = Faces(scene)
    yield None
    search = _Search(scene, faces, hits, limit, work)
    yield from search.steps()
    seen = np.flatnonzero(search.seen == SEEN)
    behind = np.zeros(faces.count, bool)
    behind[seen] = faces.turn(seen) > 0
    return Visible(
        search.seen,
        search.witness.T.copy(),
        search.area,
        behind,
        faces.start,
    )


@dataclass(frozen=True, eq=False)
class _Items:
    """n cells (2, n) of one level, and a face that may be seen in each, (n,)."""

    face: Index
    cell: Index

    def take(self, index: Index | Bools | slice) -> _Items:
        return _Items(self.face[index], self.cell[:, index])

    def divided(self) -> _Items:
        """Return each cell's four."""
        x, y = 2 * self.cell
        cells = np.stack([(x + i, y + j) for j in (0, 1) for i in (0, 1)], axis=2)
        return _Items(np.repeat(self.face, 4), cells.reshape(2, -1))

    def joined(self, others: Sequence[_Items]) -> _Items:
        face = np.concatenate([self.face, *(other.face for other in others)])
        cell = np.concatenate([self.cell, *(other.cell for other in others)], axis=1)
        return _Items(face, cell)


class _Search:
    """Finds a witness of each face, or proves in ever smaller cells that it is hidden."""

    def __init__(self, scene: Scene, faces: Faces, hits: Hits, limit: float, work: int) -> None:
        self._faces = faces
        self._limit = limit
        self._work = work
        self.seen = np.full(faces.count, HIDDEN, np.uint8)
        self.seen[faces.may_show] = UNDECIDED
        self.witness = np.full((2, faces.count), np.nan)
        self.area = np.zeros(faces.count)
        self._centres = Centres(scene, faces, hits)
        self._enter(*self._centres.witnesses(scene))
        self._scene = scene

    def _enter(self, face: Index, at: Floats) -> None:
        self.seen[face] = SEEN
        self.witness[:, face] = at

    def steps(self) -> Work[None]:
        """Decide every face, from the largest cells to the smallest."""
        faces = self._faces
        self._cover_cells()
        yield None
        some = np.flatnonzero(self.seen == UNDECIDED)
        level, ends = start_cells(faces, some, self._centres.corner)
        items = _Items(some[:0], np.zeros((2, 0), np.int64))
        left = np.zeros(faces.count, bool)  # given up
        for now in range(TOP, _DEEPEST - 1, -1):
            own = np.flatnonzero(level == now)
            items = items.divided().joined([_cells_of(some[own], ends[..., own])])
            items = yield from self._in_parts(self._not_hidden, items, now)
            if now == 0:
                items = items.take(faces.turn(items.face) != 0)  # edge-on, no ray crosses it
                # No ray sees another face than these.
                open_ = np.union1d(np.flatnonzero(self.seen == SEEN), items.face)
                self._sights = Sights(self._scene, faces, open_, self._centres.corner)
            if now <= 0:
                self._work -= len(items.face)
                items = yield from self._in_parts(self._look_closer, items, now)
                items = items.take(self.seen[items.face] != SEEN)
                given_up = self._given_up(items, now)
                left[items.face[given_up]] = True
                items = items.take(~given_up)
        self.seen[(self.seen == UNDECIDED) & ~left] = HIDDEN
        self.area[self.seen != UNDECIDED] = 0

    def _in_parts(
        self, work: Callable[[_Items, int], _Items], items: _Items, level: int
    ) -> Work[_Items]:
        done = []
        for part in parts(len(items.face), _TOGETHER):
            done.append(work(items.take(part), level))
            yield None
        return items.take(slice(0)).joined(done)

    def _cells(self, items: _Items, level: int) -> Cells:
        return Cells(*self._centres.film(level, items.cell))

    def _not_hidden(self, items: _Items, level: int) -> _Items:
        """Return the cells that a face may reach, and that no triangle before it covers."""
        faces = self._faces
        items = items.take(self.seen[items.face] == UNDECIDED)
        farthest = self._centres.nearness_in(level, items.cell)
        some = np.flatnonzero(~(faces.nearest[items.face] < farthest))
        items, farthest = items.take(some), farthest[some]
        cells = self._cells(items, level)
        if level <= 0:
            farthest = np.maximum(farthest, behind_planes(self._scene, faces, cells))
        found = reached(faces, items.face, cells)
        return items.take(~(found.missed | (found.nearest < farthest)))

    def _cover_cells(self) -> None:
        """Find what hides all of the cells of one pixel that more than one triangle covers."""
        hidden = self._centres.hidden[0]
        cell = np.stack(np.nonzero(hidden == -np.inf)[::-1])
        for corner in range(4):
            base, at = self._centres.around(0, cell, corner)
            new = base != NOTHING
            for before in range(corner):
                new &= base != self._centres.around(0, cell, before)[0]
            some = np.flatnonzero(new)
            for part in parts(len(some), _TOGETHER):
                k = some[part]
                own = Cells(*self._centres.film(0, cell[:, k]))
                found = covers(self._faces, base[k], at[:, k], own)
                x, y = cell[:, k[found.sure]]
                hidden[y, x] = found.least[found.sure]
            cell = cell[:, hidden[cell[1], cell[0]] == -np.inf]
        self._centres.refresh()

    def _look_closer(self, items: _Items, level: int) -> _Items:
        """Trace rays within the faces, and return the cells in which they still may be seen."""
        faces = self._faces
        cells = Cells(*self._centres.film(level, items.cell, _ROOM))
        at, area = in_cells(faces, items.face, cells)
        order = np.lexsort((-area, items.face))
        starts = np.diff(items.face[order], prepend=-1) != 0
        number = np.cumsum(starts) - 1
        rank = np.arange(len(order)) - np.flatnonzero(starts)[number]
        looks = _LOOKS[level < 0]
        largest = order[rank < looks]
        base = np.empty(len(order), np.intp)
        base[largest] = self._look(items.face[largest], at[:, largest])
        base[order[rank >= looks]] = base[order[starts]][number[rank >= looks]]
        open_ = self.seen[items.face] == UNDECIDED
        edges = []
        bases = [base] + [self._centres.around(level, items.cell, k)[0] for k in range(4)]
        for k, own in enumerate(bases):
            new = open_ & (own != NOTHING) & (own != items.face)
            for other in bases[:k]:
                new &= own != other
            some = np.flatnonzero(new)
            covered = covers(faces, own[some], at[:, some], cells.take(some), items.face[some])
            open_[some[covered.sure & surely_in(faces, items.face[some], at[:, some])]] = False
            edges.append((some, covered.edge))
        some, edge = (np.concatenate(each) for each in zip(*edges, strict=True))
        use = open_[some] & (edge >= 0)
        self._look_past(items, cells, some[use], edge[use], open_)
        return items.take(open_ & (self.seen[items.face] == UNDECIDED))

    def _look_past(
        self, items: _Items, cells: Cells, some: Index, edge: Index, open_: Bools
    ) -> None:
        """Trace rays just past edges that were in the way in `some` cells; note what is hidden."""
        faces = self._faces
        at, area = in_cells(faces, items.face[some], cells.take(some), edge)
        some = some[area > 0]
        at = at[:, area > 0]
        base = self._look(items.face[some], at)
        new = (self.seen[items.face[some]] == UNDECIDED) & (base != NOTHING)
        some = some[new]
        at = at[:, new]
        face = items.face[some]
        covered = covers(faces, base[new], at, cells.take(some), face)
        open_[some[covered.sure & surely_in(faces, face, at)]] = False

    def _look(self, face: Index, at: Floats) -> Index:
        """Trace rays that may see faces; note those that do, and return what they see."""
        faces = self._faces
        near = faces.at_points(face, *at)[3] - faces.nearness_error[face]
        found = self._sights.look(at[0], at[1], np.nan_to_num(near, nan=-np.inf, posinf=-np.inf))
        r = self._scene.camera.region
        x, y = at
        # A ray along the picture's border may see what is wholly beyond it.
        own = (found == face) & (r.x0 < x) & (x < r.x1) & (r.y0 < y) & (y < r.y1)
        self._enter(face[own], at[:, own])
        return found

    def _given_up(self, items: _Items, level: int) -> Bools:
        """Note how much may be seen of faces; return the cells of those that stay undecided."""
        faces = self._faces
        _, area = in_cells(faces, items.face, self._cells(items, level))
        self.area[items.face] = 0
        np.add.at(self.area, items.face, area)
        many = np.bincount(items.face, minlength=1)[items.face] > _CELLS
        little = (self.area[items.face] <= self._limit) & (level <= _SMALL)
        return (level == _DEEPEST) | (self._work < 0) | many | little


def _cells_of(face: Index, ends: Index) -> _Items:
    """Return all cells from the first to the last of each face."""
    width, height = ends[1] - ends[0] + 1
    which, number = spread(np.arange(len(face)), width * height)
    y, x = np.divmod(number, width[which])
    return _Items(face[which], np.stack((x, y)) + ends[0][:, which])
