"""What is known of an answer, and whether this machine's arithmetic allows to know it.

The error bound holds for IEEE 754 doubles that round to nearest and underflow gradually. Both can
be switched off for a whole process, by a library or by a host: so it is looked at, on the arrays
that numpy computes with, before anything is called certified.
"""

from __future__ import annotations

from enum import IntEnum

import numpy as np

_RULE = "the ray meets an edge, a corner or two surfaces at once: a rule decided"


class Certainty(IntEnum):
    """How the surface that a ray sees was decided; a member is a number, with these attributes."""

    color: str  # on a map
    words: str  # after a number of pixels
    sentence: str

    NOT_CERTIFIED = 0, "#787878", "not proven", "floating point alone decided, without a proof"
    BOUND = 1, "#2e4d59", "by a bound", "floating point decided: its error bound leaves no doubt"
    EXACT = 2, "#56b4e9", "by integers", "integers decided, where the error bound left a doubt"
    AMBIGUOUS = 3, "#f0e442", "by a rule", _RULE

    def __new__(cls, number: int, color: str, words: str, sentence: str) -> Certainty:
        """Make a member of a record."""
        self = int.__new__(cls, number)
        self._value_, self.color, self.words, self.sentence = number, color, words, sentence
        return self


class AssumptionError(RuntimeError):
    """The arithmetic of this process is not the one that the proof is about."""


# (what, operation, x, y, x operation y), the numbers as their bits: written as decimals or powers
# they would pass through the arithmetic that is to be checked.
_ONE, _LEAST, _NORMAL = 0x3FF0000000000000, 0x1, 0x0010000000000000  # 1, 2^-1074, 2^-1022
_CHECKS = (
    ("rounding to nearest", np.add, _ONE, 0x3CA0000000000000, _ONE),  # 1 + 2^-53
    ("rounding to nearest", np.add, _ONE, 0x3CB8000000000000, 0x3FF0000000000002),  # 1 + 3 2^-53
    ("rounding to nearest", np.subtract, _ONE, 0x3C90000000000000, _ONE),  # 1 - 2^-54
    ("rounding to nearest", np.multiply, *[0x3FF0000000400000] * 2, 0x3FF0000000800000),
    ("subnormal results", np.multiply, _NORMAL, 0x3FE0000000000000, 0x0008000000000000),
    ("subnormal results", np.subtract, 0x0018000000000000, _NORMAL, 0x0008000000000000),
    ("subnormal operands", np.multiply, _LEAST, 0x43B0000000000000, 0x0090000000000000),  # 2^60
    ("subnormal operands", np.add, _LEAST, _LEAST, 0x2),
)
_LENGTH = 67  # longer than any vector register, and not a multiple of one


def broken_assumptions() -> list[str]:
    """Return what this thread's arithmetic lacks; empty where it is as the proof needs it."""
    lacks: list[str] = []
    for what, operation, *numbers in _CHECKS:
        x, y, expected = (np.full(_LENGTH, bits, np.int64).view(np.float64) for bits in numbers)
        with np.errstate(all="ignore"):
            result = operation(x, y)
        # As bits: a comparison of floats may take subnormals for zero, too.
        if (result.view(np.int64) != expected.view(np.int64)).any() and what not in lacks:
            lacks.append(what)
    return lacks


def check_assumptions() -> None:
    """Raise an AssumptionError if nothing can be certified here."""
    if lacks := broken_assumptions():
        raise AssumptionError(
            f"nothing can be certified in this process: its floating point lacks "
            f"{' and '.join(lacks)} (a library or the host has switched it off); choose another "
            "method, or trace in a process of its own"
        )
