"""Checks that this process computes as the proof assumes.

The error bounds hold for IEEE 754 doubles that round to nearest and underflow gradually. A library
or a host can switch both off for a whole process. So the arrays that numpy computes with are
checked before anything is called certified.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats


class AssumptionError(RuntimeError):
    """The arithmetic of this process is not the one that the proof is about."""


# What is checked, and an operation: x, y and their result. The numbers are written as their bits,
# as decimals or powers would pass through the arithmetic that is to be checked.
_ONE = 0x3FF0000000000000
_NEAR_ONE = 0x3FF0000000400000  # 1 + 2^-30
_LEAST = 0x1  # 2^-1074
_NORMAL = 0x0010000000000000  # 2^-1022
_CHECKS: tuple[tuple[str, np.ufunc, int, int, int], ...] = (
    ("rounding to nearest", np.add, _ONE, 0x3CA0000000000000, _ONE),  # 1 + 2^-53
    ("rounding to nearest", np.add, _ONE, 0x3CB8000000000000, 0x3FF0000000000002),  # 1 + 3 2^-53
    ("rounding to nearest", np.subtract, _ONE, 0x3C90000000000000, _ONE),  # 1 - 2^-54
    ("rounding to nearest", np.multiply, _NEAR_ONE, _NEAR_ONE, 0x3FF0000000800000),
    ("subnormal results", np.multiply, _NORMAL, 0x3FE0000000000000, 0x0008000000000000),
    ("subnormal results", np.subtract, 0x0018000000000000, _NORMAL, 0x0008000000000000),
    ("subnormal operands", np.multiply, _LEAST, 0x43B0000000000000, 0x0090000000000000),  # 2^60
    ("subnormal operands", np.add, _LEAST, _LEAST, 0x2),
)
_LENGTH = 67  # longer than any vector register, and not a multiple of one


def broken_assumptions() -> list[str]:
    """Return what this thread's arithmetic lacks; empty where it is as the proof needs it."""
    lacks: list[str] = []
    for what, operation, x, y, expected in _CHECKS:
        with np.errstate(all="ignore"):
            result = operation(_floats(x), _floats(y))
        # As bits: a comparison of floats may take subnormals for zero, too.
        if (result.view(np.int64) != expected).any() and what not in lacks:
            lacks.append(what)
    return lacks


def _floats(bits: int) -> Floats:
    return np.full(_LENGTH, bits, np.int64).view(np.float64)


def check_assumptions() -> None:
    """Raise an AssumptionError if nothing can be certified here."""
    if lacks := broken_assumptions():
        raise AssumptionError(
            f"nothing can be certified in this process: its floating point lacks "
            f"{' and '.join(lacks)} (a library or the host has switched it off); choose another "
            "method, or trace in a process of its own"
        )
