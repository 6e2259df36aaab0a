"""The input and output of a student's code: arrays in Python, lines of numbers elsewhere."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Array, Floats

Arrays = tuple[Floats, ...]  # what is given, or answered: one for each field


def side_by_side(*arrays: Floats) -> Floats:
    """Return arrays (n, ...) as rows of numbers, (n, m)."""
    return np.concatenate([a.reshape(len(a), -1) for a in arrays], axis=1)


@dataclass(frozen=True)
class Field:
    """One array: its shape after the first axis, and what its columns are called in a line."""

    name: str
    columns: str
    shape: tuple[int, ...] = ()

    @property
    def size(self) -> int:
        """How many numbers of a line it takes."""
        return math.prod(self.shape)


@dataclass(frozen=True)
class Form:
    """The function that a student writes; of a program, the lines that it reads and writes."""

    function: str
    given: tuple[Field, ...]
    answered: tuple[Field, ...]

    @property
    def numbers(self) -> int:
        """How many numbers one answer has."""
        return sum(field.size for field in self.answered)

    @property
    def line(self) -> str:
        """The numbers in a line of an answer."""
        return ",".join(field.columns for field in self.answered)

    @property
    def signature(self) -> str:
        """The function with its arguments."""
        return f"{self.function}({', '.join(field.name for field in self.given)})"

    def question(self, arrays: Sequence[Array]) -> Floats:
        """Return what is given as lines of numbers, (n, columns) float64."""
        return side_by_side(*(np.asarray(a, np.float64) for a in arrays))

    def answers(self, table: Floats) -> Arrays:
        """Return lines of answers (n, numbers) as the arrays that they are."""
        ends = np.cumsum([field.size for field in self.answered])[:-1]
        parts = np.split(table, ends, axis=1)
        return tuple(
            part.reshape(len(table), *field.shape)
            for part, field in zip(parts, self.answered, strict=True)
        )

    def to_json(self) -> str:
        """Return it for `child.py`."""
        arrays = {
            name: [(f.name, f.shape) for f in fields]
            for name, fields in (("given", self.given), ("answered", self.answered))
        }
        return json.dumps({"function": self.function, "signature": self.signature, **arrays})
