"""Cases of a subject with what is true of them, and what a student's code made of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from reference_tracer.arrays import Bools, Floats, Index

from .form import Arrays
from .programs import Letters, columns
from .subjects.subject import Groups, Subject
from .tally import Tally
from .truth import truth
from .wrong_case import WrongCase

HIT = "hit"  # the share of those that are hit, or missed, as they should be
SHOWN = 6  # wrong cases, of as many groups


@dataclass(frozen=True, eq=False)
class TableCases:
    """Questions, (k, ...) each, and the truth about the n rows of their answers, (n, m).

    Masks are (n,).
    """

    subject: Subject
    given: Arrays
    group: Index
    letters: Letters
    right: Floats
    allowed: Floats  # how far an answer may be off
    doubt: Bools  # sound float64 may have it otherwise

    @classmethod
    def of(cls, subject: Subject, groups: Groups) -> TableCases:
        """Return cases with what is true of them."""
        names = list(subject.groups)
        given = tuple(np.concatenate(arrays) for arrays in zip(*groups.values(), strict=True))
        letters = subject.letters(*given)
        each = letters.shape[0] // len(given[0])
        counts = [len(arrays[0]) * each for arrays in groups.values()]
        group = np.repeat([names.index(name) for name in groups], counts)
        is_whole = np.repeat([name in subject.whole for name in groups], counts)
        found = truth(subject.programs[0], letters, is_whole)
        return cls(subject, given, group, letters, *found)

    @property
    def each(self) -> int:
        """How many answers a case has."""
        return len(self.group) // len(self.given[0])

    def among(self, *groups: str) -> Bools:
        """Return which are of some groups."""
        names = list(self.subject.groups)
        return np.isin(self.group, [names.index(name) for name in groups])

    @cached_property
    def counts(self) -> Bools:
        """Which are more than a means to tell mistakes apart."""
        return ~self.among(*self.subject.aside)

    @cached_property
    def tells(self) -> Bools:
        """Of which no rounding decides what a program makes, be it right or wrong."""
        return ~self.doubt & ~self.among(*self.subject.silent)

    @cached_property
    def firm(self) -> Bools:
        """Which are answered alike in every call."""
        return ~self.doubt & self.counts & ~self.among(*self.subject.close)

    def near(self, table: Floats, numbers: slice = slice(None)) -> Bools:
        """Return where some numbers of each answer are all right."""
        with np.errstate(all="ignore"):
            off = np.abs(table - self.right[:, numbers])
            return (off <= self.allowed[:, numbers]).all(axis=1)

    def answers(self, table: Floats) -> TableAnswers:
        """Return what a student's code made of them, (n, m)."""
        return TableAnswers(self, table)


@dataclass(frozen=True, eq=False)
class TableAnswers:
    """A student's answers to cases, rows (n, m); nothing is hit where the first is inf."""

    cases: TableCases
    table: Floats

    @cached_property
    def hit(self) -> Bools:
        """Where it says to hit."""
        return np.isfinite(self.table[:, 0])

    @cached_property
    def raised(self) -> Bools:
        """Where it raises."""
        return np.isneginf(self.table[:, 0])

    @cached_property
    def to_hit(self) -> Bools:
        """Where it should."""
        return np.isfinite(self.cases.right[:, 0])

    @cached_property
    def right(self) -> dict[str, Bools]:
        """Where each share of a score is right, by its name."""
        same = (self.hit == self.to_hit) & ~self.raised
        found = {
            part.name: same & (self.cases.near(self.table[:, numbers], numbers) | ~self.to_hit)
            for part, numbers in columns(self.cases.subject.parts)
        }
        return {name: found.get(name, same) for name in self.cases.subject.weights}

    @cached_property
    def wrong(self) -> Bools:
        """Where anything is wrong, without a doubt."""
        right = np.stack(list(self.right.values())).all(axis=0)
        return ~right & ~self.cases.doubt & self.cases.counts & ~self.raised

    @property
    def wrong_hits(self) -> Bools:
        """Where it hits what it should not, or the other way round, without a doubt."""
        return self.wrong & (self.hit != self.to_hit)

    def wrong_numbers(self, share: str = "") -> Bools:
        """Return where it hits, or misses, as it should, and numbers of a share are wrong."""
        own = self.wrong & (self.hit == self.to_hit)
        return own & ~self.right[share] if share else own

    @property
    def tally(self) -> Tally:
        """How many are right."""
        counted = (self.hit | self.to_hit | self.raised) & self.cases.counts
        return Tally.of(
            counted, self.cases.doubt & ~self.raised, self.right, self.cases.subject.weights
        )

    @property
    def examples(self) -> list[WrongCase]:
        """A wrong case of each of some groups."""
        cases = self.cases
        _, first = np.unique(cases.group[self.wrong], return_index=True)
        rows = np.flatnonzero(self.wrong)[first][:SHOWN]
        names = list(cases.subject.groups)
        return [
            WrongCase.of(
                cases.subject.form,
                names[cases.group[row]],
                tuple(array[row // cases.each] for array in cases.given),
                cases.right[row],
                self.table[row],
                place=row % cases.each,
            )
            for row in rows.tolist()
        ]
