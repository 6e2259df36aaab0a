"""The record of a subject, which everything looks up."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from reference_tracer.arrays import Floats

from ..form import Form
from ..group_faults import TESTS, Tests
from ..programs import Letters, Part, Program

if TYPE_CHECKING:
    from ..cases import TableCases


def side_by_side(*answers: Floats) -> Floats:
    """Return arrays of answers (n, ...) as rows of numbers, (n, m)."""
    return np.concatenate([a.reshape(len(a), -1) for a in answers], axis=1)


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
    cases: Callable[[], TableCases]  # -> what is asked
    # What is answered -> rows of numbers (n, m), which the programs' answers are compared with.
    rows: Callable[..., Floats] = side_by_side
    tests: tuple[Tests, ...] = TESTS  # for faults that are no mutation of a formula

    @property
    def parts(self) -> tuple[Part, ...]:
        """Which numbers of an answer are right or wrong together."""
        return self.programs[0].parts
