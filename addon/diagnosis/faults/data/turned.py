"""How a fault of data is made: the right values are turned into those that the file holds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from ....causes.case import Case
from ....pictures.data.kind import Data, Turn
from ....tracer.progress import at_once
from ...evidence import Evidence
from ..fault import Fault, Find, Numbers

Guesses = Callable[[Evidence, Data], Iterable["Turned"]]


@dataclass(frozen=True, eq=False)
class Turned(Numbers):
    """What a fault makes of right values."""

    turn: Turn = lambda made, seen: made


def turned(case: Case, guess: Turned) -> Case | None:
    """Return the case whose file is taken to hold what the fault makes."""
    data = case.picture.data
    if data is None:
        return None
    return replace(case, picture=replace(case.picture, data=data.turned(guess.turn)))


def of_kinds(kinds: tuple[str, ...], guesses: Guesses) -> Find[Turned]:
    """Return a function that finds guesses in data of some kinds, and none in other pictures."""

    @at_once
    def find(evidence: Evidence) -> list[Turned]:
        data = evidence.case.picture.data
        if data is None or data.kind.name not in kinds:
            return []
        return list(guesses(evidence, data))

    return find


def data_fault(
    name: str,
    kinds: tuple[str, ...],
    sentence: str,
    why: str,
    advice: str,
    guesses: Guesses,
    numbers: tuple[str, ...] = (),
    words: str = "",
    witness: str = "",
) -> Fault[Turned]:
    """Return the record of a fault of data of some kinds; its sentence begins with the values."""
    find = of_kinds(kinds, guesses)
    return Fault(name, sentence, why, advice, turned, find, numbers, words=words, witness=witness)


def once(turn: Turn) -> Guesses:
    """Return the guesses of a fault that is made in one way."""
    return lambda evidence, data: [Turned(turn=turn)]
