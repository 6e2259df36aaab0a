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
_PLACES = np.array([0.5, 0.03, 0.97])  # in a gap, where rays look, in turn
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
        # Faces, and edges of what is before them that may not be covered: what is known, and new.
        self._edges = [(none, none)]

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

    def tried(self, face: Index) -> tuple[Index, Index]:
        """Return all that was tried before faces (n,): which of these, and the faces."""
        return self._of(self._tried, face)

    def _of(self, keys: Index, face: Index) -> tuple[Index, Index]:
        """Return what keys have for faces (n,): which of these, and the other faces."""
        first, last = np.searchsorted(keys, (face, face + 1) * np.array(self._faces.count))
        which, number = spread(np.arange(len(face)), last - first)
        return which, keys[first[which] + number] % self._faces.count

    def _new(self, keys: Index) -> Index:
        keys = np.sort(keys)
        keys = keys[np.diff(keys, prepend=-1) != 0]
        return keys[~_among(self._tried, keys)]

    def _enter(self, face: Index, edge: Index) -> Index:
        """Note edges that reach into faces; return f m + g of what continues them there."""
        low, high = self._faces.box(edge)
        near = ((low <= self._high[:, face]) & (high >= self._low[:, face])).all(axis=0)
        face, edge = face[near], edge[near]
        rows = np.flatnonzero(crossed(self._faces, edge, face)[0] == THROUGH)
        face, edge = face[rows], edge[rows]
        self._edges.append((face, edge))
        mate = self._faces.beyond(edge)
        return (face * self._faces.count + mate)[mate >= 0]

    def gaps(self, some: Bools, tries: Index) -> Work[tuple[Index, Floats]]:
        """Find where faces that are `some` (m,) may be seen past an edge of what is before them.

        Returns the faces, and film positions (2, n): others after each of the `tries` (m,). A face
        without any is wholly covered, or not at all.
        """
        face, edge = (np.concatenate(each) for each in zip(*self._edges, strict=True))
        waits = ~some[face]
        own = np.flatnonzero(~waits)
        own = own[~self.holds(face[own], self._faces.beyond(edge[own]))]
        found = [own[:0]]
        gap: Floats = np.zeros((2, 0))
        for part in parts(len(own), _TOGETHER):
            row, longest = self._gaps(face[own[part]], edge[own[part]])
            found.append(own[part][row])
            gap = np.append(gap, longest, axis=1)
            yield None
        rows = np.concatenate(found)
        waits[rows] = True
        self._edges = [(face[waits], edge[waits])]
        return self._past(face[rows], edge[rows], gap, tries)

    def _gaps(self, face: Index, edge: Index) -> tuple[Index, Floats]:
        """Return which edges may not be covered in their faces, and the longest such piece."""
        faces = self._faces
        which, own = self._of(self._before, face)
        low, high = faces.box(edge)
        near = (low[:, which] <= faces.high[:, own]) & (high[:, which] >= faces.low[:, own])
        near = near.all(axis=0)
        every = np.concatenate((which[near], np.arange(len(face))))
        own = np.concatenate((own[near], face))
        self.work -= len(own)
        side, ends = crossed(faces, edge[every], own)
        good = (side == THROUGH) | ((side != 0) & (side == -faces.side[edge[every]]))
        weight = np.where(own == face[every], -1, 1)
        return _below_zero(len(face), every[good], ends[..., good], weight[good])

    def _past(self, face: Index, edge: Index, gap: Floats, tries: Index) -> tuple[Index, Floats]:
        """Return faces, and film positions just past edges, in gaps."""
        faces = self._faces
        a, b = faces.points[:, faces.ends[:, edge]].swapaxes(0, 1)
        share = _PLACES[tries[face] % len(_PLACES)]
        places = [gap[0] + part * (gap[1] - gap[0]) for part in (share, share + 0.01)]
        (x, y), (x1, y1) = (film_of(faces.film.camera, a + t * (b - a))[:2] for t in places)
        size = faces.side[edge] * _BESIDE / np.hypot(x1 - x, y1 - y)
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
