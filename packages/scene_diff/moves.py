"""Finds the transform that takes one object's triangles to another's, and says it in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations, product
from typing import NamedTuple

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.camera_files.frame import rotation_vector

from .matching import matched

MARGIN = 4  # tolerances: what a fitted transform is off by, besides
_UNIT = 1e-5  # of a length, an angle in radians: what is told as the same
_AXES = [  # all exchanges of axes, with all signs
    np.eye(3)[list(order)] * np.array(signs)
    for order in permutations(range(3))
    for signs in product((1.0, -1.0), repeat=3)
]


@dataclass(frozen=True, eq=False)
class Move:
    """A transform x -> axes x + by, of world space."""

    axes: Floats  # (3, 3)
    by: Floats  # (3,) metres
    centre: Floats  # (3,) of the object before, metres

    def of(self, triangles: Floats) -> Floats:
        """Return triangles (n, 3, 3), moved."""
        return triangles @ self.axes.T + self.by

    @property
    def moved(self) -> Floats:
        """How far the object's centre is moved, (3,) metres."""
        return self.axes @ self.centre + self.by - self.centre

    def words(self, tolerance: float) -> str:
        """Say what the transform does."""
        lengths = np.sqrt((self.axes * self.axes).sum(axis=0))
        said = []
        if np.ptp(lengths) > _UNIT * lengths.max():
            said.append("scaled by ({:.6g}, {:.6g}, {:.6g})".format(*lengths))
        elif abs(lengths.mean() - 1) > _UNIT:
            said.append(f"scaled by {lengths.mean():.6g}")
        unit = self.axes / lengths
        if np.abs(unit.T @ unit - np.eye(3)).max() > _UNIT:
            return "sheared"
        if np.linalg.det(unit) < 0:
            said.append("mirrored")
            unit = -unit
            if np.abs(unit).max() > 1 - _UNIT and np.trace(unit) > -1 - _UNIT:
                unit = np.eye(3)
        said += _turn(unit)
        if np.abs(self.moved).max() > 2 * tolerance:
            said.append("moved by ({:+.6g}, {:+.6g}, {:+.6g}) m".format(*self.moved))
        return " and ".join(said) or "unchanged"


def _turn(unit: Floats) -> Iterator[str]:
    """Yield what a rotation (3, 3) does, if anything."""
    turn = rotation_vector(unit)
    angle = np.degrees(np.linalg.norm(turn))
    if angle <= np.degrees(_UNIT):
        return
    axis = turn / np.linalg.norm(turn)
    named = np.flatnonzero(np.abs(axis) > 1 - _UNIT)
    if len(named):
        sign = "" if axis[named[0]] > 0 else "-"
        yield f"turned by {sign}{angle:.6g} degrees about {'XYZ'[named[0]]}"
    else:
        yield "turned by {:.6g} degrees about ({:.4g}, {:.4g}, {:.4g})".format(angle, *axis)


def move_between(first: Floats, second: Floats, tolerance: float) -> Move | None:
    """Return the transform that takes triangles (n, 3, 3) to others, on either side, if any."""
    if len(first) != len(second) or not len(first):
        return None
    turned = None
    for move in _guesses(first, second):
        if not np.isfinite(move.axes).all():
            continue
        found = matched(move.of(first), second, MARGIN * tolerance)
        if (found.same > 0).all():
            return move
        if turned is None and found.there.all():
            turned = move
    return turned


def _guesses(first: Floats, second: Floats) -> Iterator[Move]:
    """Yield transforms: of axes and a scale about the centres, then by the order of the corners."""
    own, other = _body(first), _body(second)
    scale = other.spread / own.spread if own.spread > 0 else 1.0
    for axes in _AXES:
        if np.abs(axes @ own.shape @ axes.T - other.shape).max() < 1e-3:
            yield Move(scale * axes, other.centre - scale * axes @ own.centre, own.centre)
    axes = np.linalg.lstsq(own.corners, other.corners, rcond=None)[0].T
    yield Move(axes, other.centre - axes @ own.centre, own.centre)


class _Body(NamedTuple):
    """The corners of triangles, without regard to their order."""

    centre: Floats  # (3,)
    corners: Floats  # (n, 3) from the centre
    spread: float  # the root of their mean square
    shape: Floats  # (3, 3) their second moments, whatever their size and place


def _body(triangles: Floats) -> _Body:
    centre = triangles.mean(axis=(0, 1))
    corners = (triangles - centre).reshape(-1, 3)
    spread = np.sqrt((corners**2).mean())
    unit = corners / (spread or 1.0)
    return _Body(centre, corners, spread, unit.T @ unit / len(unit))
