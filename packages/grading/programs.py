"""The programs that students write, as data: formulas in order, then conditions, then a choice.

The textbook's formulas are those that the derivation shows (`derivation/formulas.toml`), in its
notation; `subjects/` has the programs. One with a formula, a condition or the choice changed is a
wrong program, and answers as a student would who made that mistake: see `mutations.py`.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from reference_tracer.arrays import Bools, Floats, Index
from reference_tracer.derivation.expressions import Tree, evaluate, parse, printed

COMPARISONS: dict[str, Callable[[Any, Any], Any]] = {
    ">": operator.gt,
    "<": operator.lt,
    "≥": operator.ge,
    "≤": operator.le,
}
CONSTANTS = {"0": 0.0, "½": 0.5, "1": 1.0, "2": 2.0}
# Which of the objects that are hit is taken, by t (n, k) and where each is hit.
CHOICES: dict[str, Callable[[Floats, Bools], Index]] = {
    "nearest": lambda t, hit: np.where(hit, t, np.inf).argmin(axis=1),
    "farthest": lambda t, hit: np.where(hit, t, -np.inf).argmax(axis=1),
    "first": lambda t, hit: hit.argmax(axis=1),
    "last": lambda t, hit: hit.shape[1] - 1 - hit[:, ::-1].argmax(axis=1),
    "least": lambda t, hit: np.where(hit, np.abs(t), np.inf).argmin(axis=1),
}


class Condition(NamedTuple):
    """A condition on a hit."""

    left: Tree
    comparison: str
    right: str = "0"  # one of CONSTANTS

    def __str__(self) -> str:
        return f"{printed(self.left)} {self.comparison} {self.right}"

    def holds(self, names: Mapping[str, Any]) -> Any:
        """Return whether it holds of numbers, or arrays of them, by their names."""
        return COMPARISONS[self.comparison](evaluate(self.left, names), names[self.right])


def condition(text: str) -> Condition:
    """Return a condition as it is printed: a formula, a comparison and a constant."""
    left, comparison, right = text.rsplit(" ", 2)
    return Condition(parse(left), comparison, right)


class Slip(NamedTuple):
    """A common mistake that is more than one sign, letter or condition: what is written instead."""

    name: str
    sentence: str
    formulas: Mapping[str, str] = {}
    conditions: Mapping[str, tuple[str, ...]] = {}  # by each that is replaced
    choice: str = ""  # one of CHOICES


class Part(NamedTuple):
    """Numbers of an answer that are right or wrong together: the labels that give them.

    Numbers below `least` are told apart as if they were as large. Of a `unit` vector only the
    direction counts.
    """

    name: str
    labels: tuple[str, ...]
    size: int
    least: float = 0.0
    unit: bool = False


Parts = tuple[Part, ...]
Named = dict[str, Any]  # numbers and vectors of one arithmetic, or arrays of them, by name


@dataclass(frozen=True, eq=False)
class Letters:
    """The inputs of formulas, by name: numbers of a shape (n, ...), vectors (3, n, ...)."""

    values: Mapping[str, Floats]
    shape: tuple[int, ...]

    def each(self, of: Callable[[Floats], Any]) -> Named:
        """Return what a function makes of each number, and of each component of a vector.

        The constants are among them.
        """
        found = {name: of(np.array(value)) for name, value in CONSTANTS.items()}
        for name, value in self.values.items():
            is_number = value.ndim == len(self.shape)
            found[name] = of(value) if is_number else np.array([of(v) for v in value], object)
        return found

    def take(self, rows: Index) -> Letters:
        """Return those of some of the n."""
        some = {k: v.take(rows, axis=v.ndim - len(self.shape)) for k, v in self.values.items()}
        return Letters(some, (len(rows), *self.shape[1:]))


@dataclass(frozen=True)
class Program:
    """A program: trees of formulas by their left sides, each made of those before it.

    Where it has conditions they are of a hit, at t; else there is an answer always. With a choice,
    formulas are of k objects each, and one that is hit is taken.
    """

    formulas: Mapping[str, Tree]
    conditions: tuple[Condition, ...]
    kinds: tuple[frozenset[str], ...]  # letters that may stand in one another's place
    parts: Parts
    slips: tuple[Slip, ...] = field(default=(), repr=False)
    choice: str = ""

    @classmethod
    def of(
        cls,
        formulas: Mapping[str, str],
        conditions: tuple[str, ...],
        kinds: tuple[str, ...],
        parts: Parts,
        slips: tuple[Slip, ...] = (),
        choice: str = "",
    ) -> Program:
        """Return a program from its formulas and conditions as they are printed."""
        return cls(
            {label: parse(right) for label, right in formulas.items()},
            tuple(condition(text) for text in conditions),
            tuple(frozenset(kind.split()) for kind in kinds),
            parts,
            slips,
            choice,
        )

    def computed(self, letters: Mapping[str, Any]) -> Named:
        """Return all numbers and vectors by their names, those of the letters included.

        Raises
        ------
        ZeroDivisionError
            If a fraction is divided by 0.
        """
        names = dict(letters)
        for label, right in self.formulas.items():
            names[label] = evaluate(right, names)
        return names

    @np.errstate(all="ignore")
    def answers(self, letters: Letters) -> Floats:
        """Return the numbers of the parts (n, m); the first is not finite where nothing is hit."""
        names = self.computed(CONSTANTS | dict(letters.values))
        if self.conditions or self.choice:
            hit = np.isfinite(np.broadcast_to(names["t"], letters.shape))
            for each in self.conditions:
                hit = hit & each.holds(names)
            names["t"] = np.where(hit, names["t"], np.inf)
            if self.choice:
                names |= chosen(self.choice, names["t"], hit)
        count = letters.shape[0]
        numbers = [names[label] for part in self.parts for label in part.labels]
        rows = [np.broadcast_to(v, (*v.shape[:-1], count)).reshape(-1, count) for v in numbers]
        out = np.concatenate(rows).T
        for part, place in columns(self.parts):
            if part.unit:
                out[:, place] = unit(out[:, place])
        return out


def chosen(choice: str, t: Floats, hit: Bools) -> dict[str, Floats]:
    """Return t (n,) of the object that is taken, and its number; where none is hit inf and 0.

    What a picture shows is its number, and infinite where none is hit.
    """
    which = CHOICES[choice](t, hit)
    found = hit.any(axis=1)
    taken = np.take_along_axis(t, which[:, None], axis=1)[:, 0]
    return {
        "t": np.where(found, taken, np.inf),
        "owner": np.where(found, which, 0).astype(float),
        "shown": np.where(found, which, np.inf),
    }


@np.errstate(all="ignore")
def unit(vectors: Floats) -> Floats:
    """Return vectors (..., 3) with a length of 1."""
    out: Floats = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return out


def columns(parts: Parts) -> list[tuple[Part, slice]]:
    """Return each part, and where its numbers stand in an answer."""
    ends = np.cumsum([0, *(part.size for part in parts)]).tolist()
    return [(part, slice(*pair)) for part, pair in zip(parts, pairwise(ends), strict=True)]
