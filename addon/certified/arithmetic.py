"""Checks that this thread computes as the proof assumes.

The error bounds hold for IEEE 754 doubles that round once, to nearest, and underflow gradually. A
library or a host can switch that off at any time, for all that a thread does from then on. So small
arrays are computed before pixels are decided, by the functions of numpy that decide them (but for
| |, and comparisons other than <), and compared bit by bit with what is right (`sound`). Before and
after each step, a few of Python's sums and products are compared so (`sound_steps`).
"""

from __future__ import annotations

import platform
import struct
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any, NamedTuple, ParamSpec, TypeVar

import numpy as np

from ..arrays import Array, Floats
from ..tracer.progress import Work
from . import known_results as known
from .known_results import Case, floats

P = ParamSpec("P")
T = TypeVar("T")


class AssumptionError(RuntimeError):
    """The arithmetic of this thread is not the one that the proof is about."""


def _at(ufunc: np.ufunc, start: int) -> Callable[[Floats, Floats], Floats]:
    """Return what `ufunc.at` makes of x and y that go to the same places."""
    first = floats([start])

    def largest(x: Floats, y: Floats) -> Floats:
        out = first.repeat(len(x))
        every = np.arange(len(x))
        ufunc.at(out, every, x)
        ufunc.at(out, every, y)
        return out

    return largest


# By numpy, in arrays.
_FUNCTIONS: tuple[tuple[Callable[[Floats, Floats], Array], tuple[Case, ...]], ...] = (
    (np.add, known.ADD),
    (np.subtract, known.SUBTRACT),
    (np.multiply, known.MULTIPLY),
    (np.divide, known.DIVIDE),
    (np.maximum, known.LARGEST),
    (np.minimum, known.LEAST_OF),
    (_at(np.maximum, known.INF | known.MINUS), known.LARGEST),
    (_at(np.minimum, known.INF), known.LEAST_OF),
    (np.nextafter, known.NEXT),
    (lambda x, _: np.floor(x), known.FLOOR),
    (lambda x, _: np.ceil(x), known.CEIL),
    (lambda x, y: np.less(x, y).astype(np.float64), known.LESS),
    (lambda x, _: np.frexp(x)[0], known.MANTISSA),
    (lambda x, _: np.frexp(x)[1].astype(np.float64), known.POWER),
)
_LENGTH = 67  # longer than any vector register, and not a multiple of one


class _Run(NamedTuple):
    """A function and its inputs, what it must return, and what is missing where it does not."""

    function: Callable[..., Array]
    inputs: tuple[Any, ...]
    expected: bytes
    checked: tuple[str, ...]


def _runs() -> list[_Run]:
    """Return what is computed: in arrays, also with gaps, and number by number, as Python does."""
    out = []
    for function, cases in _FUNCTIONS:
        # Cases whose number has no factor in common with a register's reach each of its lanes.
        rows = (cases * _LENGTH)[: _LENGTH + (-_LENGTH % len(cases))]
        checked, x, y, result = zip(*rows, strict=True)
        expected = floats(result).tobytes()
        both = floats(x), floats(y)
        out.append(_Run(function, both, expected, checked))
        if isinstance(function, np.ufunc):
            gaps = tuple(v.repeat(2)[::2] for v in both)
            out.append(_Run(function, gaps, expected, checked))
    for operator, cases in (
        (float.__add__, known.ADD),
        (float.__sub__, known.SUBTRACT),
        (float.__mul__, known.MULTIPLY),
        (float.__truediv__, known.DIVIDE),
        (int.__truediv__, known.INTEGERS),
    ):
        checked, x, y, result = zip(*cases, strict=True)
        if operator is not int.__truediv__:
            x, y = (floats(bits).tolist() for bits in (x, y))
        out.append(_Run(_one_by_one, (operator, x, y), floats(result).tobytes(), checked))
    return out


def _one_by_one(operator: Callable[..., float], x: Sequence[Any], y: Sequence[Any]) -> Floats:
    return np.array(list(map(operator, x, y)))


_RUNS = _runs()


def has_x87(machine: str, bits: int) -> bool:
    """Return whether programs of `bits` bits may use x87, which rounds to 64 digits first."""
    return bits == 32 and machine.lower().endswith(("86", "x86_64", "amd64"))


_X87 = has_x87(platform.machine(), 8 * struct.calcsize("P"))


def broken_assumptions() -> list[str]:
    """Return what this thread's arithmetic lacks; empty where it is as the proof needs it."""
    lacks = ["one rounding for each operation (a 32-bit program may use x87)"] if _X87 else []
    with np.errstate(all="ignore"):
        for function, inputs, expected, checked in _RUNS:
            found = function(*inputs).tobytes()
            if found != expected:
                wrong = np.frombuffer(found, np.int64) != np.frombuffer(expected, np.int64)
                lacks += [what for what, is_wrong in zip(checked, wrong, strict=True) if is_wrong]
    return list(dict.fromkeys(lacks))


def _refuse(lacks: list[str]) -> None:
    raise AssumptionError(
        f"nothing can be certified in this process: its floating point lacks "
        f"{' and '.join(lacks) or 'constancy'} (a library or the host has switched it off); choose "
        "another method, or trace in a process of its own"
    )


def check_assumptions() -> None:
    """Raise an AssumptionError if nothing can be certified here."""
    if lacks := broken_assumptions():
        _refuse(lacks)


# x, y and x + y; then u, v, w and (u v) w: what is compared is normal, whatever the modes are.
_SUMS = [floats(case[1:]).tolist() for case in known.ADD[:2]]
_PRODUCTS = [
    floats(bits).tolist()
    for bits in (
        (known.LEAST, 0x43B0000000000000, known.ONE, 0x0090000000000000),  # takes a subnormal
        (known.NORMAL, known.HALF, known.TWO, known.NORMAL),  # makes one
    )
]


def _check_modes() -> None:
    """Raise an AssumptionError if this thread rounds otherwise now, or flushes subnormals to zero.

    It takes a microsecond, by Python's floats: numpy's pass through the same unit of the processor,
    whose modes are the thread's.
    """
    is_sound = all(x + y == z for x, y, z in _SUMS)
    is_sound &= all(u * v * w == z for u, v, w, z in _PRODUCTS)
    if not is_sound:
        _refuse(broken_assumptions())


def sound(function: Callable[P, T]) -> Callable[P, T]:
    """Have a function begin and end with arithmetic as the proof needs it.

    What it returns was computed so; else it raises an AssumptionError.
    """

    @wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> T:
        check_assumptions()
        found = function(*args, **kwargs)
        _check_modes()
        return found

    return checked


def sound_steps(function: Callable[P, Work[T]]) -> Callable[P, Work[T]]:
    """Have each step of work begin and end so: between two steps, others may do what they like.

    A step looks for overflow and NaN itself, without numpy's warnings.
    """

    @wraps(function)
    def checked(*args: P.args, **kwargs: P.kwargs) -> Work[T]:
        check_assumptions()
        work = function(*args, **kwargs)
        while True:
            _check_modes()
            try:
                with np.errstate(all="ignore"):
                    event = next(work)
            except StopIteration as stop:
                _check_modes()
                return stop.value
            _check_modes()
            yield event

    return checked
