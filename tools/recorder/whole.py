"""Python's integers that remember how they were computed, and functions that branch on them.

An integer is the Coq term of type Z that it is worth. What is asked of one (`<`, `==`, `if value:`)
is a test. A function is run once for each way that its tests may turn out (`tree`), so that what is
recorded is the whole of it: `if test then ... else ...`, with what it returns at each end.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

Number = "Whole | int"
Way = tuple[bool, ...]


class _Run:
    """One run: how the first tests turn out is given; all others hold."""

    def __init__(self, way: Way) -> None:
        self.way, self.asked, self.known = way, [], {}

    def answer(self, test: str) -> bool:
        """Return how a test turns out: if it is asked again, as before."""
        if test not in self.known:
            number = len(self.asked)
            self.asked.append(test)
            self.known[test] = self.way[number] if number < len(self.way) else True
        return self.known[test]


_runs: list[_Run] = []


def tree(call: Callable[[], str], way: Way = ()) -> str:
    """Return what a function makes of its inputs, whichever way it goes, as one Coq term."""
    run = _Run(way)
    _runs.append(run)
    try:
        found = call()
    finally:
        _runs.pop()
    if len(run.asked) == len(way):
        return found
    yes, no = (tree(call, (*way, value)) for value in (True, False))
    return yes if yes == no else f"(if {run.asked[len(way)]} then {yes} else {no})"


class Asked:
    """A test of integers: a Coq term of type bool."""

    __hash__ = None

    def __init__(self, term: str) -> None:
        self.term = term

    def __bool__(self) -> bool:
        return _runs[-1].answer(self.term)

    def __eq__(self, other: Asked) -> Asked:  # type: ignore[override]
        return Asked(f"(Bool.eqb {self.term} {other.term})")

    def __sub__(self, other: Asked) -> Whole:
        return Whole(f"(as_int {self.term} - as_int {other.term})")


def _made(form: str) -> Callable[..., Whole]:
    return lambda *values: Whole(form.format(*map(term, values)))


def _asked(form: str) -> Callable[..., Asked]:
    return lambda *values: Asked(form.format(*map(term, values)))


class Whole:
    """An integer: a Coq term of type Z."""

    __hash__ = None

    def __init__(self, term: str) -> None:
        self.term = term

    __add__, __sub__, __mul__ = map(_made, ("({} + {})", "({} - {})", "({} * {})"))
    __radd__, __rsub__, __rmul__ = map(_made, ("({1} + {0})", "({1} - {0})", "({1} * {0})"))
    __neg__, __abs__ = map(_made, ("(- {})", "(Z.abs {})"))
    __lshift__, __truediv__ = map(_made, ("(Z.shiftl {} {})", "(division {} {})"))
    __rlshift__ = _made("(Z.shiftl {1} {0})")
    bit_length = _made("(bit_length {})")
    __lt__, __le__ = map(_asked, ("({} <? {})", "({} <=? {})"))
    __gt__, __ge__ = map(_asked, ("({1} <? {0})", "({1} <=? {0})"))
    __eq__ = _asked("({} =? {})")  # type: ignore[assignment]

    def __bool__(self) -> bool:
        return not Asked(f"({self.term} =? 0)")


def term(value: Whole | int) -> str:
    """Return an integer as a Coq term."""
    if isinstance(value, Whole):
        return value.term
    return f"({value})" if value < 0 else str(value)


least = _made("(Z.min {} {})")
most = _made("(Z.max {} {})")


def folded(of: Callable[..., Whole]) -> Callable[[Iterable], Whole]:
    """Return what Python's `min` or `max` makes of several integers."""

    def all_of(*values):
        first, *rest = values if len(values) > 1 else values[0]
        for value in rest:
            first = of(first, value)
        return first

    return all_of


def whole(names: str) -> tuple[Whole, ...]:
    """Return variables, whose names are separated by spaces."""
    return tuple(map(Whole, names.split()))


def triple(values) -> str:
    """Return a vector of integers as a Coq term."""
    return f"(I3 {' '.join(map(term, values))})"


def listed(terms: Iterable[str]) -> str:
    """Return Coq's list of some terms."""
    return f"[{'; '.join(terms)}]"
