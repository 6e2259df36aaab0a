"""A function of the tracer, how it is called to be recorded, and which of its results are kept."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any
from unittest import mock

import numpy as np
from numpy.typing import NDArray

from ..arrays import Choices, Recorded, lift, variable
from ..functions import recording
from ..nodes import Node, RefusedError, every, node

Values = Mapping[str, float | bool]
# Arrays of one number, or of none where it was not reached; by their names, where runs differ.
Kept = Mapping[str, Any] | Iterable[Any]


class Inputs:
    """The variables of a record, as arrays: recorded, or plain to hold the recorder against.

    In several `columns` each has the same variables.
    """

    def __init__(self, values: Values, choices: Choices | None = None, columns: int = 1) -> None:
        self.values, self._choices, self.named = values, choices, set()
        self.columns = columns

    @property
    def rows(self) -> NDArray[np.intp]:
        """The number of each column."""
        return np.arange(self.columns)

    def one(self, name: str):
        """Return a variable, (columns,)."""
        return self.shared_one(name)[np.zeros(self.columns, np.intp)]

    def shared_one(self, name: str):
        """Return a variable that all columns share, (1,)."""
        value = self.values[name]
        return np.array([value]) if self._choices is None else variable(name, value)

    def shared(self, names: str):
        """Return variables that all columns share, (k, 1)."""
        return self.stacked([self.shared_one(name) for name in names.split()])

    def scalar(self, name: str):
        """Return a variable without axes."""
        return self.shared_one(name).reshape(())[()]

    def vector(self, names: str):
        """Return variables, whose names are separated by spaces, (k, columns)."""
        return self.stacked([self.one(name) for name in names.split()])

    def matrix(self, *rows: str):
        """Return variables in rows, (r, k, columns)."""
        return self.stacked([self.vector(row) for row in rows])

    def stacked(self, arrays: Sequence):
        return np.stack(arrays) if self._choices is None else lift(list(arrays))

    def chosen(self, number: int, is_path: bool = False) -> Recorded | None:
        """Return a test by which the function picked, as one of its results.

        It is not of the path, unless it is said to be: no other result depends on it.
        """
        if self._choices is None:
            return None
        test, value = self._choices[number * self.columns]
        if not is_path:
            self.named.add(test)
        each = np.full(self.columns, value)
        return lift(each)._each(lambda v: np.full(len(v), test) if v.dtype == object else v)

    def __contains__(self, name: str) -> bool:
        return name in self.values


BY_HAND = "none, it is argued by hand: see docs/proof.md"


@dataclass(frozen=True, eq=False)
class Record:
    """A call of one function.

    `values` are those of its variables that it is recorded with: they decide which way it goes.
    `theorems` has the Coq name of each result, in the order of `call`, and of the theorem about it
    with its file, as in Forms.plane_T; or `BY_HAND`. Of a variable that is no number of any size,
    `domain` has some values.
    """

    name: str
    function: str
    values: Values
    call: Callable[[Inputs], Kept]
    theorems: Mapping[str, str] = field(default_factory=dict)
    note: str = ""
    domain: Mapping[str, Sequence[float]] = field(default_factory=dict)

    def results(self, inputs: Inputs) -> dict[str, Any]:
        """Call the function; return its results by their names."""
        found = self.call(inputs)
        named = found if isinstance(found, Mapping) else zip(self.theorems, found, strict=True)
        return dict(named)


def named(prefix: str, names: str, theorem: str) -> dict[str, str]:
    """Return the names of results, with the theorem that all of them have."""
    return {f"{prefix}_{name}": theorem for name in names.split()}


@dataclass(frozen=True)
class Output:
    """A result of a function, as an expression; or a whole function, as Coq's definition of it."""

    name: str
    node: Node | str
    words: str
    theorem: str


def outputs(record: Record) -> list[Output]:
    """Record a function."""
    return [output for output, _ in recorded(record, record.values)]


def recorded(record: Record, values: Values, columns: int = 1) -> list[tuple[Output, NDArray]]:
    """Record a function for values of its variables; return its results with what they are.

    In several columns, each result must be the same expression in each.
    """
    with recording() as choices, np.errstate(all="ignore"):
        inputs = Inputs(values, choices, columns)
        try:
            kept = record.results(inputs)
        except RefusedError as refused:
            refused.add_note(f"while {record.function} was recorded")
            raise
        asked = [(test, value) for test, value in choices if test not in inputs.named]
    if asked:
        test = every(dict.fromkeys(t if value else node("Not", t) for t, value in asked))
        kept[f"{record.name}_path"] = lift(True)._each(lambda v: test if v.dtype == object else v)
    found = []
    for name, value in kept.items():
        theorem, value = record.theorems.get(name, ""), lift(value)
        found.append((Output(name, single(value), _words(record, name), theorem), value.values))
    return found


def computed(record: Record, values: Values) -> dict[str, NDArray | None]:
    """Call a function on plain numbers; a result is empty, or None, where it cannot be seen."""
    with np.errstate(all="ignore"):
        return record.results(Inputs(values))


def _words(record: Record, name: str) -> str:
    result = name.removeprefix(record.name).strip("_").replace("_", " ")
    note = f", {record.note}" if record.note else ""
    return f"{record.function}{note}{f': {result}' if result else ''}"


def single(value: Recorded) -> Node:
    """Return the one expression of a result: the same in all columns."""
    first, *others = value.nodes.reshape(-1)
    if any(other is not first for other in others):
        raise RefusedError("the columns of a result are different expressions")
    return first


class _Other:
    """numpy as a module has it, some names replaced."""

    def __init__(self, module: Any, replaced: Mapping[str, Any]) -> None:
        self._module, self._replaced = module, replaced

    def __getattr__(self, name: str) -> Any:
        return self._replaced[name] if name in self._replaced else getattr(self._module, name)


@contextmanager
def numpy_with(module: Any, **replaced: Any) -> Iterator[None]:
    """Let a module have other functions of numpy: what is made there becomes a variable."""
    with mock.patch.object(module, "np", _Other(module.np, replaced)):
        yield


@contextmanager
def locals_of(function: Callable) -> Iterator[dict[str, Any]]:
    """Collect the local variables that a function has when it returns."""
    code, found = function.__code__, {}

    def look(frame, event, _):
        if event == "return" and frame.f_code is code:
            found.clear()
            found.update(frame.f_locals)

    before = sys.getprofile()
    sys.setprofile(look)
    try:
        yield found
    finally:
        sys.setprofile(before)
