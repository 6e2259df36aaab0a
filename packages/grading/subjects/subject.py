"""The record of a subject, which everything looks up."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reference_tracer.arrays import Floats

from ..form import Arrays, Form, side_by_side
from ..group_faults import TESTS, Tests
from ..programs import Letters, Parts, Program

if TYPE_CHECKING:
    from ..cases import TableCases


Groups = Mapping[str, Arrays]  # what is given, by the names of groups of cases


@dataclass(frozen=True, eq=False)
class Subject:
    """A subject: what students write, and all that judging needs to know of it."""

    name: str
    title: str  # what several students' are called
    form: Form
    programs: tuple[Program, ...]
    weights: Mapping[str, float]  # of shares of a score: the first, and those of it
    groups: Mapping[str, str]  # of the cases, and what each shows
    letters: Callable[..., Letters]  # what is given -> what formulas begin with
    asked: Callable[[], Groups]  # the same each time
    # What is answered -> rows of numbers (n, m), which the programs' answers are compared with.
    rows: Callable[..., Floats] = side_by_side
    tests: tuple[Tests, ...] = TESTS  # for faults that are no mutation of a formula
    whole: Collection[str] = ()  # groups in which float64 rounds nothing
    aside: Collection[str] = ()  # that count for nothing, and only tell mistakes apart
    silent: Collection[str] = ()  # that do not tell them apart
    close: Collection[str] = ()  # in which the order of a sum decides in float32

    @property
    def parts(self) -> Parts:
        """Which numbers of an answer are right or wrong together."""
        return self.programs[0].parts

    def cases(self) -> TableCases:
        """Return what is asked, with what is true of it."""
        from ..cases import TableCases  # late: cases have their subject

        return TableCases.of(self, self.asked())
