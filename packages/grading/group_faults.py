"""Faults of any subject that are no mutation of a formula: each says where it shows, and can fail.

A group of cases shows one thing (`Subject.groups`). Where nearly all of a group are wrong, in one
way, and hardly any of those of other groups, that thing is what is wrong.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from reference_tracer.arrays import Bools, Floats

from .programs import columns

if TYPE_CHECKING:
    from .cases import TableAnswers

MOST, FEW = 0.9, 0.1  # shares of a group: "nearly all", "hardly any"
FLOAT32 = 2.0**-24  # its rounding unit
LOSSY = 300  # of those: as far as ordinary cases may be off that were computed in float32
LEAST = FLOAT32 / 64  # and as far as half of them are off at least

# A fault's name, a sentence, the answers that it explains.
Found = Iterator[tuple[str, str, Bools]]


class Tests(NamedTuple):
    """The tests for why answers of one kind are wrong, and what these are called."""

    what: str  # "hits", or numbers of what is hit as it should be
    tests: tuple[Callable[[Any], Found], ...]
    share: str = ""  # of a score: the numbers are its own; else all


def never(a: TableAnswers) -> Found:
    """See whether it never says to hit, or never gives what there always is."""
    if a.to_hit.all():
        text = "what it returns is NaN or infinite, or a direction without a length"
        if not a.hit.all():
            yield "not_finite", text, ~a.hit
    elif not a.hit.any():
        yield "no_hits", "it never reports a hit", a.wrong


def always(a: TableAnswers) -> Found:
    """See whether it always says to hit."""
    if a.hit.all() and not a.to_hit.all():
        yield "all_hits", "it reports a hit for every case: of a miss, t must be infinite", a.wrong


def whole_groups(a: TableAnswers) -> Found:
    """See whether groups are missed, or hit, that should not be."""
    for name, what, wrong in (
        ("misses", "missed", a.to_hit & ~a.hit),
        ("hits", "hit", a.hit & ~a.to_hit),
    ):
        for group in _groups(a, wrong & a.wrong):
            text = f"{a.cases.subject.groups[group]}: these are {what}, and should not be"
            yield f"{name}_{group}", text, wrong & a.cases.among(group)


def _groups(a: TableAnswers, wrong: Bools) -> list[str]:
    """Return the groups of which nearly all are wrong, if the others are nearly all right."""
    judged, out, rest = ~a.cases.doubt, [], np.zeros(len(wrong), bool)
    for name in a.cases.subject.groups:
        own = a.cases.among(name) & judged
        if own.any() and wrong[own].mean() > MOST:
            out.append(name)
        else:
            rest |= own
    return out if rest.any() and a.wrong[rest].mean() < FEW else []


def no_numbers(a: TableAnswers) -> Found:
    """See whether what is hit has no numbers."""
    broken = a.hit & ~np.isfinite(a.table).all(axis=1)
    if broken.any():
        yield "not_finite", "numbers of an answer are NaN or infinite", broken


def single(a: TableAnswers, share: str = "") -> Found:
    """See whether numbers, those of a share or all, have the digits of float32."""
    off = _off(a, share)
    own = a.wrong_numbers(share)
    if own.any() and (off[own] < LOSSY * FLOAT32).mean() > MOST and np.median(off[own]) > LEAST:
        text = (
            f"{share or 'numbers'} off by {np.median(off[own]):.0e}: computed in float32, which "
            "keeps 7 digits of the 16 that float64 has"
        )
        yield "float32", text, off < LOSSY * FLOAT32


@np.errstate(all="ignore")
def _off(a: TableAnswers, share: str) -> Floats:
    """Return how far numbers are off, relative to the largest that has a share in them, (n,)."""
    right = a.cases.right
    off = np.zeros(len(right))
    for part, numbers in columns(a.cases.subject.parts):
        if share in ("", part.name):
            by = np.abs(a.table[:, numbers] - right[:, numbers]).max(axis=1)
            by[by > 0] /= np.abs(right[by > 0, numbers]).max(axis=1)  # object 0 is no 0 / 0
            off = np.maximum(off, by)
    return off


TESTS = Tests("hits", (never, always, whole_groups)), Tests("answers", (no_numbers, single))
