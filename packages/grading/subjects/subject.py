"""What a subject is: a record that everything looks up."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from reference_tracer.arrays import Floats

from ..form import Form
from ..programs import Letters, Mask, Part, Program


def side_by_side(*answers: Floats) -> Floats:
    """Return arrays of answers (n, ...) as rows of numbers, (n, m)."""
    return np.concatenate([a.reshape(len(a), -1) for a in answers], axis=1)


@dataclass(frozen=True, eq=False)
class Subject:
    """What students are asked to write, and all that judging needs to know of it."""

    name: str
    title: str  # what several students' are called
    form: Form
    programs: tuple[Program, ...]
    weights: Mapping[str, float]  # of shares of a score: the first, and those of it
    groups: Mapping[str, str]  # of the cases, and what each shows
    letters: Callable[..., Letters]  # what is given -> what formulas begin with
    cases: Callable[[], Any]  # -> what is asked, as `Cases` below
    # What is answered -> rows of numbers (n, m), which the programs' answers are compared with.
    rows: Callable[..., Floats] = side_by_side

    @property
    def parts(self) -> tuple[Part, ...]:
        """Which numbers of an answer are right or wrong together."""
        return self.programs[0].parts


class Cases(Protocol):
    """What a student's code is asked: (n,) cases of some groups, some of which tell."""

    def __hash__(self) -> int:
        """Cases are the same only if they are one: what is found of them is kept."""

    @property
    def subject(self) -> Subject:
        """What is asked."""

    @property
    def given(self) -> tuple[Floats, ...]:
        """What the function is given."""

    @property
    def letters(self) -> Letters:
        """What the programs begin with."""

    @property
    def group(self) -> NDArray[np.int64]:
        """The number of each case's group, (n,)."""

    @property
    def tells(self) -> Mask:
        """Where no rounding decides, (n,)."""

    @property
    def firm(self) -> Mask:
        """Where no rounding decides, however a sum is ordered: asked twice, it answers twice."""

    def answers(self, table: Floats) -> Any:
        """Return what a function made of them, rows (n, m), as `faults.Answers`."""
