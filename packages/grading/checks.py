"""Makes pairs of rays and triangles that show one thing each, with what is true of them.

They come in groups. What a student's function makes of a group says what is wrong with it
(`faults.py`), which a picture alone would not: no camera has a triangle behind it, and a closed
surface looks the same without its back faces.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum
from functools import cache, cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from reference_tracer.arrays import Floats

from .known import Known, known
from .programs import Letters
from .subjects.subject import Subject
from .subjects.triangle import TRIANGLE, letters

if TYPE_CHECKING:
    from .answers import Answers

SEED = 20240611
EACH = 400  # pairs of a group
SCALES = -30, -20, 20  # powers of two: what a float is multiplied by without rounding


class Group(IntEnum):
    """What a pair is to show."""

    FRONT = 0  # an ordinary hit, the corners counter-clockwise as the ray sees them
    BACK = 1  # the same, from the other side
    WHOLE = 2  # a hit without any rounding: all numbers are whole, or halved some times
    SCALED = 3  # the front's pairs, SCALES times as large
    OUTSIDE = 4  # the ray passes the triangle beyond one of its edges, or beyond two
    BESIDE = 5  # it passes closely beside an edge, at 1e-9 to 1e-4 of the triangle
    BEHIND = 6  # the triangle is behind the ray's origin
    PARALLEL = 7  # the ray is parallel to the triangle's plane, exactly
    EMPTY = 8  # the triangle has no area: what is said of it is not held against anyone
    ELSEWHERE = (
        9  # anywhere in the plane, before or behind: wrong programs that hit nothing do here
    )


ORDINARY = Group.FRONT, Group.BACK, Group.WHOLE  # hits with nothing difficult about them


Pairs = tuple[Floats, Floats, Floats]  # origins, directions, triangles


@dataclass(frozen=True, eq=False)
class Checks:
    """All pairs, (n, ...), with their groups and what is true of them."""

    origins: Floats
    directions: Floats
    triangles: Floats
    group: NDArray[np.int64]
    twin: NDArray[np.int64]  # of SCALED: which pair it is a multiple of
    known: Known

    @property
    def subject(self) -> Subject:
        """What is asked."""
        return TRIANGLE

    @property
    def given(self) -> Pairs:
        """What the student's function is given."""
        return self.origins, self.directions, self.triangles

    @cached_property
    def letters(self) -> Letters:
        """What the programs begin with."""
        return letters(*self.given)

    @property
    def tells(self) -> NDArray[np.bool_]:
        """Which pairs tell: where the plane is met, and no rounding decides, (n,)."""
        told = ~self.known.doubt | self.of(Group.ELSEWHERE)
        return told & ~self.of(Group.PARALLEL, Group.EMPTY)

    @property
    def firm(self) -> NDArray[np.bool_]:
        """Which pairs are answered alike in every call, (n,)."""
        return ~self.known.doubt & ~self.of(Group.BESIDE)

    def answers(self, table: Floats) -> Answers:
        """Return what a function made of them, t and barycentrics (n, 4)."""
        from .answers import Answers

        return Answers(self, table[:, 0], table[:, 1:])

    def of(self, *groups: Group) -> NDArray[np.bool_]:
        """Return which pairs are of some groups, (n,)."""
        return np.isin(self.group, groups)


@cache
def make_checks(seed: int = SEED) -> Checks:
    """Return the checks; the same for the same seed."""
    rng = np.random.default_rng(seed)
    front = _towards(rng, _triangles(rng), rng.dirichlet((2, 2, 2), EACH) * 0.85 + 0.05)
    o, d, p = front
    groups = {
        Group.FRONT: front,
        Group.BACK: (o, d, p[:, [0, 2, 1]]),
        Group.WHOLE: _whole(rng),
        Group.SCALED: _scaled(front),
        Group.OUTSIDE: _towards(rng, _triangles(rng), _outside(rng)),
        Group.BESIDE: _towards(rng, _triangles(rng), _beside(rng)),
        Group.BEHIND: (o, -d, p),
        Group.PARALLEL: _parallel(rng),
        Group.EMPTY: _empty(rng),
        Group.ELSEWHERE: _elsewhere(rng),
    }
    numbers = [np.full(len(some[0]), group) for group, some in groups.items()]
    group = np.concatenate(numbers)
    twin = np.full(len(group), -1)
    twin[group == Group.SCALED] = np.tile(np.arange(EACH), len(SCALES))
    o, d, p = (np.concatenate(parts) for parts in zip(*groups.values(), strict=True))
    truth = known(o, d, p)
    # d . n is exactly 0, and comes out so: there is nothing to round.
    doubt = truth.doubt & (group != Group.PARALLEL) | (group == Group.ELSEWHERE)
    truth = replace(truth, doubt=doubt)
    return Checks(o, d, p, group, twin, truth)


def _triangles(rng: np.random.Generator) -> Floats:
    """Return triangles of an ordinary shape, (EACH, 3, 3)."""
    out = np.zeros((0, 3, 3))
    while len(out) < EACH:
        p = rng.normal(size=(EACH, 3, 3))
        n = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
        longest = np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2).max(axis=1)
        high = np.linalg.norm(n, axis=1) > 0.3 * longest**2
        out = np.concatenate((out, p[high & (longest > 0.5)]))
    return out[:EACH]


def _powers(base: float, exponents: Floats) -> Floats:
    """Return powers one by one: numpy's last digit depends on the processor's vector unit."""
    return np.array([base**e for e in exponents.ravel().tolist()]).reshape(exponents.shape)


def _towards(rng: np.random.Generator, p: Floats, s: Floats) -> Pairs:
    """Return rays towards points of triangles' planes, from the front, at no small angle."""
    n = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    away = rng.normal(size=n.shape)
    away /= np.linalg.norm(away, axis=1, keepdims=True)
    away = n + 0.6 * away
    length, speed = rng.uniform(2, 6, (len(n), 1)), _powers(2, rng.uniform(-2, 2, (len(n), 1)))
    point = (s[:, :, None] * p).sum(axis=1)
    return point + length * away, -speed * away, p


def _outside(rng: np.random.Generator) -> Floats:
    """Return barycentrics of which one or two are clearly negative."""
    s = rng.uniform(0.1, 1, (EACH, 3))
    which = np.arange(EACH)
    s[which, which % 3] *= -1
    two = which % 2 == 1
    s[which[two], (which[two] + 1) % 3] *= -1
    total = s.sum(axis=1, keepdims=True)
    s += np.where(s > 0, 1.5 - total, 0) / (s > 0).sum(axis=1, keepdims=True)
    return s / s.sum(axis=1, keepdims=True)


def _elsewhere(rng: np.random.Generator) -> Pairs:
    """Return rays through points all around their triangles, half of them behind the origin."""
    s = rng.uniform(-1.5, 2, (EACH, 3))
    s[:, 0] = 1 - s[:, 1] - s[:, 2]
    o, d, p = _towards(rng, _triangles(rng), s)
    return np.tile(o, (2, 1)), np.concatenate((d, -d)), np.tile(p, (2, 1, 1))


def _beside(rng: np.random.Generator) -> Floats:
    """Return barycentrics of which one is nearly 0, on either side."""
    s = rng.uniform(0.2, 0.8, (EACH, 3))
    which = np.arange(EACH)
    s[which, which % 3] = 0
    s /= s.sum(axis=1, keepdims=True)
    by = np.where(which % 2, 1, -1) * _powers(10, rng.uniform(-9, -4, EACH))
    s[which, which % 3] = by
    s[which, (which + 1) % 3] -= by
    return s


def _whole(rng: np.random.Generator) -> Pairs:
    """Return hits whose every product, sum and quotient is a float: legs are powers of two."""
    legs = 2.0 ** rng.integers(0, 4, (EACH, 2))
    s2 = rng.integers(1, 8, EACH) / 16
    s3 = rng.integers(1, 8, EACH) / 16
    p1 = rng.integers(-8, 9, (EACH, 3)).astype(float)
    p = np.repeat(p1[:, None], 3, axis=1)
    p[:, 1, 0] += legs[:, 0]
    p[:, 2, 1] += legs[:, 1]
    d = np.stack(
        (*(rng.integers(-2, 3, (2, EACH))), np.where(rng.random(EACH) < 0.5, 1, -1)), axis=1
    ) * 2.0 ** rng.integers(-2, 3, (EACH, 1))
    point = p1 + s2[:, None] * (p[:, 1] - p1) + s3[:, None] * (p[:, 2] - p1)
    o = point - 4 * d
    turn = rng.integers(0, 3, EACH)  # which axis the triangle is across
    order = (np.arange(3) + turn[:, None]) % 3
    return (
        np.take_along_axis(o, order, axis=1),
        np.take_along_axis(d, order, axis=1),
        np.take_along_axis(p, order[:, None], axis=2),
    )


def _scaled(front: Pairs) -> Pairs:
    o, d, p = front
    scales = [2.0**k for k in SCALES]
    return (
        np.concatenate([o * k for k in scales]),
        np.concatenate([d for _ in scales]),
        np.concatenate([p * k for k in scales]),
    )


def _parallel(rng: np.random.Generator) -> Pairs:
    """Return rays along the plane of a triangle of integers, beside it, over its middle."""
    p = np.zeros((0, 3, 3))
    while len(p) < EACH:
        some = rng.integers(-9, 10, (EACH, 3, 3)).astype(float)
        n = np.cross(some[:, 1] - some[:, 0], some[:, 2] - some[:, 0])
        p = np.concatenate((p, some[np.abs(n).sum(axis=1) > 20]))
    p = p[:EACH]
    e, f = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    d = rng.integers(1, 4, (EACH, 1)) * e + rng.integers(-3, 4, (EACH, 1)) * f
    n = np.cross(e, f)
    return p[:, 0] - 2 * d + np.sign(n), d, p


def _empty(rng: np.random.Generator) -> Pairs:
    """Return rays through the middle of triangles whose corners are in a line, or one point."""
    first = rng.integers(-9, 10, (EACH, 3)).astype(float)
    e = rng.integers(-4, 5, (EACH, 3)).astype(float)
    e[::4] = 0
    p = np.stack((first, first + 2 * e, first + 4 * e), axis=1)
    d = rng.integers(-4, 5, (EACH, 3)) + 0.5
    return first + e - 2 * d, d, p
