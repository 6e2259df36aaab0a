"""How a fault of data is made: by other right values, or by data that are taken otherwise."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from reference_tracer.arrays import Integers
from reference_tracer.causes.case import Case
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.diagnosis.faults.fault import Fault, Numbers
from reference_tracer.tracer.progress import at_once

from ..kind import Data, Turn
from ..picture import DataPicture

Guesses = Callable[[Evidence, Data], Iterable["Turned"]]


@dataclass(frozen=True, eq=False)
class Turned(Numbers):
    """Right values, the data themselves, or where pixels stand, as a fault changes them."""

    turn: Turn = lambda made, seen: made
    change: Callable[[Data], Data] = lambda data: data
    where: tuple[Integers, Integers] | None = None  # row and column of each pixel, (h, w)


def turned(case: Case, guess: Turned) -> Case:
    """Return the case whose file is taken to hold what the fault makes."""
    picture = picture_of(case)
    if guess.where:
        picture = picture.moved(guess.where)
    data = guess.change(picture.data).turned(guess.turn)
    return replace(case, picture=replace(picture, data=data))


def picture_of(case: Case) -> DataPicture:
    """Return the picture of a case, which holds data."""
    assert isinstance(case.picture, DataPicture)
    return case.picture


def data_of(evidence: Evidence) -> Data:
    """Return the data of the evidence's picture."""
    return picture_of(evidence.case).data


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

    @at_once
    def find(evidence: Evidence) -> list[Turned]:
        data = data_of(evidence)
        return list(guesses(evidence, data)) if data.kind.name in kinds else []

    return Fault(name, sentence, why, advice, turned, find, numbers, words=words, witness=witness)


def once(turn: Turn) -> Guesses:
    """Return the guesses of a fault that is made in one way."""
    return lambda evidence, data: [Turned(turn=turn)]
