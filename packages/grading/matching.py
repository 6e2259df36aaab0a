"""Finds the wrong program that answers as a student's function does: with one mutation, or two.

The function's answers to the cases are held against those of every mutation of every program, then
of every two mutations. A mutation is named only if it answers alike in all cases, and if it is no
right program: some are, as a normal may point either way.

Answers are (n, m), m numbers of the parts; nothing is hit where the first is not finite.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache, cached_property, reduce
from itertools import combinations

import numpy as np
from reference_tracer.arrays import Bools, Floats, Places

from .cases import TableCases
from .mutations import Mutation, mutations
from .programs import Letters, Parts, Program, columns

DIGITS = 1e-9  # relative: two orders of summation of a wrong formula differ by far less
FEW = 2e-3  # share of cases in which rounding may decide what a wrong program answers
NEARLY = 0.03  # share of the few cases that are asked first
LEAST = 8  # answers with numbers that have to agree: fewer say little
EACH = 8  # cases of a group with which two mutations at once are tried first


@dataclass(frozen=True, eq=False)
class Match:
    """A right program, and what is wrong with it, one thing or two: so it answers as a function."""

    right: Program
    wrong: tuple[Mutation, ...]

    @cached_property
    def program(self) -> Program:
        """The program with what is wrong."""
        return reduce(lambda program, mutation: mutation.of(program), self.wrong, self.right)

    def agrees(self, asked: Letters, replies: Floats) -> bool:
        """Return whether the program gives these replies, too."""
        return alike(replies, self.program.answers(asked), self.right.parts)

    def put_right(self, asked: Letters, replies: Floats) -> Floats:
        """Return what a function would reply with this put right: all that it explains is right.

        Where it does not reply as the wrong program does, something else is wrong: that stays.
        """
        other = differs(replies, self.program.answers(asked), self.right.parts, DIGITS)
        kept = np.isneginf(replies[:, 0]) | (other & (other.mean() > FEW))
        return np.where(kept[:, None], replies, self.right.answers(asked))


def alike(own: Floats, other: Floats, parts: Parts) -> bool:
    """Return whether a function answers as a program does, but for rounding.

    What a function gives beside the first part where it misses counts, too, if it gives any: of
    programs that never hit it is all that tells them apart.
    """
    told = _told(own, parts).sum()
    return bool(_unlike(own, other, parts) <= FEW and told >= min(LEAST, len(own)))


def differs(
    own: Floats, other: Floats, parts: Parts, digits: float, strictly: bool = True
) -> Bools:
    """Return where a function answers otherwise than another, or than several, (..., n).

    Parameters
    ----------
    own : (n, m)
    other : (..., n, m)
    digits : float
        How far numbers may be off, relative to the largest of their part.
    strictly : bool, optional
        Whether what is given where nothing is hit counts, too, and what is no number.
    """
    hit, also = np.isfinite(own[..., 0]), np.isfinite(other[..., 0])
    off = hit != also
    with np.errstate(all="ignore"):
        for k, (part, numbers) in enumerate(columns(parts)):
            size = np.maximum(part.least, _largest(other[..., numbers]))
            by = _largest(own[..., numbers] - other[..., numbers])
            if strictly:
                asked = _given(own[..., numbers]) | hit if k else hit & also
                off = off | (asked & ~((by <= digits * size) & np.isfinite(size)))
            else:
                off = off | (hit & also & (by > digits * size))
    return off


def _unlike(own: Floats, other: Floats, parts: Parts) -> Floats:
    """Return the share of cases that a function answers otherwise than some programs, (...)."""
    return differs(own, other, parts, DIGITS).mean(axis=-1)


def _largest(numbers: Floats) -> Floats:
    """Return the largest of each few, without their signs: max(axis=-1) is slow for so few."""
    size = np.abs(numbers)
    return reduce(np.maximum, (size[..., k] for k in range(size.shape[-1])))


def _given(numbers: Floats) -> Bools:
    """Return where a function gives numbers at all: of a miss it may give anything."""
    size = _largest(numbers)
    return np.isfinite(size) & (size > 0)


def _told(own: Floats, parts: Parts) -> Bools:
    told: Bools = np.isfinite(own[:, 0])
    for _, numbers in columns(parts)[1:]:
        told = told | _given(own[:, numbers])
    return told


# Wrong programs, and what each makes of a few cases, (p, few, m).
_Known = tuple[list[Match], Floats]


def matches(
    cases: TableCases, replies: Floats, programs: Callable[[TableCases], _Known]
) -> list[Match]:
    """Return those of `singles` or `doubles` that answer as a function did, (n, m)."""
    own, parts = replies[cases.tells], cases.subject.parts
    if _told(own, parts).sum() < LEAST:
        return []
    known, theirs = programs(cases)
    near = _unlike(own[_few(cases)], theirs, parts) <= NEARLY
    asked = _questions(cases)
    return [known[k] for k in np.flatnonzero(near) if known[k].agrees(asked, own)]


@cache
def _questions(cases: TableCases) -> Letters:
    return cases.letters.take(np.flatnonzero(cases.tells))


@cache
def _few(cases: TableCases) -> Places:
    """Return which of the cases that tell are tried first."""
    group = cases.group[cases.tells]
    return np.concatenate([np.flatnonzero(group == g)[:EACH] for g in np.unique(group)])


def _known(cases: TableCases, matches: Iterable[Match]) -> _Known:
    """Return wrong programs with what they make of the few; those that are right are left out."""
    parts, asked = cases.subject.parts, _questions(cases)
    few = asked.take(_few(cases))
    expected = {id(p): (p.answers(few), p.answers(asked)) for p in cases.subject.programs}
    found, replies = [], []
    for match in matches:
        own, (of_few, of_all) = match.program.answers(few), expected[id(match.right)]
        unlike = differs(own, of_few, parts, DIGITS).sum()
        if unlike > FEW * len(of_all) or not match.agrees(asked, of_all):
            found.append(match)
            replies.append(own)
    return found, np.stack(replies)


@cache
def singles(cases: TableCases) -> _Known:
    """Return all wrong programs with one mutation; some mutations make no wrong one."""
    every = (Match(right, (m,)) for right in cases.subject.programs for m in mutations(right))
    return _known(cases, every)


@cache
def doubles(cases: TableCases) -> _Known:
    """Return wrong programs with two mutations; of those that few cases tell apart one is taken."""
    known, replies = singles(cases)
    different: list[int] = []
    for k, own in enumerate(replies):
        if (_unlike(own, replies[different], cases.subject.parts) > 0).all():
            different.append(k)
    pairs = combinations([known[k] for k in different], 2)
    return _known(
        cases,
        (
            Match(one.right, one.wrong + two.wrong)
            for one, two in pairs
            if one.right is two.right and one.wrong[0].apart_from(two.wrong[0])
        ),
    )
