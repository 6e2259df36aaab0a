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

P = ParamSpec("P")
T = TypeVar("T")


class AssumptionError(RuntimeError):
    """The arithmetic of this thread is not the one that the proof is about."""


# Numbers are written as their bits: decimals and powers would pass through the arithmetic that is
# to be checked, and a comparison of floats may take subnormals for zero, too.
_ONE, _TWO, _THREE, _INF = 0x3FF0000000000000, 0x4000000000000000, 0x4008000000000000, 0x7FF << 52
_ABOVE_ONE = _ONE + 1  # 1 + 2^-52
_NEAR_ONE = 0x3FF0000000400000  # 1 + 2^-30
_HALF = 0x3FE0000000000000
_LEAST = 0x1  # 2^-1074
_NORMAL = 0x0010000000000000  # 2^-1022
_MINUS = 1 << 63
_NEAREST, _SMALL, _TINY = "rounding to nearest", "subnormal results", "subnormal operands"
Case = tuple[str, int, int, int]  # what is checked, x, y, and their result

_ADD: tuple[Case, ...] = (
    (_NEAREST, _ONE, 0x3CA0000000000000, _ONE),  # 1 + 2^-53
    (_NEAREST, _ONE, 0x3CB8000000000000, _ONE + 2),  # 1 + 3 2^-53
    (_NEAREST, _ONE, 0x3CA0000008000000, _ABOVE_ONE),  # 1 + 2^-53 + 2^-78: x87 rounds it twice
    (_SMALL, 0x0018000000000000, _NORMAL | _MINUS, 0x0008000000000000),
    (_TINY, _LEAST, _LEAST, 0x2),
)
_SUBTRACT: tuple[Case, ...] = (
    (_NEAREST, _ONE, 0x3C90000000000000, _ONE),  # 1 - 2^-54
    (_NEAREST, _ONE, 0x3CA8000000000000, _ONE - 2),  # 1 - 3 2^-54
    (_TINY, _LEAST, _LEAST | _MINUS, 0x2),
    (_SMALL, 0x0018000000000000, _NORMAL, 0x0008000000000000),
)
_MULTIPLY: tuple[Case, ...] = (
    (_NEAREST, _NEAR_ONE, _NEAR_ONE, 0x3FF0000000800000),
    (_NEAREST, _ABOVE_ONE, 0x3FF8000000000000, 0x3FF8000000000002),  # 3 / 2 + 3 2^-53
    (_SMALL, _NORMAL, _HALF, 0x0008000000000000),
    # 2^-1046 (1 + 2^-30)^2: what has rounded to 53 digits before is a tie.
    (_SMALL, 0x0170000000400000, 0x3D10000000400000, 0x10000001),
    (_TINY, _LEAST, 0x43B0000000000000, 0x0090000000000000),  # 2^60
)
_DIVIDE: tuple[Case, ...] = (
    (_NEAREST, _ONE, _THREE, 0x3FD5555555555555),
    (_NEAREST, _ONE, 0x4024000000000000, 0x3FB999999999999A),  # 1 / 10
    (_SMALL, _NORMAL, _TWO, 0x0008000000000000),
    (_TINY, _LEAST, _NORMAL, 0x3CB0000000000000),
)
_LARGEST: tuple[Case, ...] = (
    (_TINY, _LEAST, 0, _LEAST),
    (_TINY, 0, _LEAST, _LEAST),
    (_TINY, _LEAST, 0x2, 0x2),
)
_LEAST_OF: tuple[Case, ...] = (
    (_TINY, _LEAST | _MINUS, 0, _LEAST | _MINUS),
    (_TINY, 0, _LEAST | _MINUS, _LEAST | _MINUS),
    (_TINY, _LEAST, 0x2, _LEAST),
)
_NEXT: tuple[Case, ...] = (
    (_SMALL, 0, _INF, _LEAST),
    (_SMALL, _NORMAL, _INF | _MINUS, _NORMAL - 1),
    (_TINY, _LEAST, _INF, 0x2),
    (_NEAREST, _ONE, _INF, _ABOVE_ONE),
    (_NEAREST, _ONE | _MINUS, _INF, (_ONE - 1) | _MINUS),
)
_FLOOR: tuple[Case, ...] = (
    (_TINY, _LEAST | _MINUS, 0, _ONE | _MINUS),
    (_NEAREST, _ONE - 1, 0, 0),
    (_NEAREST, _HALF | _MINUS, 0, _ONE | _MINUS),
)
_CEIL: tuple[Case, ...] = (
    (_TINY, _LEAST, 0, _ONE),
    (_NEAREST, _ABOVE_ONE, 0, _TWO),
    (_NEAREST, _HALF | _MINUS, 0, _MINUS),
)
_LESS: tuple[Case, ...] = (
    (_TINY, 0, _LEAST, _ONE),
    (_TINY, _LEAST | _MINUS, 0, _ONE),
    (_TINY, _LEAST, 0, 0),
)
_MANTISSA: tuple[Case, ...] = (
    (_TINY, _LEAST, 0, _HALF),
    (_NEAREST, _THREE, 0, 0x3FE8000000000000),
)
_POWER: tuple[Case, ...] = (  # of two
    (_TINY, _LEAST, 0, 0xC090C40000000000),  # -1073
    (_NEAREST, _THREE, 0, _TWO),
)


def _floats(bits: Sequence[int]) -> Floats:
    return np.array(bits, np.uint64).view(np.float64)


def _at(ufunc: np.ufunc, start: int) -> Callable[[Floats, Floats], Floats]:
    """Return what `ufunc.at` makes of x and y that go to the same places."""
    first = _floats([start])

    def largest(x: Floats, y: Floats) -> Floats:
        out = first.repeat(len(x))
        every = np.arange(len(x))
        ufunc.at(out, every, x)
        ufunc.at(out, every, y)
        return out

    return largest


# By numpy, in arrays.
_FUNCTIONS: tuple[tuple[Callable[[Floats, Floats], Array], tuple[Case, ...]], ...] = (
    (np.add, _ADD),
    (np.subtract, _SUBTRACT),
    (np.multiply, _MULTIPLY),
    (np.divide, _DIVIDE),
    (np.maximum, _LARGEST),
    (np.minimum, _LEAST_OF),
    (_at(np.maximum, _INF | _MINUS), _LARGEST),
    (_at(np.minimum, _INF), _LEAST_OF),
    (np.nextafter, _NEXT),
    (lambda x, _: np.floor(x), _FLOOR),
    (lambda x, _: np.ceil(x), _CEIL),
    (lambda x, y: np.less(x, y).astype(np.float64), _LESS),
    (lambda x, _: np.frexp(x)[0], _MANTISSA),
    (lambda x, _: np.frexp(x)[1].astype(np.float64), _POWER),
)
# By Python: an integer made a float, and quotients of integers.
_INTEGERS: tuple[tuple[str, int, int, int], ...] = (
    (_NEAREST, (1 << 53) + 1, 1, 0x4340000000000000),
    (_NEAREST, (1 << 53) + 3, 1, 0x4340000000000002),
    (_NEAREST, 1, 3, 0x3FD5555555555555),
    (_NEAREST, 1, 10, 0x3FB999999999999A),
    (_SMALL, 3, 1 << 1075, 0x2),
    (_SMALL, (1 << 80) + 1, 1 << 1155, _LEAST),
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
        expected = _floats(result).tobytes()
        both = _floats(x), _floats(y)
        out.append(_Run(function, both, expected, checked))
        if isinstance(function, np.ufunc):
            gaps = tuple(v.repeat(2)[::2] for v in both)
            out.append(_Run(function, gaps, expected, checked))
    for operator, cases in (
        (float.__add__, _ADD),
        (float.__sub__, _SUBTRACT),
        (float.__mul__, _MULTIPLY),
        (float.__truediv__, _DIVIDE),
        (int.__truediv__, _INTEGERS),
    ):
        checked, x, y, result = zip(*cases, strict=True)
        if operator is not int.__truediv__:
            x, y = (_floats(bits).tolist() for bits in (x, y))
        out.append(_Run(_one_by_one, (operator, x, y), _floats(result).tobytes(), checked))
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
_SUMS = [_floats(case[1:]).tolist() for case in _ADD[:2]]
_PRODUCTS = [
    _floats(bits).tolist()
    for bits in (
        (_LEAST, 0x43B0000000000000, _ONE, 0x0090000000000000),  # takes a subnormal
        (_NORMAL, _HALF, _TWO, _NORMAL),  # makes one
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
