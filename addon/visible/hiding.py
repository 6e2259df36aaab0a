"""Decides whether surfaces cover all of a cell of the film, and are nearer than a face there.

The rays of a cell are an open, connected part of the film, U: those that are within the face, too.
Take some faces as the camera sees them, with their orientation: how often they cover a ray changes
only where it crosses an edge of theirs that no other one of them continues on its other side. So if
no such edge reaches into U, and one ray of U is covered, all of U is. Each face is nearer if

- its nearness, less that of the face, is above their errors at all corners of the cell: the
  difference is linear on the film; or
- the face's corners are behind its plane or in it; or its corners before the face's plane or in it.

An edge does not reach into U if it is beside the cell, or if its ends are outside one edge of the
face, or on that edge. What is exactly on it shares corners with it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import Bools, Floats, Index
from ..certified.bounds import Fractions, plane_fractions
from ..certified.rounding import rounding
from ..certified.sweep.depth_buffer import ROUNDING, nearness
from ..scene import Scene
from ..tracer.camera import camera_rays
from .faces import Faces

_ROUNDS = 6  # of faces that continue those before


class Cells(NamedTuple):
    """n cells: where they begin and end on the film, (2, n) each."""

    low: Floats
    high: Floats

    @property
    def corners(self) -> tuple[Floats, Floats]:
        """X and y of the four corners, (4, n) each."""
        (x0, y0), (x1, y1) = self.low, self.high
        return np.stack((x0, x1, x0, x1)), np.stack((y0, y0, y1, y1))

    def take(self, index: Index) -> Cells:
        """Return those at `index`."""
        return Cells(self.low[:, index], self.high[:, index])


class Reached(NamedTuple):
    """What is known of n faces in a cell each."""

    missed: Bools  # (n,) none of its rays meets it, in the clip range
    least: Floats  # (4, n) of the edge functions and the nearness, as computed
    nearest: Floats  # (n,) bounds the nearness from above
    inside: Bools  # (3, n) whether the cell surely is on the inner side of each edge
    touched: Bools  # (n,) False where the cell surely is on the outer side of an edge


def reached(faces: Faces, face: Index, cells: Cells) -> Reached:
    """Evaluate faces in cells."""
    faces.need(face)
    least, most = faces.between(face, *cells)
    error = faces.edge_error[face]
    own = faces.nearness_error[face]
    inside = least[:3] > error
    beside = (most[:3] < -error).any(axis=0)
    # One that is not sure may have the other orientation.
    beside &= faces.sure[face] | inside.any(axis=0)
    missed = beside | (faces.low[:, face] > cells.high).any(axis=0)
    missed |= (faces.high[:, face] < cells.low).any(axis=0)
    nearest = np.fmin(most[3] + own, faces.nearest[face])
    missed |= faces.clip.outside(least[3] - own, nearest)
    return Reached(missed, least, nearest, inside, ~beside)


def behind_planes(scene: Scene, faces: Faces, cells: Cells) -> Floats:
    """Return the nearness that infinite planes have at least in all of n cells, (n,); -inf if none.

    There is room for the rounding of the rays at the corners, and of those between.
    """
    camera = scene.camera
    parallel = camera.projection.shares_direction
    out = np.full(cells.low.shape[1], -np.inf)
    for plane in scene.planes:
        rays = camera_rays(camera, *(v.ravel() for v in cells.corners))
        found = plane_fractions(rays, plane.point[:, None], plane.normal[:, None])
        off = 2 * rounding(scene).ray * np.abs(plane.normal).max()
        moved = Fractions(
            found.numerator,
            found.numerator_error + (off if parallel else 0.0),
            found.denominator,
            found.denominator_error + (0.0 if parallel else off),
        )
        low, high = (np.broadcast_to(end, rays.count) for end in moved.interval())
        least, most = nearness(camera, low, high, ROUNDING)
        sure = np.isfinite(high) & faces.clip.inside(least, most)
        least = np.where(sure, least, -np.inf).reshape(4, -1).min(axis=0)
        out = np.maximum(out, least)
    return out


class Covers(NamedTuple):
    """Whether n cells are surely covered, how near at least, and an edge that is in the way."""

    sure: Bools
    least: Floats
    edge: Index  # k m + f; -1 for none


def covers(
    faces: Faces, base: Index, at: Floats, cells: Cells, face: Index | None = None
) -> Covers:
    """Decide whether `base` (n,), and what continues it, covers cells before `face` (n,), if any.

    `at` (2, n) is a film position in the cell, and within the face, that `base` has to cover.
    """
    count = len(base)
    sure = np.ones(count, bool)
    least = np.full(count, np.inf)
    blocking = np.full(count, -1, np.intp)
    item = np.arange(count)
    own = base
    seen = item * faces.count + own
    for number in range(_ROUNDS):
        found = reached(faces, own, cells.take(item))
        low = found.least[3] - faces.nearness_error[own]
        good = faces.sure[own] & faces.clip.inside(low, found.nearest)
        if number == 0:
            good &= surely_in(faces, own, at)
        if face is not None:
            nearer = np.flatnonzero(good)
            some = item[nearer]
            other = face[some]
            corners = cells.take(some).corners
            apart = faces.nearness_at(own[nearer], *corners) - faces.nearness_at(other, *corners)
            off = faces.nearness_error[own[nearer]] + faces.nearness_error[other]
            good[nearer] = (apart.min(axis=0) > off * (1 + 2.0**-40)) | (
                low[nearer] > faces.nearest[other]
            )
            rest = nearer[~good[nearer]]
            for test in (_before, _before_at_corner, _apart):
                rest = rest[~good[rest]]
                good[rest] = test(faces, own[rest], face[item[rest]])
        touches = found.touched
        sure[item[~good & (touches | (number == 0))]] = False
        np.minimum.at(least, item[touches], low[touches])
        k, row = np.nonzero(~found.inside & touches & sure[item])
        edge = k * faces.count + own[row]
        of = item[row]
        inside = _reaches(faces, edge, cells.take(of))
        edge, of = edge[inside], of[inside]
        if face is not None:
            inside = ~_beside(faces, edge, face[of])
            edge, of = edge[inside], of[inside]
        mate, keep = faces.across(edge)
        ends = np.flatnonzero(~keep)
        sure[of[ends]] = False
        blocking[of[ends]] = edge[ends]
        key = np.unique(of[keep] * faces.count + mate[keep] % faces.count)
        key = np.setdiff1d(key, seen, assume_unique=True)
        key = key[sure[key // faces.count]]
        if not len(key):
            return Covers(sure, least, blocking)
        seen = np.concatenate((seen, key))
        item, own = np.divmod(key, faces.count)
    sure[item] = False
    return Covers(sure, least, blocking)


def surely_in(faces: Faces, face: Index, at: Floats) -> Bools:
    """Return whether the rays of film positions (2, n) surely are within faces (n,)."""
    inside = (faces.at_points(face, *at)[:3] > faces.edge_error[face]).all(axis=0)
    return inside & faces.sure[face]


def _reaches(faces: Faces, edge: Index, cells: Cells) -> Bools:
    """Return which edges may reach into cells, by the boxes of their ends."""
    ends = faces.ends(edge)
    low = np.minimum(*(faces.at[0][:, end] for end in ends))
    high = np.maximum(*(faces.at[1][:, end] for end in ends))
    return ((low <= cells.high) & (high >= cells.low)).all(axis=0)


def _before(faces: Faces, own: Index, other: Index) -> Bools:
    """Return which faces surely are not behind others where a ray meets both."""
    out = np.zeros(len(own), bool)
    for plane, points, sign in ((own, other, -1), (other, own, 1)):
        rows = np.flatnonzero(~out)
        turn = faces.turn(plane[rows])
        sides = [faces.side(plane[rows], point) for point in faces.corners[:, points[rows]]]
        placed = np.stack(sides) * (sign * turn)
        flat = (placed == 0).all(axis=0)
        first = ~flat | (own[rows] < other[rows])  # in one plane, the first is seen
        out[rows] = (turn != 0) & (placed >= 0).all(axis=0) & first
    return out


def _before_at_corner(faces: Faces, own: Index, other: Index) -> Bools:
    """Return which faces surely are nearer than others with which they share one corner.

    On the film the difference of their nearness is linear, and zero in the corner: it is positive
    where both are if it is on those of their edges from there that are within the other one.
    """
    corners, others = faces.corners[:, own], faces.corners[:, other]
    same = faces.welded[corners][:, None] == faces.welded[others]
    at, place = same.any(axis=1).argmax(axis=0), same.any(axis=0).argmax(axis=0)
    order = (np.arange(3)[:, None] + at) % 3, (np.arange(3)[:, None] + place) % 3
    corner, *ends = np.take_along_axis(corners, order[0], axis=0)
    _, *far = np.take_along_axis(others, order[1], axis=0)
    ahead = faces.vertices.ahead
    out = (same.sum(axis=(0, 1)) == 1) & ahead[corners].all(axis=0) & ahead[others].all(axis=0)
    flat = own > other
    for face, sides, points, sign in ((own, ends, far, -1), (other, far, ends, 1)):
        turn = faces.turn(face)
        out &= turn != 0
        for point in points:
            beside = faces.orientation(corner, sides[0], point) * turn < 0
            beside |= faces.orientation(corner, point, sides[1]) * turn < 0
            side = faces.side(face, point) * turn * sign
            out &= beside | (side >= 0)
            flat &= side == 0
    return out & ~flat


def _apart(faces: Faces, own: Index, other: Index) -> Bools:
    """Return which faces no ray meets within others: an edge of one of them is between them."""
    out = np.zeros(len(own), bool)
    for face, points in ((own, other), (other, own)):
        for k in range(3):
            out |= _outside(faces, k * faces.count + face, faces.corners[:, points])
    return out


def _beside(faces: Faces, edge: Index, face: Index) -> Bools:
    """Return which edges surely do not reach into faces: an edge of the face, or they, separate."""
    a, b = faces.ends(edge)
    turns = np.stack([faces.orientation(a, b, point) for point in faces.corners[:, face]])
    out = (turns >= 0).all(axis=0) | (turns <= 0).all(axis=0)
    for k in range(3):
        out |= _outside(faces, k * faces.count + face, np.stack((a, b)))
    return out


def _outside(faces: Faces, edge: Index, points: Index) -> Bools:
    """Return whether all points (k, n) are outside edges (n,) of faces, or on their lines."""
    a, b = faces.ends(edge)
    turn = faces.turn(edge % faces.count)
    out = turn != 0
    for point in points:
        out &= faces.orientation(a, b, point) * turn <= 0
    return out
