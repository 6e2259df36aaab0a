"""Collects what is before each face, and says where that may leave some of the face uncovered."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Index, parts
from ..tracer.camera import film_of
from ..tracer.progress import Work
from ..tracer.vector import spread
from .faces import Faces
from .hiding import THROUGH, crossed, nearer

_BESIDE = 2.0**-24  # pixels from an edge, where a ray looks past it
_PLACES = np.array([0.5, 0.03, 0.97, 0.25, 0.75, 0.002])  # in a gap, where rays look, in turn
_TOGETHER = 1 << 9  # edges whose cover is found together


class Cover:
    """The faces that are before others, and their edges that reach into those.

    Of each face, what is in its box from `low` to `high` (2, m) is to be covered.
    """

    def __init__(self, faces: Faces, low: Floats, high: Floats, work: int) -> None:
        self._faces = faces
        self._low, self._high = low, high
        self.work = work
        none: Index = np.zeros(0, np.intp)
        self._tried = self._before = none  # sorted, of face f and what is before it, g: f m + g
        self._face = self._edge = none
        self._within = crossed(faces, none, none)[1]  # where edges are within their faces
        self._covered = np.zeros(0, bool)

    def holds(self, face: Index, own: Index) -> Bools:
        """Return whether `own` (n,) are known to be before faces (n,)."""
        return (own >= 0) & _among(self._before, face * self._faces.count + own)

    def add(self, face: Index, own: Index) -> Index:
        """Try whether `own` (n,), if any, are before faces (n,), and what continues them, too.

        Returns the faces that more is known about.
        """
        count = self._faces.count
        some = (own >= 0) & (own != face)
        new = self._new((face * count + own)[some])
        grown = [new[:0]]
        while len(new) and self.work > 0:
            self.work -= len(new)
            self._tried = _joined(self._tried, new)
            face, own = np.divmod(new, count)
            good = nearer(self._faces, own, face, self._low[:, face], self._high[:, face])
            self._before = _joined(self._before, new[good])
            grown.append(face[good])
            edge = (np.arange(3)[:, None] * count + own[good]).ravel()
            new = self._new(self._enter(np.tile(face[good], 3), edge))
        return np.unique(np.concatenate(grown))

    def _new(self, keys: Index) -> Index:
        keys = np.sort(keys)
        keys = keys[np.diff(keys, prepend=-1) != 0]
        return keys[~_among(self._tried, keys)]

    def _enter(self, face: Index, edge: Index) -> Index:
        """Note edges that reach into faces; return f m + g of what continues them there."""
        low, high = self._faces.box(edge)
        near = ((low <= self._high[:, face]) & (high >= self._low[:, face])).all(axis=0)
        face, edge = face[near], edge[near]
        side, ends = crossed(self._faces, edge, face)
        rows = np.flatnonzero(side == THROUGH)
        self._face = np.concatenate((self._face, face[rows]))
        self._edge = np.concatenate((self._edge, edge[rows]))
        self._within = np.concatenate((self._within, ends[..., rows]), axis=2)
        self._covered = np.concatenate((self._covered, np.zeros(len(rows), bool)))
        mate = self._faces.beyond(edge[rows])
        return (face[rows] * self._faces.count + mate)[mate >= 0]

    def gaps(self, some: Bools, tries: Index) -> Work[tuple[Index, Floats]]:
        """Find where faces that are `some` (m,) may be seen past an edge of what is before them.

        Returns the faces, and film positions (2, n): others after each of the `tries` (m,). A face
        without any is wholly covered, or not at all.
        """
        rows = np.flatnonzero(some[self._face] & ~self._covered)
        paired = self.holds(self._face[rows], self._faces.beyond(self._edge[rows]))
        self._covered[rows[paired]] = True
        rows = rows[~paired]
        row = rows[:0]
        gap: Floats = np.zeros((2, 0))
        for part in parts(len(rows), _TOGETHER):
            own, longest = self._gaps(rows[part])
            row, gap = np.append(row, own), np.append(gap, longest, axis=1)
            yield None
        return self._past(row, gap, tries)

    def _gaps(self, rows: Index) -> tuple[Index, Floats]:
        """Return edges that may not be covered, by their rows, and the longest such piece."""
        faces = self._faces
        edge, face = self._edge[rows], self._face[rows]
        first, last = np.searchsorted(self._before, (face, face + 1) * np.array(faces.count))
        which, number = spread(np.arange(len(rows)), last - first)
        own = self._before[first[which] + number] % faces.count
        low, high = self._faces.box(edge)
        near = ((low[:, which] <= faces.high[:, own]) & (high[:, which] >= faces.low[:, own])).all(
            0
        )
        which, own = which[near], own[near]
        self.work -= len(own)
        side, ends = crossed(faces, edge[which], own)
        good = (side == THROUGH) | ((side != 0) & (side == -faces.side(edge[which])))
        need, needed = self._need(rows)
        every = np.concatenate((which[good], np.flatnonzero(needed)))
        ends = np.concatenate((ends[..., good], need[..., needed]), axis=2)
        weight = np.where(np.arange(len(every)) < good.sum(), 1, -1)
        row, gap = _below_zero(len(rows), every, ends, weight)
        self._covered[rows] = True
        self._covered[rows[row]] = False
        return rows[row], gap

    def _need(self, rows: Index) -> tuple[Floats, Bools]:
        """Return where edges are within their faces and the boxes, and whether they are at all."""
        v = self._faces.vertices
        face, points = self._face[rows], self._faces.ends(self._edge[rows])
        constant, slope = self._faces.film.place
        borders = []
        for sign, box in ((1, self._low), (-1, self._high)):
            for at, across in zip(box[:, face], (v.p[points], v.q[points]), strict=True):
                moved = at * v.w[points]
                room = constant + slope * v.size[points]
                room += 2.0**-48 * (np.abs(across) + np.abs(moved))
                borders.append(np.nan_to_num(sign * (across - moved) + room, nan=np.inf))
        a, b = np.stack(borders, axis=1)
        t = a / (a - b)
        ends = self._within[..., rows]
        met = np.stack(
            (np.where(b > a, t, -np.inf).max(axis=0), -np.where(a > b, t, np.inf).min(0))
        )
        met[np.stack(((a > 0).all(axis=0), (b > 0).all(axis=0)))] = -np.inf
        for number, sign in enumerate((1, -1)):
            later = met[number] > np.nan_to_num(sign * ends[number, 0], nan=-np.inf)
            ends[number, 0, later] = sign * met[number, later]
            ends[number, 1:, later] = 2.0**-40, -1 - number
        return ends, ((a > 0) | (b > 0)).all(axis=0)

    def _past(self, row: Index, gap: Floats, tries: Index) -> tuple[Index, Floats]:
        """Return faces, and film positions just past their edges, in gaps."""
        faces = self._faces
        face, edge = self._face[row], self._edge[row]
        a, b = faces.points[:, faces.ends(edge)].swapaxes(0, 1)
        share = _PLACES[tries[face] % len(_PLACES)]
        places = [gap[0] + part * (gap[1] - gap[0]) for part in (share, share + 0.01)]
        (x, y), (x1, y1) = (film_of(faces.film.camera, a + t * (b - a))[:2] for t in places)
        size = faces.side(edge) * _BESIDE / np.hypot(x1 - x, y1 - y)
        at = np.stack((x - (y1 - y) * size, y + (x1 - x) * size))
        middle = (self._low[:, face] + self._high[:, face]) / 2
        return face, np.where(np.isfinite(at).all(axis=0), at, middle)


def _below_zero(count: int, row: Index, ends: Floats, weight: Index) -> tuple[Index, Floats]:
    """Return where `count` edges may be covered less than 0 times: rows, and the longest piece.

    Each of the intervals `ends` (2, 3, k), as of `crossed`, covers its edge `row` (k,) by `weight`.
    """
    base = np.zeros(count, np.intp)
    np.add.at(base, row, np.where(np.isnan(ends[0, 2]), weight, 0))
    row, weight = np.tile(row, 2), np.concatenate((weight, -weight))
    at, error, name = np.concatenate(ends, axis=1)
    some = np.flatnonzero(~np.isnan(name))
    row = row[some]
    weight = weight[some]
    at = at[some]
    error = error[some]
    # What ends and begins at one edge or corner meets exactly.
    order = np.lexsort((name[some], row))
    key = np.stack((row, name[some]))[:, order]
    starts = np.flatnonzero((np.diff(key, axis=1, prepend=-9) != 0).any(axis=0))
    net = np.add.reduceat(weight[order], starts)
    high = np.maximum.reduceat((at + error)[order], starts)
    low = np.minimum.reduceat((at - error)[order], starts)
    some = np.flatnonzero(net)
    row = np.concatenate((np.arange(count), row[order][starts[some]]))
    at = np.concatenate((np.full(count, -np.inf), np.where(net > 0, high, low)[some]))
    weight = np.concatenate((base, net[some]))
    order = np.lexsort((weight, at, row))
    row = row[order]
    at = at[order]
    weight = weight[order]
    total = np.cumsum(weight)
    starts = np.diff(row, prepend=-1) != 0
    total -= (total - weight)[starts][row]
    until = np.where(np.roll(starts, -1), np.inf, np.roll(at, -1))
    gap = np.clip((at, until), 0, 1)
    bad = np.flatnonzero(total < 0)
    bad = bad[np.lexsort((gap[0, bad] - gap[1, bad], row[bad]))]
    bad = bad[np.diff(row[bad], prepend=-1) != 0]
    return row[bad], gap[:, bad]


def _among(known: Index, keys: Index) -> Bools:
    """Return which keys (n,) are in a sorted list."""
    if not len(known):
        return np.zeros(len(keys), bool)
    return known[np.minimum(np.searchsorted(known, keys), len(known) - 1)] == keys


def _joined(known: Index, new: Index) -> Index:
    """Return two sorted lists as one."""
    return np.insert(known, np.searchsorted(known, new), new)
