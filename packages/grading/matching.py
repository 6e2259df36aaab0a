"""Finds the wrong program that answers as a student's function does: with one mutation, or two.

The function's answers to the checks are held against those of every mutation of every program, then
of every two mutations. A mutation is named only if it answers alike in all pairs, and if it is no
right program: some are, as a normal may point either way.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property, reduce
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from reference_tracer.arrays import Floats

from .answers import Answers, Mask
from .checks import Checks, Group
from .mutations import Mutation, mutations
from .programs import PROGRAMS, Program

DIGITS = 1e-9  # relative: two orders of summation of a wrong formula differ by far less
FEW = 2e-3  # share of pairs in which rounding may decide what a wrong program answers
NEARLY = 0.03  # share of the few pairs that are asked first
LEAST = 30  # answers with numbers that have to agree: fewer say little
EACH = 8  # pairs of a group with which two mutations at once are tried first


class Questions(NamedTuple):
    """Pairs: origins (n, 3), directions (n, 3), triangles (n, 3, 3)."""

    origins: Floats
    directions: Floats
    triangles: Floats


class Replies(NamedTuple):
    """What a function makes of them: t (n,), inf for a miss, and barycentrics (n, 3)."""

    t: Floats
    s: Floats


@dataclass(frozen=True, eq=False)
class Match:
    """A right program, and what is wrong with it, one thing or two: so it answers as a function."""

    right: Program
    wrong: tuple[Mutation, ...]

    @cached_property
    def program(self) -> Program:
        """The program with what is wrong."""
        return reduce(lambda program, mutation: mutation.of(program), self.wrong, self.right)

    def agrees(self, asked: Questions, replies: Replies) -> bool:
        """Return whether the program gives these replies, too."""
        return alike(replies, Replies(*self.program.answers(*asked)))


def with_one(answers: Answers) -> list[Match]:
    """Return the wrong programs with one mutation that answer as a function did."""
    return _found(answers, _single(answers.checks))


def with_two(answers: Answers) -> list[Match]:
    """Return the wrong programs with two mutations that answer as a function did."""
    return _found(answers, _double(answers.checks))


def alike(own: Replies, other: Replies) -> bool:
    """Return whether a function answers as a program does, but for rounding.

    What a function gives as barycentrics where it misses counts, too, if it gives any: of programs
    that never hit it is all that tells them apart.
    """
    told = _told(own).sum()
    return bool(_unlike(own, other) <= FEW and told >= min(LEAST, len(own.t)))


def _unlike(own: Replies, other: Replies) -> NDArray[np.float64]:
    """Return the share of pairs that a function answers otherwise than some programs, (...).

    Parameters
    ----------
    own : Replies
        t (n,) and barycentrics (n, 3).
    other : Replies
        t (..., n) and barycentrics (..., n, 3).
    """
    hit, also = np.isfinite(own.t), np.isfinite(other.t)
    with np.errstate(all="ignore"):
        size = np.maximum(1, _largest(other.s))
        s_off = ~(_largest(own.s - other.s) <= DIGITS * size) | ~np.isfinite(size)
        t_off = ~(np.abs(own.t - other.t) <= DIGITS * np.abs(other.t))
    off = (hit != also) | (hit & also & t_off) | (_told(own) & s_off)
    return off.mean(axis=-1)


def _largest(s: Floats) -> Floats:
    """Return the largest of each three, without their signs: max(axis=-1) is slow for so few."""
    size = np.abs(s)
    return np.maximum(np.maximum(size[..., 0], size[..., 1]), size[..., 2])


def _told(own: Replies) -> Mask:
    """Return where a function gives barycentrics at all: of a miss it may give anything."""
    size = _largest(own.s)
    given = np.isfinite(size) & (size > 0)
    return given | np.isfinite(own.t)


@dataclass(frozen=True, eq=False)
class _Known:
    """Wrong programs, and what each makes of a few pairs: t (m, few), barycentrics (m, few, 3)."""

    matches: list[Match]
    few: NDArray[np.intp]  # which of the pairs that tell
    replies: Replies


def _found(answers: Answers, known: _Known) -> list[Match]:
    tells = _tells(answers.checks)
    own = Replies(answers.t[tells], answers.s[tells])
    if _told(own).sum() < LEAST:
        return []
    near = _unlike(Replies(own.t[known.few], own.s[known.few]), known.replies) <= NEARLY
    asked = _questions(answers.checks)
    return [known.matches[k] for k in np.flatnonzero(near) if known.matches[k].agrees(asked, own)]


def _tells(checks: Checks) -> Mask:
    """Return which pairs tell: where the plane is met, and no rounding decides."""
    return ~checks.known.doubt & ~checks.of(Group.PARALLEL, Group.EMPTY)


@cache
def _questions(checks: Checks) -> Questions:
    tells = _tells(checks)
    return Questions(checks.origins[tells], checks.directions[tells], checks.triangles[tells])


def _few(checks: Checks) -> NDArray[np.intp]:
    group = checks.group[_tells(checks)]
    return np.concatenate([np.flatnonzero(group == g)[:EACH] for g in np.unique(group)])


def _asked(checks: Checks, matches: list[Match]) -> _Known:
    few = _few(checks)
    asked = Questions(*(a[few] for a in _questions(checks)))
    replies = [m.program.answers(*asked) for m in matches]
    t, s = (np.stack(parts) for parts in zip(*replies, strict=True))
    return _Known(matches, few, Replies(t, s))


@cache
def _single(checks: Checks) -> _Known:
    """Return all wrong programs with one mutation; some mutations make no wrong one."""
    asked = _questions(checks)
    out = []
    for right in PROGRAMS:
        expected = Replies(*right.answers(*asked))
        found = (Match(right, (m,)) for m in mutations(right))
        out += [m for m in found if not m.agrees(asked, expected)]
    return _asked(checks, out)


@cache
def _double(checks: Checks) -> _Known:
    """Return wrong programs with two mutations; of those that few pairs tell apart one is taken."""
    t, s = _single(checks).replies
    different: list[int] = []
    for k in range(len(t)):
        if not (_unlike(Replies(t[k], s[k]), Replies(t[different], s[different])) == 0).any():
            different.append(k)
    single = [_single(checks).matches[k] for k in different]
    out = [
        Match(one.right, one.wrong + two.wrong)
        for one, two in combinations(single, 2)
        if one.right is two.right and one.wrong[0].apart_from(two.wrong[0])
    ]
    return _asked(checks, out)
